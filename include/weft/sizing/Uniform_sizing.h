// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sizing field that is the same everywhere, and the trait by which algorithms recognise it.
//
// A sizing field is any callable `FT operator()(const Point&) const` that returns the target edge length at a point, in
// the input's units. With a constant density the centroids of Lloyd's relaxation have closed forms (Tournois 2009,
// sec. 2.2.2): algorithms ask `is_uniform_sizing` at compile time and skip the quadrature.

#ifndef WEFT_SIZING_UNIFORM_SIZING_H
#define WEFT_SIZING_UNIFORM_SIZING_H

#include <weft/errors.h>

#include <cmath>
#include <type_traits>

namespace weft {

/// Sizing field that returns one length at every point, in any dimension.
/// \tparam FT number type of the length.
template <class FT = double>
class Uniform_sizing
{
public:
  /// \param size target edge length, in the input's units.
  /// \throws Option_error unless `size` is positive and finite.
  explicit Uniform_sizing(const FT& size) : size_(size)
  {
    if (!(size > FT(0)) || !std::isfinite(static_cast<double>(size)))
      throw Option_error("Uniform_sizing: the size must be positive and finite");
  }

  template <class Point>
  const FT& operator()(const Point&) const
  {
    return size_;
  }

  /// The length that the field returns everywhere.
  const FT& size() const { return size_; }

private:
  FT size_;
};

/// True for fields that are the same everywhere and have `size()`. Specialise it for your own.
template <class Sizing>
struct is_uniform_sizing : std::false_type
{};
template <class FT>
struct is_uniform_sizing<Uniform_sizing<FT>> : std::true_type
{};
template <class Sizing>
struct is_uniform_sizing<const Sizing> : is_uniform_sizing<Sizing>
{};
template <class Sizing>
struct is_uniform_sizing<Sizing&> : is_uniform_sizing<Sizing>
{};
/// The value of `is_uniform_sizing`.
template <class Sizing>
inline constexpr bool is_uniform_sizing_v = is_uniform_sizing<Sizing>::value;

} // namespace weft

#endif // WEFT_SIZING_UNIFORM_SIZING_H
