// SPDX-License-Identifier: GPL-3.0-or-later
//
// Everything that differs between the CGAL releases weft compiles with (5.5 and later, 6.x), each difference behind
// one name. No other header of weft looks at CGAL_VERSION_NR.

#ifndef WEFT_INTERNAL_CGAL_VERSION_H
#define WEFT_INTERNAL_CGAL_VERSION_H

#include <CGAL/version.h>

// CGAL_VERSION_NR reads 1MMmmb1000: major, minor, bugfix.
#if CGAL_VERSION_NR < 1050500000
#error "weft needs CGAL 5.5 or later"
#endif

#if CGAL_VERSION_NR >= 1060000000
#include <variant>
#else
#include <boost/variant/get.hpp>
#endif

namespace weft::internal {

/// The alternative `T` of what `CGAL::intersection()` returned, or null when the intersection is empty or something
/// else. The result is an optional variant of boost up to CGAL 5.6, of the standard library from 6.0 on.
template <class T, class Result>
const T* intersection_as(const Result& result)
{
  if (!result) return nullptr;
#if CGAL_VERSION_NR >= 1060000000
  return std::get_if<T>(&*result);
#else
  return boost::get<T>(&*result);
#endif
}

} // namespace weft::internal

#endif // WEFT_INTERNAL_CGAL_VERSION_H
