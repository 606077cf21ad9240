// SPDX-License-Identifier: GPL-3.0-or-later

#include "files.h"

#include <weft/IO/read_sizing_3.h>
#include <weft/IO/read_tetrahedral_mesh.h>

namespace spatial_files {

weft::Imported_mesh_3<K> read_mesh(const std::string& filename)
{
  return weft::IO::read_tetrahedral_mesh<K>(filename);
}

std::function<double(const K::Point_3&)> read_sizes(const std::string& filename)
{
  return weft::IO::read_sizing_3<K>(filename);
}

} // namespace spatial_files
