// SPDX-License-Identifier: GPL-3.0-or-later
//
// Four floats at a time: SSE2 where the processor has it, which every x86-64 has, and plain loops elsewhere. The
// bounding volume hierarchies test four boxes or four triangles with one such operation.

#ifndef WEFT_INTERNAL_BOXES_FLOAT_4_H
#define WEFT_INTERNAL_BOXES_FLOAT_4_H

#if defined(__SSE2__) || defined(_M_X64)
#include <emmintrin.h>

namespace weft::internal {

/// One truth value for each of four lanes.
struct Mask_4
{
  __m128 value;
  /// Bit i is set where lane i is true.
  unsigned bits() const { return static_cast<unsigned>(_mm_movemask_ps(value)); }
};
inline Mask_4 operator&(Mask_4 a, Mask_4 b)
{
  return {_mm_and_ps(a.value, b.value)};
}
inline Mask_4 operator|(Mask_4 a, Mask_4 b)
{
  return {_mm_or_ps(a.value, b.value)};
}

/// Four floats. A comparison with NaN is false.
struct Float_4
{
  __m128 value;
  Float_4() : value(_mm_setzero_ps()) {}
  Float_4(__m128 v) : value(v) {}
  Float_4(float v) : value(_mm_set1_ps(v)) {}
  /// \param address aligned to 16 bytes.
  static Float_4 load(const float* address) { return _mm_load_ps(address); }
  void store(float* address) const { _mm_store_ps(address, value); }
};
inline Float_4 operator+(Float_4 a, Float_4 b)
{
  return _mm_add_ps(a.value, b.value);
}
inline Float_4 operator-(Float_4 a, Float_4 b)
{
  return _mm_sub_ps(a.value, b.value);
}
inline Float_4 operator*(Float_4 a, Float_4 b)
{
  return _mm_mul_ps(a.value, b.value);
}
inline Float_4 min(Float_4 a, Float_4 b)
{
  return _mm_min_ps(a.value, b.value);
}
inline Float_4 max(Float_4 a, Float_4 b)
{
  return _mm_max_ps(a.value, b.value);
}
inline Float_4 square_root(Float_4 a)
{
  return _mm_sqrt_ps(a.value);
}
inline Mask_4 operator<(Float_4 a, Float_4 b)
{
  return {_mm_cmplt_ps(a.value, b.value)};
}
inline Mask_4 operator<=(Float_4 a, Float_4 b)
{
  return {_mm_cmple_ps(a.value, b.value)};
}
/// The smallest of the four, lanes with NaN left out or not.
inline float smallest(Float_4 a)
{
  const __m128 pairs = _mm_min_ps(a.value, _mm_movehl_ps(a.value, a.value));
  return _mm_cvtss_f32(_mm_min_ss(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
}
/// `a` where the mask is true, `b` elsewhere.
inline Float_4 select(Mask_4 mask, Float_4 a, Float_4 b)
{
  return _mm_or_ps(_mm_and_ps(mask.value, a.value), _mm_andnot_ps(mask.value, b.value));
}

} // namespace weft::internal

#else
#include <algorithm>
#include <cmath>

namespace weft::internal {

struct Mask_4
{
  unsigned value;
  unsigned bits() const { return value; }
};
inline Mask_4 operator&(Mask_4 a, Mask_4 b)
{
  return {a.value & b.value};
}
inline Mask_4 operator|(Mask_4 a, Mask_4 b)
{
  return {a.value | b.value};
}

struct Float_4
{
  float value[4];
  Float_4() : value{0, 0, 0, 0} {}
  Float_4(float v) : value{v, v, v, v} {}
  static Float_4 load(const float* address)
  {
    Float_4 result;
    for (int i = 0; i < 4; ++i) result.value[i] = address[i];
    return result;
  }
  void store(float* address) const
  {
    for (int i = 0; i < 4; ++i) address[i] = value[i];
  }
};

template <class Operation>
Float_4 map(Float_4 a, Float_4 b, Operation operation)
{
  for (int i = 0; i < 4; ++i) a.value[i] = operation(a.value[i], b.value[i]);
  return a;
}
template <class Relation>
Mask_4 compare(Float_4 a, Float_4 b, Relation relation)
{
  Mask_4 mask{0};
  for (int i = 0; i < 4; ++i) mask.value |= static_cast<unsigned>(relation(a.value[i], b.value[i])) << i;
  return mask;
}
inline Float_4 operator+(Float_4 a, Float_4 b)
{
  return map(a, b, [](float x, float y) { return x + y; });
}
inline Float_4 operator-(Float_4 a, Float_4 b)
{
  return map(a, b, [](float x, float y) { return x - y; });
}
inline Float_4 operator*(Float_4 a, Float_4 b)
{
  return map(a, b, [](float x, float y) { return x * y; });
}
inline Float_4 min(Float_4 a, Float_4 b)
{
  return map(a, b, [](float x, float y) { return x < y ? x : y; });
}
inline Float_4 max(Float_4 a, Float_4 b)
{
  return map(a, b, [](float x, float y) { return x > y ? x : y; });
}
inline Float_4 square_root(Float_4 a)
{
  return map(a, a, [](float x, float) { return std::sqrt(x); });
}
inline Mask_4 operator<(Float_4 a, Float_4 b)
{
  return compare(a, b, [](float x, float y) { return x < y; });
}
inline Mask_4 operator<=(Float_4 a, Float_4 b)
{
  return compare(a, b, [](float x, float y) { return x <= y; });
}
inline float smallest(Float_4 a)
{
  return std::min(std::min(a.value[0], a.value[1]), std::min(a.value[2], a.value[3]));
}
inline Float_4 select(Mask_4 mask, Float_4 a, Float_4 b)
{
  for (int i = 0; i < 4; ++i)
    if (!(mask.value >> i & 1)) a.value[i] = b.value[i];
  return a;
}

} // namespace weft::internal

#endif // four lanes

#endif // WEFT_INTERNAL_BOXES_FLOAT_4_H
