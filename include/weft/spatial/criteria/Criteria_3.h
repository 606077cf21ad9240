// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every element of a spatial mesh has to satisfy (Tournois 2009, sec. 3.2.1.2), and the reasons for which an
// element is bad.

#ifndef WEFT_SPATIAL_CRITERIA_CRITERIA_3_H
#define WEFT_SPATIAL_CRITERIA_CRITERIA_3_H

#include <weft/errors.h>
#include <weft/internal/Answers.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// What a field says is its smallest value, or 0.
template <class Field>
auto smallest_of(const Field& field, int) -> decltype(double(field.smallest()))
{
  return field.smallest();
}
template <class Field>
double smallest_of(const Field&, long)
{
  return 0;
}

} // namespace internal

/// A length that may depend on the place: a constant or any callable, point -> length in the input's units.
/// Zero stands for "no bound".
template <class K>
class Length_field_3
{
public:
  using Point = typename K::Point_3;

  Length_field_3(double constant = 0) : constant_(constant) {} // NOLINT: a number is a field
  template <class Field, class = std::enable_if_t<std::is_invocable_r_v<double, const Field&, const Point&>>>
  Length_field_3(Field field)
      : constant_(-1), smallest_(internal::smallest_of(field, 0)), field_(std::move(field)) // NOLINT: so is a callable
  {}
  /// \cond
  // Only says what is wrong with any other object.
  template <class Field, std::enable_if_t<std::is_class_v<Field> && !std::is_base_of_v<Length_field_3, Field> &&
                                              !std::is_convertible_v<const Field&, double> &&
                                              !std::is_invocable_r_v<double, const Field&, const Point&>,
                                          int> = 0>
  Length_field_3(const Field&) : constant_(0) // NOLINT: as above
  {
    static_assert(internal::never_v<Field>, "weft: a length is a number, or is called as const with a point of the "
                                            "kernel, `K::Point_3`, and returns a number");
  }
  /// \endcond

  bool is_constant() const { return !field_; }
  /// Whether there is a bound at all.
  explicit operator bool() const { return field_ || constant_ > 0; }

  /// \throws Option_error if the callable returns anything but a positive number.
  double operator()(const Point& p) const
  {
    if (!field_) return constant_;
    const double value = field_(p);
    if (!(value > 0) || !std::isfinite(value)) throw Option_error("a field of lengths must return positive numbers");
    return value;
  }
  double constant() const { return constant_; }
  /// The smallest length where that is known: of constants, and of fields that say so; else 0.
  double smallest() const { return field_ ? smallest_ : constant_; }

private:
  double constant_, smallest_ = 0;
  std::function<double(const Point&)> field_;
};

namespace internal {

/// The smaller of two bounds, of which 0 is none.
inline double tighter(double a, double b)
{
  return a == 0 || b == 0 ? a + b : a < b ? a : b;
}

/// The smaller of two bounds at a point; 0 if there is neither.
template <class K>
double least_bound(const Length_field_3<K>& a, const Length_field_3<K>* b, const typename K::Point_3& p)
{
  return tighter(a ? a(p) : 0, b && *b ? (*b)(p) : 0);
}

} // namespace internal

/// What cells of one subdomain have to satisfy in addition to what holds everywhere; 0: nothing more.
template <class K>
struct Subdomain_criteria_3
{
  Length_field_3<K> size; ///< longest edge, in the input's units
  double cell_shape = 0;  ///< largest circumradius / shortest edge
};

/// What boundary facets on one patch have to satisfy in addition to what holds everywhere; 0: nothing more.
template <class K>
struct Patch_criteria_3
{
  Length_field_3<K> size;          ///< longest edge, in the input's units
  Length_field_3<K> approximation; ///< distance to the surface, in the input's units
  double facet_shape = 0;          ///< largest circumradius / shortest edge
};

/// What demands of users see of a boundary facet.
template <class K>
struct Facet_view_3
{
  std::array<const typename K::Point_3*, 3> points;
  std::array<Vertex_location_3, 3> locations;
  const typename K::Point_3* center; ///< of the surface Delaunay ball
  int patch;
};

/// What demands of users see of a cell.
template <class K>
struct Cell_view_3
{
  std::array<const typename K::Point_3*, 4> points;
  std::array<Vertex_location_3, 4> locations;
  const typename K::Point_3* circumcenter;
  int subdomain;
};

/// Criteria of `make_mesh_3()`. Everything but the size is optional.
template <class K>
struct Criteria_3
{
  Length_field_3<K> size;          ///< longest edge, in the input's units
  Length_field_3<K> approximation; ///< distance of facets and crease edges to the surface, in the input's units
  double facet_shape = 2;          ///< largest circumradius / shortest edge of a boundary facet; 0: no bound
  double cell_shape = 2;           ///< largest circumradius / shortest edge of a cell; 0: no bound
  bool topology = false; ///< the vertices of a boundary facet lie on one patch, those of a crease edge on one crease
  /// As far as this from the surface optimisation may bring facets and crease edges, in the input's units, though the
  /// approximation doesn't ask for more. 0: not beyond the farthest of them before it began.
  Length_field_3<K> deviation;

  Length_field_3<K> crease_size;                     ///< longest crease edge, where that is less than `size`
  std::map<int, Subdomain_criteria_3<K>> subdomains; ///< further ones, by subdomain
  std::map<int, Patch_criteria_3<K>> patches;        ///< further ones, by patch

  /// Any other demand: how bad an element is, above 1 if it has to be refined; called by one thread only.
  std::function<double(const Facet_view_3<K>&)> facet_demand;
  std::function<double(const Cell_view_3<K>&)> cell_demand;

  /// Whether some criterion is a function of the user.
  bool has_functions() const
  {
    const auto varies = [](const Length_field_3<K>& field) { return !field.is_constant(); };
    bool found = varies(size) || varies(approximation) || varies(deviation) || varies(crease_size) || facet_demand ||
                 cell_demand;
    for (const auto& own : subdomains) found = found || varies(own.second.size);
    for (const auto& own : patches) found = found || varies(own.second.size) || varies(own.second.approximation);
    return found;
  }

  /// The approximation asked for on one patch alone; null if none is.
  const Length_field_3<K>* own_approximation(int patch) const
  {
    const auto own = patches.find(patch);
    return own == patches.end() ? nullptr : &own->second.approximation;
  }

  /// The least of a bound and those of some patches alone, at a point; 0 if there is none.
  double least_own_approximation(const std::vector<int>& of_patches, const typename K::Point_3& p, double bound) const
  {
    for (const int patch : of_patches) bound = internal::least_bound<K>(bound, own_approximation(patch), p);
    return bound;
  }

  /// \throws Option_error naming the first criterion out of range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    require(!size.is_constant() || (size.constant() > 0 && std::isfinite(size.constant())), "size must be positive");
    const auto require_length = [&](const Length_field_3<K>& field, const char* what) {
      require(!field.is_constant() || (field.constant() >= 0 && std::isfinite(field.constant())), what);
    };
    require_length(approximation, "approximation must be positive, or 0 for none");
    for (const auto& [label, c] : subdomains) {
      require_length(c.size, "size of a subdomain must be positive, or 0 for none");
      require(c.cell_shape == 0 || c.cell_shape >= 1, "cell_shape of a subdomain must be at least 1, or 0 for none");
    }
    for (const auto& [patch, c] : patches) {
      require_length(c.size, "size of a patch must be positive, or 0 for none");
      require_length(c.approximation, "approximation of a patch must be positive, or 0 for none");
      require(c.facet_shape == 0 || c.facet_shape >= 1, "facet_shape of a patch must be at least 1, or 0 for none");
    }
    require_length(crease_size, "crease_size must be positive, or 0 for none");
    require(facet_shape == 0 || facet_shape >= 1, "facet_shape must be at least 1, or 0 for none");
    require(cell_shape == 0 || cell_shape >= 1, "cell_shape must be at least 1, or 0 for none");
  }
};

/// Why an element is bad; an element may be bad for several reasons at once, see `Badness_3::reasons`.
enum Bad_reason_3 : unsigned
{
  bad_size = 1,
  bad_approximation = 2,
  bad_shape = 4,
  bad_topology = 8, ///< vertices of several patches or creases
  bad_demand = 32,  ///< a demand of the user
  bad_disk = 16     ///< an end of it lacks a topological disk of boundary facets or crease edges around itself
};

/// How bad an element is: the largest ratio of a measure to its bound, above 1 when bad, and all reasons.
struct Badness_3
{
  double ratio = 0;
  unsigned reasons = 0;

  bool is_bad() const { return reasons != 0; }
  void add(double r, Bad_reason_3 reason)
  {
    if (r > ratio) ratio = r;
    if (r > 1) reasons |= reason;
  }
};

/// Names of the reasons for people, separated by commas.
inline std::string describe_reasons(unsigned reasons)
{
  static const std::pair<unsigned, const char*> names[] = {
      {bad_size, "size"},         {bad_approximation, "approximation"}, {bad_shape, "shape"},
      {bad_topology, "topology"}, {bad_disk, "topological disk"},       {bad_demand, "demand"}};
  std::string text;
  for (const auto& [reason, label] : names)
    if (reasons & reason) text += (text.empty() ? "" : ", ") + std::string(label);
  return text;
}

} // namespace weft

#endif // WEFT_SPATIAL_CRITERIA_CRITERIA_3_H
