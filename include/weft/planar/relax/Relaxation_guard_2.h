// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps a relaxation from making a mesh worse. Lloyd's iteration lowers an energy, not the worst angle, and a mesh made
// for other sizes, or graded towards details that the sizing field doesn't know, may lose by it. The guard remembers
// the mesh; afterwards it puts vertices back where angles or sizes fell behind the worst that there was, and where
// that isn't enough the whole mesh.

#ifndef WEFT_PLANAR_RELAX_RELAXATION_GUARD_2_H
#define WEFT_PLANAR_RELAX_RELAXATION_GUARD_2_H

#include <weft/internal/as_index.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Remembers a Working_mesh_2 at construction. Vertices may move and edges be flipped afterwards, nothing else.
template <class Mesh>
class Relaxation_guard_2
{
public:
  using Triangulation = typename Mesh::Triangulation;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  explicit Relaxation_guard_2(Mesh& mesh) : mesh_(mesh), before_(measure())
  {
    for (const Vertex_handle v : mesh.vertices()) points_.push_back(v->point());
    // The frame has vertices, too, whose stars may have been flipped.
    for (const Vertex_handle v : mesh.triangulation().all_vertex_handles()) stars_.push_back({v, v->face()});
    for (const Face_handle f : mesh.triangulation().all_face_handles()) faces_.push_back(remember(f));
  }

  /// Whether the smallest or largest angle, the mean of the smallest angles or the sizes are worse than they were.
  bool is_worse() const
  {
    const Measures now = measure();
    return now.smallest < before_.smallest - rounding || now.largest > before_.largest + rounding ||
           now.mean < before_.mean - rounding || now.ratio > allowed_ratio();
  }

  /// Puts the vertices of triangles that are worse than the worst ever was back where they were, as far as the mesh
  /// allows; then their neighbors, if that doesn't help.
  void mend()
  {
    constexpr int most_rounds = 10;
    std::vector<char> is_back(mesh_.vertices().size(), 0);
    for (int round = 0; round < most_rounds; ++round) {
      const std::vector<Vertex_handle> back = vertices_to_put_back(is_back);
      if (back.empty()) return;
      std::vector<Point> old;
      for (const Vertex_handle v : back) old.push_back(points_[as_index(v->id())]);
      mesh_.relocator().move(back, old);
      for (const Vertex_handle v : back) mesh_.update_target(v);
    }
  }

  /// Puts everything back, edges included.
  void restore()
  {
    for (const Vertex_handle v : mesh_.vertices()) v->set_point(points_[as_index(v->id())]);
    for (const auto& [v, f] : stars_) v->set_face(f);
    for (const Old_face& old : faces_) {
      for (int i = 0; i < 3; ++i) {
        old.face->set_vertex(i, old.vertex[as_index(i)]);
        old.face->set_neighbor(i, old.neighbor[as_index(i)]);
        old.face->set_constraint(i, old.is_constrained[as_index(i)]);
      }
      old.face->set_in_domain(old.is_in_domain);
    }
    for (const Vertex_handle v : mesh_.vertices()) mesh_.update_target(v);
  }

private:
  static constexpr double rounding = 1e-9;

  struct Measures
  {
    double smallest = 180, largest = 0; // angles in degrees, without those between two constraints
    double mean = 0;                    // of the smallest angles of all faces
    double ratio = 0;
  };
  struct Star
  {
    Vertex_handle vertex;
    Face_handle face;
  };
  struct Old_face
  {
    Face_handle face;
    std::array<Vertex_handle, 3> vertex;
    std::array<Face_handle, 3> neighbor;
    std::array<bool, 3> is_constrained;
    bool is_in_domain;
  };

  static Old_face remember(Face_handle f)
  {
    Old_face old;
    old.face = f;
    for (int i = 0; i < 3; ++i) {
      old.vertex[as_index(i)] = f->vertex(i);
      old.neighbor[as_index(i)] = f->neighbor(i);
      old.is_constrained[as_index(i)] = f->is_constrained(i);
    }
    old.is_in_domain = f->is_in_domain();
    return old;
  }

  double allowed_ratio() const { return (std::max)(1.0, before_.ratio * (1 + rounding)); }

  /// Angle of a face at its corner i, in degrees.
  double angle(Face_handle f, int i) const
  {
    const double a = mesh_.squared_length(f, i), b = mesh_.squared_length(f, Triangulation::ccw(i)),
                 c = mesh_.squared_length(f, Triangulation::cw(i));
    return std::acos((std::min)(1.0, (std::max)(-1.0, (b + c - a) / (2 * std::sqrt(b * c))))) * 180 / std::acos(-1.0);
  }

  /// Smallest and largest angle of a face that aren't between two constraints, which nothing can change.
  std::array<double, 2> free_angles(Face_handle f) const
  {
    std::array<double, 2> range{180, 0};
    for (int i = 0; i < 3; ++i)
      if (!f->is_constrained(Triangulation::ccw(i)) || !f->is_constrained(Triangulation::cw(i))) {
        const double a = angle(f, i);
        range = {(std::min)(range[0], a), (std::max)(range[1], a)};
      }
    return range;
  }

  bool is_worse_than_worst(Face_handle f) const
  {
    const auto [smallest, largest] = free_angles(f);
    return smallest < before_.smallest - rounding || largest > before_.largest + rounding ||
           mesh_.ratio(f) > allowed_ratio();
  }

  Measures measure() const
  {
    Measures m;
    for (const Face_handle f : mesh_.faces()) {
      const auto [smallest, largest] = free_angles(f);
      m.smallest = (std::min)(m.smallest, smallest);
      m.largest = (std::max)(m.largest, largest);
      m.mean += (std::min)({angle(f, 0), angle(f, 1), angle(f, 2)});
      m.ratio = (std::max)(m.ratio, mesh_.ratio(f));
    }
    m.mean /= static_cast<double>(mesh_.faces().size());
    return m;
  }

  /// Moved vertices of faces that are too bad; where all are back already, the moved ones around them. Marks them.
  std::vector<Vertex_handle> vertices_to_put_back(std::vector<char>& is_back) const
  {
    std::vector<Vertex_handle> result;
    const auto append = [&](Vertex_handle v) {
      if (mesh_.is_frame(v) || is_back[as_index(v->id())] || v->point() == points_[as_index(v->id())]) return false;
      is_back[as_index(v->id())] = 1;
      result.push_back(v);
      return true;
    };
    for (const Face_handle f : mesh_.faces()) {
      if (!is_worse_than_worst(f)) continue;
      bool any = false;
      for (int i = 0; i < 3; ++i) any |= append(f->vertex(i));
      for (int i = 0; i < 3 && !any; ++i) {
        auto neighbor = mesh_.triangulation().incident_vertices(f->vertex(i));
        const auto done = neighbor;
        do append(neighbor);
        while (++neighbor != done);
      }
    }
    return result;
  }

  Mesh& mesh_;
  Measures before_;
  std::vector<Point> points_; // by vertex id
  std::vector<Star> stars_;
  std::vector<Old_face> faces_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_RELAX_RELAXATION_GUARD_2_H
