// SPDX-License-Identifier: GPL-3.0-or-later
//
// What checks of a planar mesh find: faults with a line of text and the points to blame, counted by kind.

#ifndef WEFT_PLANAR_CHECK_VALIDITY_2_H
#define WEFT_PLANAR_CHECK_VALIDITY_2_H

#include <weft/planar/mesh/Scaled_triangle_2.h>

#include <CGAL/enum.h>

#include <array>
#include <cstddef>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// What can be wrong with a mesh.
enum class Fault_kind
{
  structure,   ///< vertices and faces don't refer to each other as in a triangulation of the sphere
  orientation, ///< a face is turned over or flat, or the convex hull isn't convex
  delaunay,    ///< an unconstrained edge isn't locally Delaunay
  conformity,  ///< constrained edges aren't the input's segments, or an input point is missing
  domain,      ///< the wrong faces are in the domain
  sizing       ///< a triangle or constrained edge is larger than the sizing field allows
};

/// Name of a kind of fault for people.
inline const char* name(Fault_kind kind)
{
  constexpr std::array<const char*, 6> names = {"structure",  "orientation", "delaunay",
                                                "conformity", "domain",      "sizing"};
  return names[static_cast<std::size_t>(kind)];
}

/// One thing that is wrong.
struct Fault_2
{
  Fault_kind kind;
  std::string text;                          ///< one line for a person, with the coordinates
  std::vector<std::array<double, 2>> points; ///< what is to blame: one point a vertex, two an edge, three a face
};

/// What the checks found.
struct Validity_2
{
  static constexpr std::size_t most_listed = 100; ///< faults of one kind; more are only counted

  std::vector<Fault_2> faults;         ///< in the order in which they were found
  std::array<std::size_t, 6> counts{}; ///< number of faults by kind, listed or not

  bool ok() const { return counts == std::array<std::size_t, 6>{}; }
  std::size_t count(Fault_kind kind) const { return counts[static_cast<std::size_t>(kind)]; }

  void add(Fault_kind kind, const std::string& what, std::vector<std::array<double, 2>> points = {})
  {
    if (++counts[static_cast<std::size_t>(kind)] > most_listed) return;
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    text << what << (points.empty() ? "" : " at");
    for (const auto& p : points) text << " (" << p[0] << ", " << p[1] << ")";
    faults.push_back({kind, text.str(), std::move(points)});
  }

  Validity_2& operator+=(const Validity_2& other)
  {
    faults.insert(faults.end(), other.faults.begin(), other.faults.end());
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += other.counts[i];
    return *this;
  }
};

/// One line a fault, or "valid".
inline std::ostream& operator<<(std::ostream& out, const Validity_2& validity)
{
  for (const Fault_2& fault : validity.faults) out << name(fault.kind) << ": " << fault.text << "\n";
  for (std::size_t i = 0; i < validity.counts.size(); ++i)
    if (validity.counts[i] > Validity_2::most_listed)
      out << name(static_cast<Fault_kind>(i)) << ": " << validity.counts[i] << " faults in all\n";
  return validity.ok() ? out << "valid\n" : out;
}

namespace internal {

/// Finite corners of a face.
template <class Cdt>
std::vector<Xy_2> corners(const Cdt& cdt, typename Cdt::Face_handle face)
{
  std::vector<Xy_2> result;
  for (int i = 0; i < 3; ++i)
    if (!cdt.is_infinite(face->vertex(i))) result.push_back(xy(face->vertex(i)->point()));
  return result;
}

/// Ends of edge i of a face.
template <class Cdt>
std::vector<Xy_2> ends(const Cdt& cdt, typename Cdt::Face_handle face, int i)
{
  std::vector<Xy_2> result;
  for (const int k : {Cdt::ccw(i), Cdt::cw(i)})
    if (!cdt.is_infinite(face->vertex(k))) result.push_back(xy(face->vertex(k)->point()));
  return result;
}

/// Lexicographic order of coordinates.
template <class Cdt>
CGAL::Comparison_result compare_xy(const Cdt& cdt, const typename Cdt::Point& p, const typename Cdt::Point& q)
{
  const auto in_x = cdt.geom_traits().compare_x_2_object()(p, q);
  return in_x != CGAL::EQUAL ? in_x : cdt.geom_traits().compare_y_2_object()(p, q);
}

} // namespace internal
} // namespace weft

#endif // WEFT_PLANAR_CHECK_VALIDITY_2_H
