// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads tetrahedral meshes from VTK unstructured grids, XML: ASCII, base64 or appended arrays, plain or compressed
// by zlib. Of elements of second order the corners are read. Tags are
// those that weft writes (`subdomain`, `patch`, `crease`, `feature`), or one of the names that other programs give the
// tags of all their elements.

#ifndef WEFT_IO_READ_VTU_3_H
#define WEFT_IO_READ_VTU_3_H

#include <weft/errors.h>
#include <weft/IO/internal/read_elements.h>
#include <weft/IO/internal/Vtu_arrays.h>
#include <weft/spatial/mesh/Element_soup_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// Reads one file; `IO::read_vtu_3()` runs it.
template <class K>
class Vtu_reader_3
{
public:
  explicit Vtu_reader_3(const std::string& filename) : filename_(filename), arrays_(filename) {}

  Element_soup_3<K> run()
  {
    read_points();
    read_elements();
    if (is_quadratic_) soup_.notes.emplace_back("elements of second order were read as straight ones");
    std::sort(features_.begin(), features_.end());
    for (const auto& feature : features_) soup_.corners.push_back(feature.second);
    return std::move(soup_);
  }

private:
  void read_points()
  {
    const auto x = arrays_.coordinates();
    if (x.size() != 3 * arrays_.number_of_points())
      throw File_error(filename_, 0,
                       std::to_string(arrays_.number_of_points()) + " points are announced, but there are " +
                           std::to_string(x.size()) + " coordinates");
    for (std::size_t v = 0; v < x.size(); v += 3) soup_.points.emplace_back(x[v], x[v + 1], x[v + 2]);
    if (!arrays_.has("PointData", "dimension") || !arrays_.has("PointData", "index")) return;
    const auto dimensions = arrays_.numbers("PointData", "dimension"), indices = arrays_.numbers("PointData", "index");
    for (std::size_t v = 0; v < (std::min)(dimensions.size(), indices.size()); ++v)
      soup_.locations.push_back({static_cast<int>(dimensions[v]), static_cast<int>(indices[v])});
    soup_.locations.resize(soup_.points.size(), {4, 0});
  }

  void read_elements()
  {
    const auto connectivity = arrays_.numbers("Cells", "connectivity"), offsets = arrays_.numbers("Cells", "offsets"),
               types = arrays_.numbers("Cells", "types");
    if (offsets.size() != arrays_.number_of_cells() || types.size() != offsets.size())
      throw File_error(filename_, 0,
                       std::to_string(arrays_.number_of_cells()) + " cells are announced, but there are " +
                           std::to_string(offsets.size()) + " offsets and " + std::to_string(types.size()) + " types");
    read_tags();
    double begin = 0;
    for (std::size_t e = 0; e < types.size(); begin = offsets[e++]) {
      const double length = offsets[e] - begin;
      const int type = static_cast<int>(types[e]);
      if (!(begin >= 0 && offsets[e] <= static_cast<double>(connectivity.size()) && length == size_of(type, e)))
        throw File_error(filename_, 0,
                         "cell " + std::to_string(e) + " has " + std::to_string(length) +
                             " vertices, which doesn't fit its type");
      add(type, e, connectivity.data() + static_cast<std::size_t>(begin));
    }
  }

  /// Number of nodes of the types that can be read.
  double size_of(int type, std::size_t element) const
  {
    switch (type) {
    case 1:
      return 1;
    case 3:
      return 2;
    case 5:
      return 3;
    case 10:
      return 4;
    case 21:
      return 3;
    case 22:
      return 6;
    case 24:
      return 10;
    default:
      throw File_error(filename_, 0,
                       "cell " + std::to_string(element) + " is of VTK's type " + std::to_string(type) +
                           "; only tetrahedra (10, 24), triangles (5, 22), lines (3, 21) and vertices (1) can be read");
    }
  }

  void add(int type, std::size_t e, const double* vertices)
  {
    is_quadratic_ = is_quadratic_ || type > 10;
    if (type == 10 || type == 24) {
      soup_.cells.push_back(take<4>(vertices, e));
      if (!subdomains_.empty()) soup_.cell_tags.push_back(tag(subdomains_, e));
    } else if (type == 5 || type == 22) {
      soup_.facets.push_back(take<3>(vertices, e));
      if (!patches_.empty()) soup_.facet_tags.push_back(tag(patches_, e) + weft_tags_);
    } else if (type == 3 || type == 21) {
      soup_.edges.push_back(take<2>(vertices, e));
      if (!creases_.empty()) soup_.edge_tags.push_back(tag(creases_, e) + weft_tags_);
    } else {
      features_.emplace_back(feature_tags_.empty() ? 0 : tag(feature_tags_, e), take<1>(vertices, e)[0]);
    }
  }

  template <std::size_t N>
  std::array<std::size_t, N> take(const double* vertices, std::size_t e) const
  {
    std::array<std::size_t, N> result;
    for (std::size_t i = 0; i < N; ++i) {
      if (!(vertices[i] >= 0 && vertices[i] < static_cast<double>(soup_.points.size())))
        throw File_error(filename_, 0, "cell " + std::to_string(e) + " has a vertex that there isn't");
      result[i] = static_cast<std::size_t>(vertices[i]);
    }
    return result;
  }

  // ---- tags

  void read_tags()
  {
    const auto read = [this](const std::string& name) {
      auto numbers = arrays_.has("CellData", name) ? arrays_.numbers("CellData", name) : std::vector<double>();
      if (numbers.size() != arrays_.number_of_cells()) numbers.clear(); // vectors, or not there
      return numbers;
    };
    subdomains_ = read("subdomain");
    weft_tags_ = !subdomains_.empty();
    if (weft_tags_) {
      patches_ = read("patch");
      creases_ = read("crease");
      feature_tags_ = read("feature");
      return;
    }
    if (arrays_.has("CellData", "domain") && arrays_.has("CellData", "marker")) { // as weft writes planar meshes
      patches_ = read("domain");
      creases_ = read("marker");
      return;
    }
    for (const char* name :
         {"gmsh:physical", "medit:ref", "CellEntityIds", "MeshDomain", "cell_markers", "material", "region", "label"}) {
      subdomains_ = read(name);
      if (subdomains_.empty()) continue;
      patches_ = creases_ = subdomains_;
      return;
    }
  }

  int tag(const std::vector<double>& tags, std::size_t e) const
  {
    if (tags[e] != std::floor(tags[e]) || std::abs(tags[e]) > 1e9)
      throw File_error(filename_, 0, "the tag of cell " + std::to_string(e) + " should be an integer");
    return static_cast<int>(tags[e]);
  }

  std::string filename_;
  Vtu_arrays arrays_;
  Element_soup_3<K> soup_;
  std::vector<double> subdomains_, patches_, creases_, feature_tags_;
  bool is_quadratic_ = false;
  bool weft_tags_ = false; ///< patches and creases count from 0
  std::vector<std::pair<int, std::size_t>> features_;
};

} // namespace internal

namespace IO {

/// Reads the tetrahedra of a .vtu file, with triangles, lines and vertices of their boundary.
/// \throws File_error if the file is missing, cut, malformed or has other cells, or if its elements don't make
///   a mesh; see `assemble_mesh_3()`.
template <class K>
Imported_mesh_3<K> read_vtu_3(const std::string& filename)
{
  return weft::internal::assemble_from_file(filename, weft::internal::Vtu_reader_3<K>(filename).run());
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_VTU_3_H
