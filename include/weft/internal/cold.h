// SPDX-License-Identifier: GPL-3.0-or-later
//
// Marks for functions that run rarely or call others that take far longer: compilers needn't inline into them what
// makes loops fast. Half of the time to compile a program that writes a mesh would go there.

#ifndef WEFT_INTERNAL_COLD_H
#define WEFT_INTERNAL_COLD_H

#if defined(__GNUC__)
/// Kept out of its callers.
#define WEFT_NOINLINE [[gnu::noinline]]
/// Kept out of its callers, and small rather than fast.
#define WEFT_COLD [[gnu::cold, gnu::noinline]]
#else
#define WEFT_NOINLINE
#define WEFT_COLD
#endif

#endif // WEFT_INTERNAL_COLD_H
