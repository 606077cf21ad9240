// SPDX-License-Identifier: GPL-3.0-or-later
//
// What domain oracles answer with: points of the boundary and of creases.

#ifndef WEFT_SPATIAL_DOMAIN_ORACLE_HITS_3_H
#define WEFT_SPATIAL_DOMAIN_ORACLE_HITS_3_H

namespace weft {

/// A point of the boundary and the patch that it lies on.
template <class K>
struct Surface_hit_3
{
  typename K::Point_3 point;
  int patch;
  int triangle = -1; ///< number that the oracle knows the normal there by; -1 if it has none
};

/// A point of a crease and the number of that crease.
template <class K>
struct Crease_hit_3
{
  typename K::Point_3 point;
  int crease;
};

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_ORACLE_HITS_3_H
