// SPDX-License-Identifier: GPL-3.0-or-later
//
// The version of weft. This is the only place where it is written down: CMake reads the three numbers from here.

#ifndef WEFT_VERSION_H
#define WEFT_VERSION_H

/// Grows when programs that use weft have to change.
#define WEFT_VERSION_MAJOR 0
/// Grows with what is new.
#define WEFT_VERSION_MINOR 1
/// Grows with corrections.
#define WEFT_VERSION_PATCH 0

/// One number that grows with the version, for comparisons in `#if`: 10000 major + 100 minor + patch.
#define WEFT_VERSION_NR (WEFT_VERSION_MAJOR * 10000 + WEFT_VERSION_MINOR * 100 + WEFT_VERSION_PATCH)

#define WEFT_INTERNAL_STRING_OF(x) #x
#define WEFT_INTERNAL_DOTTED(x, y, z)                                                                                  \
  WEFT_INTERNAL_STRING_OF(x) "." WEFT_INTERNAL_STRING_OF(y) "." WEFT_INTERNAL_STRING_OF(z)

/// The version as a string literal, `"major.minor.patch"`.
#define WEFT_VERSION WEFT_INTERNAL_DOTTED(WEFT_VERSION_MAJOR, WEFT_VERSION_MINOR, WEFT_VERSION_PATCH)

#endif // WEFT_VERSION_H
