// SPDX-License-Identifier: GPL-3.0-or-later
//
// Twins beside small angles of the boundary: a vertex whose mirror image on the other sheet is nearer to it than its
// nearest vertex gets that image as a vertex, at once. Every point of a sheet then has its nearest vertex on its own
// sheet, however near the other is, so each sheet is the Delaunay triangulation of its own vertices: facets don't mix
// sheets, and refinement ends. This is what concentric shells do in the plane and "collars" in space (Tournois 2009,
// sec. 4.2.1.1; Rand and Walkington 2009).

#ifndef WEFT_SPATIAL_REFINE_MIRROR_TWINS_3_H
#define WEFT_SPATIAL_REFINE_MIRROR_TWINS_3_H

#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Finds the twins of vertices, and those of the twins: there may be more than two sheets.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Mirror_twins_3
{
public:
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Zone = typename Restricted::Zone;

  explicit Mirror_twins_3(const Restricted& mesh) : mesh_(mesh) {}

  /// Takes a vertex up that is new or about to be inserted.
  /// \param spacing distance to the nearest other vertex.
  void add(const Point& p, const Vertex_location_3& location, double spacing)
  {
    if (location.dimension >= 0 && location.dimension <= 2 && mesh_.oracle().has_mirror_images())
      vertices_.push_back({p, location, spacing});
  }

  /// Inserts the twins that are missing, at most `room`.
  /// \returns how many.
  /// \param insert `insert(zone, location)` inserts the point of a zone; cells may be classified later.
  template <class Insert>
  std::size_t insert(std::size_t room, const Insert& insert)
  {
    std::size_t inserted = 0;
    for (std::size_t i = 0; i < vertices_.size() && inserted < room; ++i) { // it grows
      const Vertex vertex = vertices_[i];
      images_.clear();
      mesh_.oracle().visit_mirror_images(vertex.point, vertex.location, vertex.spacing,
                                         [this](const Point& image, const Vertex_location_3& location) {
                                           images_.push_back({image, location, 0});
                                         });
      for (const Vertex& image : images_) {
        if (inserted == room || !find_zone(image.point)) continue;
        const double apart = std::sqrt(squared(image.point, vertex.point));
        double nearest = apart, others = vertex.spacing;
        for (const Cell_handle c : zone_.cells)
          for (int k = 0; k < 4; ++k) {
            const Point& q = c->vertex(k)->point();
            const double d = std::sqrt(squared(image.point, q));
            nearest = (std::min)(nearest, d);
            if (q != vertex.point) others = (std::min)(others, d);
          }
        if (nearest < close * apart) continue;
        insert(zone_, image.location);
        ++inserted;
        vertices_.push_back({image.point, image.location, others});
      }
    }
    vertices_.clear();
    return inserted;
  }

private:
  struct Vertex
  {
    Point point;
    Vertex_location_3 location;
    double spacing;
  };

  static double squared(const Point& p, const Point& q) { return CGAL::to_double(CGAL::squared_distance(p, q)); }

  bool find_zone(const Point& p)
  {
    return find_conflict_zone(mesh_.triangulation(), p, mesh_.vertices().back()->cell(), zone_) == Zone_result::found;
  }

  /// A vertex that is nearer to an image than this part of the distance between the sheets passes for it. It is never
  /// that near where the sheets are much nearer to each other than vertices are: the vertex would have been nearest.
  static constexpr double close = 0.25;

  const Restricted& mesh_;
  std::vector<Vertex> vertices_, images_;
  Zone zone_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_MIRROR_TWINS_3_H
