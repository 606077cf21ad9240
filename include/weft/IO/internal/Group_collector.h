// SPDX-License-Identifier: GPL-3.0-or-later
//
// Groups of facets while a surface is read: solids, materials, colours, by their names.

#ifndef WEFT_IO_INTERNAL_GROUP_COLLECTOR_H
#define WEFT_IO_INTERNAL_GROUP_COLLECTOR_H

#include <weft/spatial/surface/Polygon_soup_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft::internal {

/// See the top of the file.
class Group_collector
{
public:
  /// The facets that follow belong to the group of that name.
  void enter(const std::string& name)
  {
    if (name == names_[current_]) return;
    const auto [at, is_new] = numbers_.try_emplace(name, names_.size());
    if (is_new) names_.push_back(name);
    current_ = at->second;
  }
  /// Those that follow belong to a group of their own, whatever others are called.
  void enter_another(const std::string& name)
  {
    current_ = names_.size();
    names_.push_back(name);
  }
  void add_facet() { groups_.push_back(current_); }

  /// Gives a surface its groups, unless there is one at most.
  template <class K>
  void finish(Polygon_soup_3<K>& soup)
  {
    std::vector<std::size_t> number(names_.size(), names_.size());
    for (std::size_t& group : groups_) {
      if (number[group] == names_.size()) {
        number[group] = soup.group_names.size();
        soup.group_names.push_back(names_[group]);
      }
      group = number[group];
    }
    if (soup.group_names.size() > 1)
      soup.groups = std::move(groups_);
    else
      soup.group_names.clear();
  }

private:
  std::map<std::string, std::size_t> numbers_ = {{"", 0}};
  std::vector<std::string> names_ = {""};
  std::vector<std::size_t> groups_;
  std::size_t current_ = 0;
};

/// Which component of a colour a PLY property is: 0 to 2, or none.
inline std::optional<std::size_t> component_of_colour(const std::string& property)
{
  static constexpr std::array<std::string_view, 3> names = {"red", "green", "blue"};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (property == names[i] || property == "diffuse_" + std::string(names[i])) return i;
  return {};
}

/// The name of a colour, as in "#ff8000".
/// \param unit what a component is at most.
inline std::string name_of_colour(const std::array<double, 3>& components, double unit)
{
  char text[8];
  std::array<unsigned, 3> bytes{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = components[i] / unit;
    bytes[i] = part >= 1 ? 255 : part > 0 ? static_cast<unsigned>(std::lround(255 * part)) : 0;
  }
  std::snprintf(text, sizeof text, "#%02x%02x%02x", bytes[0] & 255, bytes[1] & 255, bytes[2] & 255);
  return text;
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_GROUP_COLLECTOR_H
