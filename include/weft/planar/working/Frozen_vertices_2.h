// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices that have to stay as they are while others are improved, by their numbers.

#ifndef WEFT_PLANAR_WORKING_FROZEN_VERTICES_2_H
#define WEFT_PLANAR_WORKING_FROZEN_VERTICES_2_H

#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// None at first. Vertices that come later aren't frozen.
class Frozen_vertices_2
{
public:
  /// \param flags by number.
  void assign(std::vector<char> flags) { flags_ = std::move(flags); }

  bool contains(int id) const
  {
    const auto n = static_cast<std::size_t>(id);
    return n < flags_.size() && flags_[n];
  }

  void thaw(std::size_t id)
  {
    if (id < flags_.size()) flags_[id] = false;
  }

  /// \param old_ids of each vertex its number before, or -1 where it had none.
  void renumber(const std::vector<int>& old_ids)
  {
    if (flags_.empty()) return;
    std::vector<char> flags;
    flags.reserve(old_ids.size());
    for (const int old : old_ids) flags.push_back(contains(old));
    flags_ = std::move(flags);
  }

private:
  std::vector<char> flags_;
};

/// The vertices of a Working_mesh_2 that aren't frozen.
template <class Mesh>
std::vector<typename Mesh::Vertex_handle> movable_vertices_2(const Mesh& mesh)
{
  std::vector<typename Mesh::Vertex_handle> result;
  for (const auto v : mesh.vertices())
    if (!mesh.is_frozen(v)) result.push_back(v);
  return result;
}

} // namespace weft::internal

#endif // WEFT_PLANAR_WORKING_FROZEN_VERTICES_2_H
