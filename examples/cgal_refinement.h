// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's own planar mesher (Delaunay refinement alone) under a sizing field, as the reference that a mesh is compared
// with. The criteria are those of CGAL::Delaunay_mesh_size_criteria_2, but for the size: it is taken at the centroid of
// a triangle, as weft does.

#ifndef WEFT_EXAMPLES_CGAL_REFINEMENT_H
#define WEFT_EXAMPLES_CGAL_REFINEMENT_H

#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Mesh_2/Face_badness.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_2.h>

#include <algorithm>
#include <array>

/// Criteria for CGAL::Delaunay_mesher_2.
template <class Cdt, class Sizing>
class Field_criteria
{
public:
  /// How bad a triangle is; the mesher begins with the lowest.
  struct Quality
  {
    double squared_sine = 1; ///< of the smallest angle
    double squared_size = 0; ///< longest edge over the target

    bool operator<(const Quality& other) const
    {
      if (squared_size > 1 || other.squared_size > 1) return squared_size > other.squared_size;
      return squared_sine < other.squared_sine;
    }
  };

  struct Is_bad
  {
    const Sizing* sizing;
    double bound;

    CGAL::Mesh_2::Face_badness operator()(const Quality& quality) const
    {
      if (quality.squared_size > 1) return CGAL::Mesh_2::IMPERATIVELY_BAD;
      return quality.squared_sine < bound ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }

    CGAL::Mesh_2::Face_badness operator()(typename Cdt::Face_handle face, Quality& quality) const
    {
      const auto &p = face->vertex(0)->point(), &q = face->vertex(1)->point(), &r = face->vertex(2)->point();
      std::array<double, 3> squared_length = {CGAL::to_double(CGAL::squared_distance(q, r)),
                                              CGAL::to_double(CGAL::squared_distance(r, p)),
                                              CGAL::to_double(CGAL::squared_distance(p, q))};
      std::sort(squared_length.begin(), squared_length.end());
      const double twice_area = 2 * CGAL::to_double(CGAL::area(p, q, r));
      const double size = CGAL::to_double((*sizing)(CGAL::centroid(p, q, r)));
      quality.squared_sine = twice_area * twice_area / (squared_length[1] * squared_length[2]);
      quality.squared_size = squared_length[2] / (size * size);
      return (*this)(quality);
    }
  };

  /// \param bound squared sine of the smallest angle; CGAL promises to end for 0.125, which is 20.7 degrees.
  explicit Field_criteria(const Sizing& sizing, double bound = 0.125) : is_bad_{&sizing, bound} {}
  Is_bad is_bad_object() const { return is_bad_; }

private:
  Is_bad is_bad_;
};

/// Refines the faces in the domain.
/// \param go_on called with the number of vertices after each insertion; returning false ends the refinement.
/// \returns whether it came to its end.
template <class Cdt, class Sizing, class Go_on>
bool refine_by_cgal(Cdt& cdt, const Sizing& sizing, const Go_on& go_on)
{
  using Criteria = Field_criteria<Cdt, Sizing>;
  CGAL::Delaunay_mesher_2<Cdt, Criteria> mesher(cdt, Criteria(sizing));
  mesher.init(true); // the domain is marked already
  while (!mesher.is_refinement_done()) {
    if (!go_on(cdt.number_of_vertices())) return false;
    mesher.try_one_step_refine_mesh();
  }
  return true;
}

#endif // WEFT_EXAMPLES_CGAL_REFINEMENT_H
