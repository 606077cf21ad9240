// SPDX-License-Identifier: GPL-3.0-or-later
//
// What planar meshers require of their arguments at compile time, as one sentence for each mistake.

#ifndef WEFT_PLANAR_RUN_PLANAR_REQUIREMENTS_2_H
#define WEFT_PLANAR_RUN_PLANAR_REQUIREMENTS_2_H

#include <weft/internal/Answers.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/number_utils.h>

#include <type_traits>
#include <utility>

namespace CGAL {
template <class Tr>
class Triangulation_hierarchy_2;
} // namespace CGAL

namespace weft::internal {

// Each class tells whether its requirements hold; `complain()` is the sentence if not, and is instantiated only then,
// so that nothing else is complained about.

/// A triangulation that weft can mesh.
template <class Cdt>
struct Mesh_triangulation_requirements_2
{
private:
  template <class Gt, class Tds, class Itag>
  static std::true_type constrained_delaunay(const CGAL::Constrained_Delaunay_triangulation_2<Gt, Tds, Itag>*);
  static std::false_type constrained_delaunay(const void*);
  template <class Tr>
  static std::true_type layered(const CGAL::Triangulation_hierarchy_2<Tr>*);
  static std::false_type layered(const void*);

  template <class T>
  using Vertex_id = decltype(std::declval<typename T::Vertex&>().set_id(0), std::declval<typename T::Vertex&>().id());
  template <class T>
  using Vertex_constraint_of =
      decltype(std::declval<typename T::Vertex&>().set_constraint(0), std::declval<typename T::Vertex&>().constraint());
  template <class T>
  using Face_id = decltype(std::declval<typename T::Face&>().set_id(0), std::declval<typename T::Face&>().id());
  template <class T>
  using Face_in_domain =
      decltype(std::declval<typename T::Face&>().set_in_domain(true), std::declval<typename T::Face&>().is_in_domain());

  static constexpr bool is_constrained_delaunay = decltype(constrained_delaunay(static_cast<Cdt*>(nullptr)))::value;
  static constexpr bool is_layered = decltype(layered(static_cast<Cdt*>(nullptr)))::value;
  static constexpr bool has_bases = answers_v<int, Vertex_id, Cdt> && answers_v<int, Vertex_constraint_of, Cdt> &&
                                    answers_v<int, Face_id, Cdt> && answers_v<bool, Face_in_domain, Cdt>;

public:
  static constexpr bool holds = is_constrained_delaunay && !is_layered && has_bases;

  static void complain()
  {
    static_assert(is_layered || is_constrained_delaunay,
                  "weft: not a CGAL::Constrained_Delaunay_triangulation_2; use weft::Mesh_triangulation_2<K>");
    static_assert(!is_layered,
                  "weft: Triangulation_hierarchy_2 would lose its layers; use weft::Mesh_triangulation_2<K>");
    static_assert(
        is_layered || !is_constrained_delaunay || has_bases,
        "weft: the triangulation lacks weft's bases; use weft::Mesh_triangulation_2<K>, or vertices and faces "
        "with the members listed in doc/concepts/mesh_bases.h");
  }
};

/// A sizing field for such a triangulation.
template <class Sizing, class Point>
struct Sizing_requirements_2
{
private:
  template <class S>
  using Size = decltype(CGAL::to_double(std::declval<S>()(std::declval<const Point&>())));

  static constexpr bool is_callable = std::is_invocable_v<const Sizing&, const Point&>;
  static constexpr bool is_const = is_callable || !std::is_invocable_v<Sizing&, const Point&>;
  static constexpr bool gives_numbers = answers_v<double, Size, const Sizing&>;

public:
  static constexpr bool holds = is_callable && gives_numbers;

  static void complain()
  {
    static_assert(is_callable || !is_const,
                  "weft: a sizing field is a number, or is called with a point of the triangulation, `Cdt::Point`, and "
                  "returns the longest edge there; this one can't be called with such a point");
    static_assert(is_const,
                  "weft: a sizing field is called as const: its `operator()` needs `const`, a lambda must not "
                  "be `mutable`");
    static_assert(!is_callable || gives_numbers, "weft: a sizing field returns a number, the longest edge at a point");
  }
};

/// Both; the sizing field isn't looked at where the triangulation is wrong.
template <class Cdt, class Sizing, bool = Mesh_triangulation_requirements_2<Cdt>::holds>
struct Planar_requirements_2 : Sizing_requirements_2<Sizing, typename Cdt::Point>
{};
template <class Cdt, class Sizing>
struct Planar_requirements_2<Cdt, Sizing, false> : Mesh_triangulation_requirements_2<Cdt>
{};

} // namespace weft::internal

#endif // WEFT_PLANAR_RUN_PLANAR_REQUIREMENTS_2_H
