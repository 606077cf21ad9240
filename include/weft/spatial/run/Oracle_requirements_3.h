// SPDX-License-Identifier: GPL-3.0-or-later
//
// What spatial meshers require of a domain oracle at compile time, as one sentence for each member that is missing. Not
// meant for users: they read doc/concepts/DomainOracle_3.h.

#ifndef WEFT_SPATIAL_RUN_ORACLE_REQUIREMENTS_3_H
#define WEFT_SPATIAL_RUN_ORACLE_REQUIREMENTS_3_H

#include <weft/internal/Answers.h>
#include <weft/report.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/domain/oracle_hits_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/Bbox_3.h>

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft::internal {

/// Whether a type has a kernel with coordinates that are doubles.
template <class T, class = void>
struct Has_double_kernel : std::false_type
{};
template <class T>
struct Has_double_kernel<T, std::void_t<typename T::Kernel::FT>> : std::is_same<typename T::Kernel::FT, double>
{};

/// Arguments of calls that are only looked at.
template <class Oracle>
struct Oracle_arguments_3
{
  using Kernel = typename Oracle::Kernel;
  using Point = typename Kernel::Point_3;
  using Hit = Surface_hit_3<Kernel>;

  /// A visitor of folds.
  struct Visit
  {
    void operator()(const Point&, bool) const;
    void operator()(const Point&, const Point&, bool) const;
    void operator()(const Point&, const Vertex_location_3&) const;
    void operator()(int, double) const;
  };

  static const Oracle& o();
  static const Point& p();
  static Point& moved();
  static Hit& hit();
  static std::vector<Hit>& hits();
  static const Visit& visit();
};

template <class O>
using Is_thread_safe_of = decltype(O::is_thread_safe);
template <class O>
using Labels_first_of = decltype(O::labels_first);
template <class O>
using Bbox_of = decltype(Oracle_arguments_3<O>::o().bbox());
template <class O>
using Subdomain_of = decltype(Oracle_arguments_3<O>::o().subdomain(Oracle_arguments_3<O>::p()));
template <class O>
using Intersect_of = decltype(Oracle_arguments_3<O>::o().intersect(
    Oracle_arguments_3<O>::p(), Oracle_arguments_3<O>::p(), Oracle_arguments_3<O>::hits()));
template <class O>
using Intersect_labelled_of = decltype(Oracle_arguments_3<O>::o().intersect(
    Oracle_arguments_3<O>::p(), Oracle_arguments_3<O>::p(), 0, 0, Oracle_arguments_3<O>::hits()));
template <class O>
using Closest_of = decltype(Oracle_arguments_3<O>::o().closest(Oracle_arguments_3<O>::p()));
template <class O>
using Is_within_of = decltype(Oracle_arguments_3<O>::o().is_within(Oracle_arguments_3<O>::p(), 1.));
template <class O>
using Is_clear_of = decltype(Oracle_arguments_3<O>::o().is_clear(Oracle_arguments_3<O>::p(), 1.));
template <class O>
using Number_of_patches_of = decltype(Oracle_arguments_3<O>::o().number_of_patches());
template <class O>
using Is_expected_of = decltype(Oracle_arguments_3<O>::o().is_expected(0));
template <class O>
using Project_on_patch_of = decltype(Oracle_arguments_3<O>::o().project_on_patch(Oracle_arguments_3<O>::p(), 0));
template <class O>
using Patch_seeds_of = decltype(Oracle_arguments_3<O>::o().patch_seeds(0, std::size_t(1)));
template <class O>
using Number_of_corners_of = decltype(Oracle_arguments_3<O>::o().number_of_corners());
template <class O>
using Corner_of = decltype(Oracle_arguments_3<O>::o().corner(std::size_t(0)));
template <class O>
using Number_of_creases_of = decltype(Oracle_arguments_3<O>::o().number_of_creases());
template <class O>
using Crease_points_of = decltype(Oracle_arguments_3<O>::o().crease_points(0));
template <class O>
using Crease_is_closed_of = decltype(Oracle_arguments_3<O>::o().crease_is_closed(0));
template <class O>
using Project_on_crease_of = decltype(Oracle_arguments_3<O>::o().project_on_crease(Oracle_arguments_3<O>::p(), 0));
template <class O>
using Incidence_of = decltype(Oracle_arguments_3<O>::o().incidence());
template <class O>
using Attract_of = decltype(Oracle_arguments_3<O>::o().attract(Oracle_arguments_3<O>::moved(), 1., 1., 0));
template <class O>
using Visit_salient_points_of = decltype(Oracle_arguments_3<O>::o().visit_salient_points(
    Oracle_arguments_3<O>::p(), 1., 0, Oracle_arguments_3<O>::visit()));
template <class O>
using Visit_ridges_of = decltype(Oracle_arguments_3<O>::o().visit_ridges(Oracle_arguments_3<O>::p(), 1., 0,
                                                                         Oracle_arguments_3<O>::visit()));
template <class O>
using Is_at_acute_edge_of = decltype(Oracle_arguments_3<O>::o().is_at_acute_edge(Oracle_arguments_3<O>::p(), 1.));
template <class O>
using Mirror_at_acute_edge_of = decltype(Oracle_arguments_3<O>::o().mirror_at_acute_edge(
    Oracle_arguments_3<O>::p(), Oracle_arguments_3<O>::p(), 1., Oracle_arguments_3<O>::hit()));
template <class O>
using Attract_to_acute_edge_of =
    decltype(Oracle_arguments_3<O>::o().attract_to_acute_edge(Oracle_arguments_3<O>::moved(), 1.));

template <class O>
using Acute_angle_at_of = decltype(Oracle_arguments_3<O>::o().acute_angle_at(Oracle_arguments_3<O>::p(), 1.));
template <class O>
using Has_mirror_images_of = decltype(Oracle_arguments_3<O>::o().has_mirror_images());
template <class O>
using Visit_mirror_images_of = decltype(Oracle_arguments_3<O>::o().visit_mirror_images(
    Oracle_arguments_3<O>::p(), Vertex_location_3{2, 0}, 1., Oracle_arguments_3<O>::visit()));
template <class O>
using Visit_creases_at_small_angles_of =
    decltype(Oracle_arguments_3<O>::o().visit_creases_at_small_angles(0, Oracle_arguments_3<O>::visit()));

/// What a domain oracle answers. `holds` is false where it doesn't; `complain()` says what is missing, and is
/// instantiated only then, so that nothing else is complained about.
template <class Oracle>
struct Oracle_requirements_3
{
private:
  using Point = typename Oracle::Kernel::Point_3;
  using Hit = Surface_hit_3<typename Oracle::Kernel>;

  template <class Result, template <class> class Call>
  static constexpr bool has = answers_v<Result, Call, Oracle>;

  static constexpr bool looks_at_labels_first()
  {
    if constexpr (has<bool, Labels_first_of>)
      return Oracle::labels_first;
    else
      return false;
  }

  enum Member
  {
    thread_safety,
    label_precedence,
    bbox,
    subdomain,
    intersect,
    labelled_intersect,
    closest,
    is_within,
    is_clear,
    number_of_patches,
    is_expected,
    project_on_patch,
    patch_seeds,
    number_of_corners,
    corner,
    number_of_creases,
    crease_points,
    crease_is_closed,
    project_on_crease,
    incidence,
    folds,
    number_of_members
  };

  /// By member; those about folds count as one, since they come together, from a base.
  static constexpr std::array<bool, number_of_members> is_there{
      has<bool, Is_thread_safe_of>,
      has<bool, Labels_first_of>,
      has<CGAL::Bbox_3, Bbox_of>,
      has<int, Subdomain_of>,
      has<int, Intersect_of>,
      !looks_at_labels_first() || has<int, Intersect_labelled_of>,
      has<Hit, Closest_of>,
      has<bool, Is_within_of>,
      has<bool, Is_clear_of>,
      has<int, Number_of_patches_of>,
      has<bool, Is_expected_of>,
      has<Hit, Project_on_patch_of>,
      has<std::vector<Hit>, Patch_seeds_of>,
      has<std::size_t, Number_of_corners_of>,
      has<Point, Corner_of>,
      has<std::size_t, Number_of_creases_of>,
      has<std::vector<Point>, Crease_points_of>,
      has<bool, Crease_is_closed_of>,
      has<Point, Project_on_crease_of>,
      has<Feature_incidence_3, Incidence_of>,
      has<bool, Attract_of>&& has<void, Visit_salient_points_of>&& has<void, Visit_ridges_of>&&
          has<bool, Is_at_acute_edge_of>&& has<bool, Mirror_at_acute_edge_of>&& has<bool, Attract_to_acute_edge_of>&&
              has<double, Acute_angle_at_of>&& has<bool, Has_mirror_images_of>&& has<void, Visit_mirror_images_of>&&
                  has<void, Visit_creases_at_small_angles_of>};

  static constexpr int missing_before(int end)
  {
    int n = 0;
    for (int m = 0; m < end; ++m) n += !is_there[static_cast<std::size_t>(m)];
    return n;
  }

  static constexpr bool is_oracle = has<void, Subdomain_of> || has<void, Closest_of> || has<void, Project_on_patch_of>;
  static constexpr bool has_kernel = Has_double_kernel<Oracle>::value;
  static constexpr int most_named = 3; ///< missing members; what is no oracle at all lacks all of them

  /// Whether a member needn't be complained about.
  template <Member member>
  static constexpr bool is_fine = !is_oracle || !has_kernel || is_there[member] || missing_before(member) >= most_named;

public:
  static constexpr bool holds = is_oracle && has_kernel && missing_before(number_of_members) == 0;

  static void complain()
  {
    static_assert(is_oracle, "weft: this is no domain oracle; weft::Polyhedral_oracle_3<K> makes one of a surface, see "
                             "doc/concepts/DomainOracle_3.h");
    static_assert(has_kernel || !is_oracle,
                  "weft: the kernel of a domain oracle has exact predicates and coordinates of type double, such as "
                  "CGAL::Exact_predicates_inexact_constructions_kernel");
    static_assert(is_fine<thread_safety>, "weft: the oracle lacks `static constexpr bool is_thread_safe`");
    static_assert(is_fine<label_precedence>, "weft: the oracle lacks `static constexpr bool labels_first`");
    static_assert(is_fine<bbox>, "weft: the oracle lacks `CGAL::Bbox_3 bbox() const`");
    static_assert(is_fine<subdomain>, "weft: the oracle lacks `int subdomain(const Point&) const`");
    static_assert(is_fine<intersect>, "weft: the oracle lacks `int intersect(const Point& p, const Point& q, "
                                      "std::vector<weft::Surface_hit_3<Kernel>>& hits) const`");
    static_assert(is_fine<labelled_intersect>,
                  "weft: the oracle lacks `int intersect(const Point& p, const Point& q, int at_p, int at_q, "
                  "std::vector<weft::Surface_hit_3<Kernel>>& hits) const`, which those with `labels_first` need");
    static_assert(is_fine<closest>, "weft: the oracle lacks `weft::Surface_hit_3<Kernel> closest(const Point&) const`");
    static_assert(is_fine<is_within>,
                  "weft: the oracle lacks `bool is_within(const Point&, double squared_distance) const`");
    static_assert(is_fine<is_clear>, "weft: the oracle lacks `bool is_clear(const Point&, double radius) const`");
    static_assert(is_fine<number_of_patches>, "weft: the oracle lacks `int number_of_patches() const`");
    static_assert(is_fine<is_expected>, "weft: the oracle lacks `bool is_expected(int patch) const`");
    static_assert(
        is_fine<project_on_patch>,
        "weft: the oracle lacks `weft::Surface_hit_3<Kernel> project_on_patch(const Point&, int patch) const`");
    static_assert(is_fine<patch_seeds>, "weft: the oracle lacks `std::vector<weft::Surface_hit_3<Kernel>> "
                                        "patch_seeds(int patch, std::size_t n) const`");
    static_assert(is_fine<number_of_corners>, "weft: the oracle lacks `std::size_t number_of_corners() const`");
    static_assert(is_fine<corner>, "weft: the oracle lacks `Point corner(std::size_t i) const`");
    static_assert(is_fine<number_of_creases>, "weft: the oracle lacks `std::size_t number_of_creases() const`");
    static_assert(is_fine<crease_points>,
                  "weft: the oracle lacks `std::vector<Point> crease_points(int crease) const`");
    static_assert(is_fine<crease_is_closed>, "weft: the oracle lacks `bool crease_is_closed(int crease) const`");
    static_assert(is_fine<project_on_crease>,
                  "weft: the oracle lacks `Point project_on_crease(const Point&, int crease) const`");
    static_assert(is_fine<incidence>, "weft: the oracle lacks `weft::Feature_incidence_3 incidence() const`");
    static_assert(is_fine<folds>,
                  "weft: the oracle lacks members about folds; derive it from weft::No_folds_3<Kernel>");
    static_assert(!is_oracle || !has_kernel || missing_before(number_of_members) <= most_named,
                  "weft: and more; see doc/concepts/DomainOracle_3.h");
  }
};

/// Says that an oracle must not be a temporary, or what it lacks.
template <class Oracle>
void complain_about_temporary_3()
{
  if constexpr (Oracle_requirements_3<Oracle>::holds)
    static_assert(never_v<Oracle>,
                  "weft: the mesh asks the oracle later, too, which must not be a temporary: give it a "
                  "name and keep it as long as the result");
  else
    Oracle_requirements_3<Oracle>::complain();
}

/// What is returned after a complaint.
struct No_mesh_3
{
  int restricted = 0;
  Mesh_report_3 report;
};

/// What `make_mesh_3()` takes: an oracle, and criteria with its kernel.
template <class Oracle, class Criteria, class = void>
struct Takes_3 : std::false_type
{};
template <class Oracle, class Criteria>
struct Takes_3<Oracle, Criteria, std::void_t<typename Oracle::Kernel::Point_3>>
    : std::is_convertible<const Criteria&, const Criteria_3<typename Oracle::Kernel>&>
{};

/// Says which of them is wrong.
template <class Oracle, class Criteria>
void complain_about_arguments_3()
{
  constexpr bool has_kernel = Has_double_kernel<Oracle>::value;
  static_assert(has_kernel, "weft: this is no domain oracle; weft::Polyhedral_oracle_3<K> makes one of a surface, see "
                            "doc/concepts/DomainOracle_3.h");
  static_assert(!has_kernel || never_v<Criteria>,
                "weft: the criteria aren't a weft::Criteria_3 with the oracle's kernel");
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_ORACLE_REQUIREMENTS_3_H
