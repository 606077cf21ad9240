// SPDX-License-Identifier: GPL-3.0-or-later
//
// How `transfer_2()` and `transfer_3()` carry values at vertices from one mesh to another.

#ifndef WEFT_TRANSFER_H
#define WEFT_TRANSFER_H

namespace weft {

/// How values are carried over.
enum class Transfer
{
  interpolated, ///< the old function at the new vertices: second order, but integrals change
  conserving    ///< means of the old function around the new vertices: integrals stay, and peaks flatten a little
};

} // namespace weft

#endif // WEFT_TRANSFER_H
