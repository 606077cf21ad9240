// SPDX-License-Identifier: GPL-3.0-or-later
//
// The extent of a triangulation that is to be meshed, and whether numbers can cope with it.

#ifndef WEFT_PLANAR_WORKING_CHECKED_BOX_2_H
#define WEFT_PLANAR_WORKING_CHECKED_BOX_2_H

#include <weft/errors.h>
#include <weft/internal/cold.h>

#include <CGAL/Bbox_2.h>

#include <algorithm>

namespace weft::internal {

/// \throws Domain_error if the points don't span the plane or are out of range.
template <class Cdt>
WEFT_COLD CGAL::Bbox_2 checked_box_2(const Cdt& cdt)
{
  if (cdt.dimension() < 2) throw Domain_error("the domain is empty: its points don't span the plane", {}, {});
  CGAL::Bbox_2 box;
  for (const auto v : cdt.finite_vertex_handles()) box += v->point().bbox();
  const double extent = (std::max)(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  // Beyond these, fourth powers of lengths leave the range of double.
  if (!(extent > 1e-60 && extent < 1e60))
    throw Domain_error("coordinates out of range: the domain's extent must lie between 1e-60 and 1e60", {}, {});
  return box;
}

} // namespace weft::internal

#endif // WEFT_PLANAR_WORKING_CHECKED_BOX_2_H
