// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads surfaces from 3MF files through lib3mf 1.8: the meshes of everything that is to be built, each item a solid
// with the name of its object. Programs that define WEFT_LINKED_WITH_LIB3MF and link lib3MF have it.

#ifndef WEFT_IO_INTERNAL_READ_3MF_SURFACE_H
#define WEFT_IO_INTERNAL_READ_3MF_SURFACE_H
#ifdef WEFT_LINKED_WITH_LIB3MF

#include <weft/errors.h>
#include <weft/IO/internal/Group_collector.h>
#include <weft/spatial/surface/Polygon_soup_3.h>

#include <Model/COM/NMR_DLLInterfaces.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// Something of lib3mf's that is released in the end.
class Lib3mf_handle
{
public:
  Lib3mf_handle() = default;
  Lib3mf_handle(const Lib3mf_handle&) = delete;
  Lib3mf_handle& operator=(const Lib3mf_handle&) = delete;
  ~Lib3mf_handle()
  {
    if (handle_) NMR::lib3mf_release(handle_);
  }

  NMR::PLib3MFBase* get() const { return handle_; }
  NMR::PLib3MFBase** out() { return &handle_; }

private:
  NMR::PLib3MFBase* handle_ = nullptr;
};

/// See the top of the file. \tparam K a CGAL kernel.
template <class K>
class Lib3mf_reader
{
  /// Rows of an affine map.
  using Map = std::array<std::array<double, 4>, 3>;

public:
  explicit Lib3mf_reader(const std::string& filename) : filename_(filename) {}

  /// \throws File_error.
  Polygon_soup_3<K> read()
  {
    Lib3mf_handle model, reader, items;
    check(NMR::lib3mf_createmodel(model.out()), "lib3mf doesn't work");
    check(NMR::lib3mf_model_queryreader(model.get(), "3mf", reader.out()), "lib3mf has no reader");
    check(NMR::lib3mf_reader_readfromfileutf8(reader.get(), filename_.c_str()), "can't be read as a 3MF file");
    check(NMR::lib3mf_model_getbuilditems(model.get(), items.out()));
    for (;;) {
      BOOL has_next = 0, has_map = 0;
      check(NMR::lib3mf_builditemiterator_movenext(items.get(), &has_next));
      if (!has_next) break;
      Lib3mf_handle item, object;
      check(NMR::lib3mf_builditemiterator_getcurrent(items.get(), item.out()));
      check(NMR::lib3mf_builditem_getobjectresource(item.get(), object.out()));
      NMR::MODELTRANSFORM transform;
      check(NMR::lib3mf_builditem_hasobjecttransform(item.get(), &has_map));
      if (has_map) check(NMR::lib3mf_builditem_getobjecttransform(item.get(), &transform));
      solids_.enter_another(name_of(object));
      add(object, has_map ? map_of(transform) : identity(), 0);
    }
    solids_.finish(soup_);
    soup_.groups_are_solids = !soup_.groups.empty();
    return std::move(soup_);
  }

private:
  void check(LIB3MFRESULT result, const char* what = "is damaged") const
  {
    if (result != 0) throw File_error(filename_, 0, what);
  }

  static Map identity() { return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}; }
  static Map map_of(const NMR::MODELTRANSFORM& transform)
  {
    Map map{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j) map[i][j] = static_cast<double>(transform.m_fFields[i][j]);
    return map;
  }
  /// First the second, then the first.
  static Map product(const Map& first, const Map& second)
  {
    Map map{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        map[i][j] = j == 3 ? first[i][3] : 0;
        for (std::size_t k = 0; k < 3; ++k) map[i][j] += first[i][k] * second[k][j];
      }
    return map;
  }

  static std::string name_of(const Lib3mf_handle& object)
  {
    ULONG needed = 0;
    if (NMR::lib3mf_object_getnameutf8(object.get(), nullptr, 0, &needed) != 0 || needed == 0) return "";
    std::string name(static_cast<std::size_t>(needed) + 1, '\0');
    if (NMR::lib3mf_object_getnameutf8(object.get(), &name[0], static_cast<ULONG>(name.size()), &needed) != 0)
      return "";
    return name.substr(0, name.find('\0'));
  }

  /// Adds an object, which has a mesh or consists of others.
  void add(const Lib3mf_handle& object, const Map& map, int depth)
  {
    if (depth > 100) throw File_error(filename_, 0, "an object contains itself");
    BOOL is_mesh = 0, has_components = 0;
    check(NMR::lib3mf_object_ismeshobject(object.get(), &is_mesh));
    if (is_mesh) add_mesh(object, map);
    check(NMR::lib3mf_object_iscomponentsobject(object.get(), &has_components));
    if (!has_components) return;
    DWORD components = 0;
    check(NMR::lib3mf_componentsobject_getcomponentcount(object.get(), &components));
    for (DWORD i = 0; i < components; ++i) {
      Lib3mf_handle component, part;
      BOOL has_map = 0;
      NMR::MODELTRANSFORM transform;
      check(NMR::lib3mf_componentsobject_getcomponent(object.get(), i, component.out()));
      check(NMR::lib3mf_component_getobjectresource(component.get(), part.out()));
      check(NMR::lib3mf_component_hastransform(component.get(), &has_map));
      if (has_map) check(NMR::lib3mf_component_gettransform(component.get(), &transform));
      add(part, has_map ? product(map, map_of(transform)) : map, depth + 1);
    }
  }

  void add_mesh(const Lib3mf_handle& object, const Map& map)
  {
    DWORD points = 0, triangles = 0;
    check(NMR::lib3mf_meshobject_getvertexcount(object.get(), &points));
    check(NMR::lib3mf_meshobject_gettrianglecount(object.get(), &triangles));
    std::vector<NMR::MODELMESHVERTEX> vertices(points + 1);
    std::vector<NMR::MODELMESHTRIANGLE> corners(triangles + 1);
    check(NMR::lib3mf_meshobject_getvertices(object.get(), vertices.data(), points, nullptr));
    check(NMR::lib3mf_meshobject_gettriangleindices(object.get(), corners.data(), triangles, nullptr));
    const std::size_t first = soup_.points.size();
    for (DWORD v = 0; v < points; ++v) {
      std::array<double, 3> p{};
      for (std::size_t i = 0; i < 3; ++i) {
        p[i] = map[i][3];
        for (std::size_t k = 0; k < 3; ++k) p[i] += map[i][k] * static_cast<double>(vertices[v].m_fPosition[k]);
      }
      soup_.points.emplace_back(p[0], p[1], p[2]);
    }
    for (DWORD t = 0; t < triangles; ++t) {
      soup_.polygons.emplace_back();
      for (const DWORD v : corners[t].m_nIndices) {
        if (v >= points) throw File_error(filename_, 0, "a triangle refers to a vertex that doesn't exist");
        soup_.polygons.back().push_back(first + v);
      }
      solids_.add_facet();
    }
  }

  std::string filename_;
  Polygon_soup_3<K> soup_;
  Group_collector solids_;
};

/// Reads a 3MF file.
template <class K>
Polygon_soup_3<K> read_3mf_surface(const std::string& filename)
{
  return Lib3mf_reader<K>(filename).read();
}

} // namespace weft::internal

#endif // WEFT_LINKED_WITH_LIB3MF
#endif // WEFT_IO_INTERNAL_READ_3MF_SURFACE_H
