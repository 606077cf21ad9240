// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steiner points on constraints, spaced in proportion to the sizing field: the fixed point of the one-dimensional
// Lloyd iteration of Tournois 2009, sec. 2.2.2, reached directly by cutting the length measured in the metric of the
// field into equal parts. Recursive bisection, as greedy refinement does it, needs up to twice as many points.

#ifndef WEFT_PLANAR_REFINE_SAMPLE_CONSTRAINTS_2_H
#define WEFT_PLANAR_REFINE_SAMPLE_CONSTRAINTS_2_H

#include <weft/internal/cold.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace weft::internal {

/// Parameters in (0, 1) of the points that cut a segment into pieces of equal metric length, at most 1 and as near to
/// `wanted` as can be.
/// \param size callable, point -> target edge length.
/// \param most number of points at most; one more is returned when more would be needed.
template <class Point, class Size>
WEFT_COLD std::vector<double> equal_metric_parts(const Point& a, const Point& b, const Size& size, double wanted,
                                                 std::size_t most)
{
  const double ax = CGAL::to_double(a.x()), ay = CGAL::to_double(a.y()), dx = CGAL::to_double(b.x()) - ax,
               dy = CGAL::to_double(b.y()) - ay, length = std::sqrt(dx * dx + dy * dy);
  const auto size_at = [&](double t) { return size(Point(ax + t * dx, ay + t * dy)); };
  // Metric length by the trapezium rule, in steps of an eighth of the local size.
  std::vector<double> at(1, 0), metric(1, 0);
  double t = 0, h = size_at(0);
  while (t < 1 && metric.back() < static_cast<double>(most) + 2) {
    const double next = (std::min)(1.0, t + (std::max)(0.125 * h / length, 1e-15)), k = size_at(next);
    metric.push_back(metric.back() + 0.5 * (next - t) * length * (1 / h + 1 / k));
    at.push_back(next);
    t = next;
    h = k;
  }
  if (!(metric.back() < static_cast<double>(most) + 2)) return std::vector<double>(most + 1, 0.5);
  // The slack keeps a segment of exactly one size in one piece.
  double n = (std::max)(1.0, std::ceil(metric.back() * (1 - 1e-12)));
  while (wanted * (n + 1) / metric.back() < metric.back() / (n * wanted)) ++n; // nearer as a ratio
  const auto pieces = static_cast<std::size_t>(n);
  std::vector<double> cuts;
  std::size_t k = 0;
  for (std::size_t i = 1; i < pieces; ++i) {
    const double length_to = metric.back() * static_cast<double>(i) / static_cast<double>(pieces);
    while (metric[k + 1] < length_to) ++k;
    cuts.push_back(at[k] + (at[k + 1] - at[k]) * (length_to - metric[k]) / (metric[k + 1] - metric[k]));
  }
  return cuts;
}

/// Inserts points on a part of one chain. Of many points the middle one comes first, then those of each half in the
/// same way: from end to end, each would turn over the triangles of all points across, in quadratic time. Few go from
/// end to end.
/// \param from,to ends of the part, in the direction of the chain or against it; nothing is done unless an edge joins
///   them.
/// \param cuts parameters of the points along the chain, from `from` to `to`.
/// \param go_on callable without arguments, called for every point; false stops.
/// \param visit called with each new vertex.
template <class Mesh, class Chain, class Go_on, class Visit>
WEFT_COLD bool insert_cuts(Mesh& mesh, const Chain& chain, typename Mesh::Vertex_handle from,
                           typename Mesh::Vertex_handle to, const std::vector<double>& cuts, const Go_on& go_on,
                           const Visit& visit)
{
  using Triangulation = typename Mesh::Triangulation;
  using Vertex_handle = typename Mesh::Vertex_handle;
  struct Piece
  {
    Vertex_handle source, target;
    std::size_t first, last; // cuts between the two
  };
  constexpr std::size_t most_in_a_row = 256;
  const auto a = chain.source->point(), b = chain.target->point();
  std::vector<Piece> pieces{{from, to, 0, cuts.size()}};
  while (!pieces.empty()) {
    const Piece piece = pieces.back();
    pieces.pop_back();
    if (piece.first == piece.last) continue;
    if (!go_on()) return false;
    const std::size_t left = piece.last - piece.first,
                      middle = left > most_in_a_row ? piece.first + left / 2 : piece.first;
    const double t = cuts[middle];
    const typename Mesh::Point p(a.x() + t * (b.x() - a.x()), a.y() + t * (b.y() - a.y()));
    typename Triangulation::Face_handle f;
    int i;
    if (!mesh.triangulation().is_edge(piece.source, piece.target, f, i)) continue;
    const Vertex_handle v = mesh.insert_on_constraint(p, f, i);
    if (v == Vertex_handle()) continue; // at the end of resolution: there is no place for the others either
    visit(v);
    pieces.push_back({v, piece.target, middle + 1, piece.last});
    pieces.push_back({piece.source, v, piece.first, middle});
  }
  return true;
}

/// The same for a whole chain.
template <class Mesh, class Chain, class Go_on>
bool insert_cuts(Mesh& mesh, const Chain& chain, const std::vector<double>& cuts, const Go_on& go_on)
{
  return insert_cuts(mesh, chain, chain.source, chain.target, cuts, go_on, [](const auto&) {});
}

/// Inserts Steiner points on all constraints of a Working_mesh_2, or none if that takes more than `max_vertices`.
/// \param wanted metric length of a piece to aim at; none is longer than 1.
/// \param go_on callable, called now and then with the number of vertices; false stops.
/// \returns whether all constraints were done.
template <class Mesh, class Go_on>
bool sample_constraints_2(Mesh& mesh, double wanted, std::size_t max_vertices, const Go_on& go_on)
{
  const auto& cdt = mesh.triangulation();
  constexpr std::size_t seldom = 4096;
  std::size_t steps = 0;
  bool goes_on = go_on(cdt.number_of_vertices());
  const auto step = [&] {
    if (++steps % seldom == 0) goes_on = goes_on && go_on(cdt.number_of_vertices());
    return goes_on;
  };
  // Without bounds once the run is to stop, so that measuring ends at once.
  const auto size = [&](const typename Mesh::Point& p) {
    return step() ? mesh.target(p) : std::numeric_limits<double>::infinity();
  };
  const std::size_t n = cdt.number_of_vertices();
  std::size_t room = max_vertices > n ? max_vertices - n : 0;
  std::vector<std::vector<double>> cuts;
  for (const auto& chain : mesh.chains()) {
    cuts.push_back(equal_metric_parts(chain.source->point(), chain.target->point(), size, wanted, room));
    if (!goes_on || cuts.back().size() > room) return false;
    room -= cuts.back().size();
  }
  for (std::size_t i = 0; i < cuts.size(); ++i)
    if (!insert_cuts(mesh, mesh.chains()[i], cuts[i], step)) return false;
  return true;
}

} // namespace weft::internal

#endif // WEFT_PLANAR_REFINE_SAMPLE_CONSTRAINTS_2_H
