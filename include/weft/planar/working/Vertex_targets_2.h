// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edge lengths to aim at while a triangulation is meshed: the sizing field, asked as seldom as possible, or less
// near details of the input, and what was found at each numbered vertex.

#ifndef WEFT_PLANAR_WORKING_VERTEX_TARGETS_2_H
#define WEFT_PLANAR_WORKING_VERTEX_TARGETS_2_H

#include <weft/errors.h>
#include <weft/internal/as_index.h>
#include <weft/internal/cold.h>
#include <weft/planar/working/Size_memory.h>
#include <weft/sizing/Lipschitz_sizing_2.h>
#include <weft/sizing/Uniform_sizing.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_2.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam Cdt constrained Delaunay triangulation with weft's bases.
/// \tparam Sizing callable, point -> target edge length in the input's units.
template <class Cdt, class Sizing>
class Vertex_targets_2
{
public:
  using Point = typename Cdt::Point;
  using Vertex_handle = typename Cdt::Vertex_handle;
  using Grading = Lipschitz_sizing_2<typename Cdt::Geom_traits>;
  static constexpr bool uniform = is_uniform_sizing_v<Sizing>;

  /// The field is kept by reference.
  explicit Vertex_targets_2(const Sizing& sizing) : sizing_(sizing) {}

  /// Largest edge length that the sizing field admits at a point.
  /// \throws Option_error if the sizing field returns anything but a positive finite number.
  double size(const Point& p) const
  {
    const auto ask = [&] {
      const double s = CGAL::to_double(sizing_(p));
      if (!(s > 0) || !std::isfinite(s)) throw_bad_size(p, s);
      return s;
    };
    if constexpr (uniform)
      return ask();
    else
      return known_sizes_.get(CGAL::to_double(p.x()), CGAL::to_double(p.y()), ask);
  }

  /// Edge length to aim at: the sizing field, or less where the grading is.
  double target(const Point& p) const
  {
    const double s = size(p);
    return grading_ ? graded(p, s) : s;
  }

  /// Target remembered for the vertex of that number.
  double target(int id) const { return sizes_[as_index(id)]; }

  /// Numbers vertices anew.
  /// \param old_ids of each vertex its number before, or -1 where it had none.
  void renumber(const std::vector<Vertex_handle>& vertices, const std::vector<int>& old_ids)
  {
    const std::vector<double> old_sizes = std::move(sizes_);
    const std::vector<Point> old_asked_at = std::move(asked_at_);
    sizes_.clear();
    asked_at_.clear();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const int old = old_ids[i];
      sizes_.push_back(old >= 0 ? old_sizes[as_index(old)] : target(vertices[i]->point()));
      asked_at_.push_back(old >= 0 ? old_asked_at[as_index(old)] : vertices[i]->point());
    }
  }

  /// Asks for the target of a vertex, which may be one more than there have been.
  void set(std::size_t id, const Point& p)
  {
    if (id == sizes_.size()) {
      sizes_.emplace_back();
      asked_at_.emplace_back();
    }
    asked_at_[id] = p;
    sizes_[id] = target(p);
  }

  /// To be called after a vertex has moved. The field is asked again only when the vertex has gone some way since the
  /// last time: targets change slowly, and relaxation moves vertices far more often than far.
  void update(int id, const Point& p)
  {
    if (is_uniform()) return;
    const double d2 = CGAL::to_double(CGAL::squared_distance(p, asked_at_[as_index(id)]));
    double& size = sizes_[as_index(id)];
    if (d2 < 0.0025 * size * size) return;
    size = target(p);
    asked_at_[as_index(id)] = p;
  }

  /// Makes room to remember the field's answers at so many places.
  void expect_questions(std::size_t places)
  {
    if (!uniform) known_sizes_.reserve(places);
  }

  /// Whether targets are the same everywhere.
  bool is_uniform() const { return uniform && !grading_; }

  /// Makes targets smaller than the sizing field where `grading` is.
  void set_grading(Grading grading, const std::vector<Vertex_handle>& vertices)
  {
    grading_.emplace(std::move(grading));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      asked_at_[i] = vertices[i]->point();
      sizes_[i] = target(asked_at_[i]);
    }
  }

private:
  WEFT_NOINLINE double graded(const Point& p, double size) const { return CGAL::to_double(grading_->below(p, size)); }

  [[noreturn]] WEFT_COLD static void throw_bad_size(const Point& p, double s)
  {
    std::ostringstream what;
    what << "the sizing field returned " << s << " at (" << p << "); sizes must be positive and finite";
    throw Option_error(what.str());
  }

  const Sizing& sizing_;
  std::vector<double> sizes_;   // targets at vertices
  std::vector<Point> asked_at_; // where they were evaluated
  mutable Size_memory known_sizes_;
  std::optional<Grading> grading_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_WORKING_VERTEX_TARGETS_2_H
