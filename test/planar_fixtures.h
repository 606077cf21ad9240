// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of the planar mesher share: planar straight line graphs (planar_graphs.h), sizing fields, and checks.

#ifndef WEFT_TEST_PLANAR_FIXTURES_H
#define WEFT_TEST_PLANAR_FIXTURES_H

#include "planar_graphs.h"

#include <weft/planar/check/validate_2.h>
#include <weft/planar/graph/insert_pslg.h>
#include <weft/planar/graph/mark_domain.h>
#include <weft/planar/mesh/quality_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace planar {

using Cdt = weft::Mesh_triangulation_2<K>;
/// One type for all sizing fields that aren't uniform: the mesher is compiled once for them.
using Field = std::function<double(const Point&)>;

// ---- Checks

/// Exactly, without a tolerance.
inline Cdt triangulate(const Pslg& pslg, weft::Crossings crossings = weft::Crossings::refuse)
{
  Cdt cdt;
  weft::insert_pslg(cdt, pslg, {crossings, 0});
  weft::mark_domain(cdt, pslg);
  return cdt;
}

/// The first faults in words; empty if there are none.
inline std::string faults(const weft::Validity_2& validity)
{
  if (validity.ok()) return "";
  std::ostringstream text;
  for (std::size_t i = 0; i < validity.faults.size() && i < 5; ++i)
    text << name(validity.faults[i].kind) << ": " << validity.faults[i].text << "\n";
  for (std::size_t i = 0; i < validity.counts.size(); ++i)
    if (validity.counts[i]) text << validity.counts[i] << " x " << name(static_cast<weft::Fault_kind>(i)) << "\n";
  return text.str();
}

/// Everything but sizes: by weft's own checker, by CGAL's, and that no vertex is left over.
inline std::string mesh_faults(const Cdt& cdt, const Pslg& pslg)
{
  std::string text = faults(weft::validate_2(cdt, pslg));
  if (text.empty() && !cdt.is_valid()) text += "CGAL finds it invalid\n";
  if (!text.empty()) return text;
  const std::set<Point> input(pslg.points.begin(), pslg.points.end());
  for (const auto v : cdt.finite_vertex_handles()) {
    if (input.count(v->point())) continue;
    bool used = cdt.are_there_incident_constraints(v);
    auto face = cdt.incident_faces(v);
    const auto done = face;
    do used = used || (!cdt.is_infinite(face) && face->is_in_domain());
    while (++face != done);
    std::ostringstream at;
    at.precision(17);
    at << "a Steiner vertex lies outside of the domain at " << v->point() << "\n";
    if (!used) return at.str();
  }
  return text;
}

/// Bits of a mesh: coordinates in storage order, faces by vertex numbers, and all flags.
struct Fingerprint
{
  std::vector<double> coordinates;
  std::vector<int> numbers;
  bool operator==(const Fingerprint& o) const { return coordinates == o.coordinates && numbers == o.numbers; }
};

inline Fingerprint fingerprint(const Cdt& cdt)
{
  Fingerprint result;
  std::map<Cdt::Vertex_handle, int> number;
  for (const auto v : cdt.finite_vertex_handles()) {
    number[v] = static_cast<int>(number.size());
    result.coordinates.push_back(v->point().x());
    result.coordinates.push_back(v->point().y());
    result.numbers.push_back(v->constraint());
  }
  for (const auto f : cdt.finite_face_handles()) {
    for (int i = 0; i < 3; ++i) {
      result.numbers.push_back(number.at(f->vertex(i)));
      result.numbers.push_back(f->is_constrained(i));
    }
    result.numbers.push_back(f->is_in_domain());
  }
  return result;
}

/// Occupies memory in pieces so that what is built meanwhile lies at other addresses, in another order.
class Memory_noise
{
public:
  explicit Memory_noise(unsigned seed)
  {
    Random random(seed);
    for (int i = 0; i < 2000; ++i) blocks_.push_back(std::make_unique<char[]>(16 + below(random, 60000)));
    shuffle(blocks_, random);
    blocks_.resize(700);
  }

private:
  std::vector<std::unique_ptr<char[]>> blocks_;
};

} // namespace planar

#endif // WEFT_TEST_PLANAR_FIXTURES_H
