// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where no move of a vertex mends a bad triangle, a vertex too few or too many is the reason. The pliant step inserts
// one or removes one, polishes the neighborhood, and keeps the result only if the neighborhood's cost has fallen enough
// to be worth it; else it takes everything back. (Bossen and Heckbert's "pliant method", 1996, as a last resort under a
// hill-climbing rule.)

#ifndef WEFT_PLANAR_POLISH_PLIANT_IMPROVER_2_H
#define WEFT_PLANAR_POLISH_PLIANT_IMPROVER_2_H

#include <weft/internal/as_index.h>
#include <weft/internal/cold.h>
#include <weft/planar/polish/Neighborhood_2.h>
#include <weft/planar/polish/Polisher_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/planar/working/Failure_memory.h>

#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace weft::internal {

/// Inserts and removes single vertices of a Working_mesh_2 at its worst triangles.
template <class Mesh>
class Pliant_improver_2
{
public:
  using Triangulation = typename Mesh::Triangulation;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  Pliant_improver_2(Mesh& mesh, Polisher_2<Mesh>& polisher) : mesh_(mesh), polisher_(polisher) {}

  /// Allows so many more insertions than removals, and so many trials. Without a budget, fractal details of the input
  /// take very many points, for angles that nobody asked for.
  void set_budget(std::size_t insertions, std::size_t trials)
  {
    insertions_left_ = insertions;
    trials_left_ = trials;
  }

  /// One pass over the triangles whose cost exceeds `bound`, worst first. The mesh is renumbered.
  /// \param go_on callable; false stops.
  /// \returns the number of insertions and removals that were kept.
  template <class Go_on>
  std::size_t pass(double bound, const Go_on& go_on)
  {
    const std::vector<Triangle> worst = polisher_.worst_triangles(bound);
    failures_.reserve(mesh_.vertices().size());
    is_patient_ = worst.size() <= 20 + mesh_.faces().size() / 500;
    price_ = worst.size() > mesh_.faces().size() / 20 ? price_among_many : 1;
    std::size_t kept = 0;
    for (const Triangle& t : worst) {
      if (trials_left_ == 0 || !go_on()) break;
      Face_handle f;
      if (polisher_.find(t, f) && polisher_.cost(f) > bound && mend(t)) ++kept;
    }
    mesh_.renumber();
    polisher_.reset();
    return kept;
  }

private:
  // What a kept change must leave of the neighborhood's cost.
  static constexpr double worth_inserting = 0.75, worth_removing = 0.8;

  // A removal that multiplies the neighborhood's cost by more isn't worth polishing: that ends most removals at once,
  // and few of them would have been kept.
  static constexpr double hopeless_removal = 1e4;

  // What a trial takes from the budget where more than a twentieth of all triangles is bad: details of the input force
  // most of those.
  static constexpr std::size_t price_among_many = 3;

  using Triangle = typename Polisher_2<Mesh>::Triangle;

  using Region = Neighborhood_2<Mesh>; // what a change may affect

  /// The face of a triangle, if it still is one.
  /// Tries the changes at a triangle, those that save a vertex first, unless all of it has been tried before. Returns
  /// whether a change was kept.
  bool mend(const Triangle& t)
  {
    Face_handle f;
    if (!polisher_.find(t, f)) return false;
    const std::uint64_t key = key_of_surroundings(f);
    if (failures_.contains(key)) return false;
    for (int i = 0; i < 3; ++i)
      if (polisher_.find(t, f) && may_go(mesh_.vertices()[as_index(t[as_index(i)])]) &&
          try_removal(f, t[as_index(i)])) {
        ++insertions_left_;
        return true;
      }
    for (int k = 0; k < 4 && insertions_left_ > 0; ++k)
      if (polisher_.find(t, f) && try_insertion(f, k)) {
        --insertions_left_;
        return true;
      }
    failures_.add(key);
    return false;
  }

  WEFT_NOINLINE std::uint64_t key_of_surroundings(Face_handle f)
  {
    const Region region(mesh_, f, 1);
    std::uint64_t key = 0;
    for (const Vertex_handle v : region.vertices()) key += scrambled(polisher_.key_of_star(v));
    for (int i = 0; i < 3; ++i) key += polisher_.key_of_star(f->vertex(i)); // which face it is
    return key;
  }

  /// Inserts at the place of the k-th trial: the middle of the edges, longest first, then the middle of the face.
  Vertex_handle insert(Face_handle f, int k)
  {
    if (k == 3)
      return mesh_.insert_inside(CGAL::centroid(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point()),
                                 f);
    Triangle edges{0, 1, 2}; // longest first
    const auto order = [&](int& i, int& j) {
      if (mesh_.squared_length(f, j) > mesh_.squared_length(f, i)) std::swap(i, j);
    };
    order(edges[0], edges[1]), order(edges[1], edges[2]), order(edges[0], edges[1]);
    const int i = edges[as_index(k)];
    const Point p = CGAL::midpoint(f->vertex(Triangulation::ccw(i))->point(), f->vertex(Triangulation::cw(i))->point());
    return f->is_constrained(i) ? mesh_.insert_on_constraint(p, f, i) : mesh_.insert_inside(p, f);
  }

  WEFT_NOINLINE bool try_insertion(Face_handle f, int k)
  {
    Region region(mesh_, f, 1);
    const double old_cost = cost(region.vertices());
    const Vertex_handle v = insert(f, k);
    if (v == Vertex_handle()) return false;
    mesh_.adopt(v, static_cast<int>(mesh_.vertices().size()));
    region.add(v);
    if (settle(region.vertices(), old_cost, worth_inserting)) return true;
    region.forget(v);
    if (v->constraint() < 0)
      mesh_.remove(v);
    else if (!mesh_.remove_from_constraint(v))
      return true;
    region.put_back();
    return false;
  }

  bool may_go(Vertex_handle v) const { return v->constraint() != fixed_vertex && !mesh_.is_frozen(v); }

  bool try_removal(Face_handle f, int id)
  {
    Region region(mesh_, f, 1);
    const double old_cost = cost(region.vertices());
    const Vertex_handle v = mesh_.vertices()[as_index(id)];
    const Point p = region.forget(v);
    const int constraint = v->constraint();
    const auto [a, b] = constraint >= 0 ? mesh_.neighbors_on_constraint(v) : std::array<Vertex_handle, 2>();
    if (constraint < 0)
      mesh_.remove(v);
    else if (a == Vertex_handle() || is_too_long(a, b) || !mesh_.remove_from_constraint(v))
      return false;
    const std::vector<Vertex_handle>& vertices = region.vertices();
    if (is_hopeful_removal(vertices, old_cost) && settle(vertices, old_cost, worth_removing)) return true;
    region.put_back();
    const Vertex_handle again =
        constraint < 0 ? mesh_.insert_inside(p, vertices.front()->face()) : insert_between(a, b, p);
    if (again == Vertex_handle()) return true;
    mesh_.adopt(again, id);
    return false;
  }

  bool is_hopeful_removal(const std::vector<Vertex_handle>& vertices, double old_cost)
  {
    if (is_patient_ || cost(vertices) < hopeless_removal * old_cost) return true;
    pay();
    return false;
  }

  void pay() { trials_left_ -= (std::min)(trials_left_, price_); }

  bool is_too_long(Vertex_handle a, Vertex_handle b) const
  {
    const double size = mesh_.size(CGAL::midpoint(a->point(), b->point()));
    return CGAL::to_double(CGAL::squared_distance(a->point(), b->point())) > size * size;
  }

  Vertex_handle insert_between(Vertex_handle a, Vertex_handle b, const Point& p)
  {
    Face_handle f;
    int i;
    return mesh_.triangulation().is_edge(a, b, f, i) ? mesh_.insert_on_constraint(p, f, i) : Vertex_handle();
  }

  /// Polishes the vertices. Returns whether the cost of the triangles around them falls below a part of what it was;
  /// gives up when that is unlikely: where the first round leaves 12 times the cost, or where one more gain like the
  /// last one would not do. That saves most rounds, but loses a few changes that would have been kept in the end; so it
  /// isn't done where few triangles are bad.
  bool settle(const std::vector<Vertex_handle>& vertices, double old_cost, double worth)
  {
    pay();
    const int most_rounds = is_patient_ ? 24 : 8;
    const double hopeless = is_patient_ ? 1000 : 12;
    for (const Vertex_handle v : vertices) polisher_.give_hope(v);
    double now = hopeless * old_cost;
    for (int round = 0; round < most_rounds; ++round) {
      bool moved = false;
      for (const Vertex_handle v : vertices) moved |= polisher_.improve(v);
      const double before = now;
      now = cost(vertices);
      if (!moved) break;
      if (now > before || (round > 0 && !is_patient_ && now - (before - now) > worth * old_cost)) return false;
    }
    return now < worth * old_cost;
  }

  double cost(const std::vector<Vertex_handle>& vertices) const { return cost_around(mesh_, polisher_, vertices); }

  Mesh& mesh_;
  Polisher_2<Mesh>& polisher_;
  bool is_patient_ = false; // few triangles are bad: each may take longer
  std::size_t insertions_left_ = 0, trials_left_ = 0, price_ = 1;
  Failure_memory failures_; // surroundings of triangles that no change mended
};

} // namespace weft::internal

#endif // WEFT_PLANAR_POLISH_PLIANT_IMPROVER_2_H
