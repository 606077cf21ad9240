// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names that users give the parts of a domain, for the formats of files that have some.

#ifndef WEFT_SPATIAL_MESH_MESH_NAMES_3_H
#define WEFT_SPATIAL_MESH_MESH_NAMES_3_H

#include <map>
#include <string>

namespace weft {

/// Names of subdomains and patches by their numbers; what isn't in here has none.
struct Mesh_names_3
{
  std::map<int, std::string> subdomains, patches;
};

} // namespace weft

#endif // WEFT_SPATIAL_MESH_MESH_NAMES_3_H
