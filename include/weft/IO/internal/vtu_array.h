// SPDX-License-Identifier: GPL-3.0-or-later
//
// The frame of a data array in a .vtu file, shared by the planar and the spatial writer.

#ifndef WEFT_IO_INTERNAL_VTU_ARRAY_H
#define WEFT_IO_INTERNAL_VTU_ARRAY_H

#include <weft/IO/internal/Text_writer.h>

#include <string>

namespace weft::internal {

inline Text_writer& begin_vtu_array(Text_writer& out, const std::string& type, const std::string& name)
{
  return out << "        <DataArray type=\"" << type << "\" Name=\"" << name << "\" format=\"ascii\">\n";
}

inline void end_vtu_array(Text_writer& out)
{
  out << "        </DataArray>\n";
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_VTU_ARRAY_H
