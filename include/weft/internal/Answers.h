// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a type has a member that a concept asks for: what the sentences about wrong arguments are decided by. Not
// meant for users.

#ifndef WEFT_INTERNAL_ANSWERS_H
#define WEFT_INTERNAL_ANSWERS_H

#include <type_traits>

namespace weft::internal {

template <class Result, template <class> class Expression, class T, class = void>
struct Answers : std::false_type
{};
template <class Result, template <class> class Expression, class T>
struct Answers<Result, Expression, T, std::void_t<Expression<T>>>
    : std::bool_constant<std::is_void_v<Result> || std::is_convertible_v<Expression<T>, Result>>
{};

/// Whether `Expression<T>`, usually the type of a call, exists and converts to `Result`, or exists where that is void.
template <class Result, template <class> class Expression, class T>
inline constexpr bool answers_v = Answers<Result, Expression, T>::value;

/// Takes any arguments and does nothing: for calls that take a visitor and are only looked at.
struct Ignore
{
  template <class... Arguments>
  void operator()(const Arguments&...) const
  {}
};

/// False, but not before a template is instantiated: for overloads that only say why they are wrong.
template <class...>
inline constexpr bool never_v = false;

} // namespace weft::internal

#endif // WEFT_INTERNAL_ANSWERS_H
