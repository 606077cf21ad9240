// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the planar benchmark writes: Markdown tables, the figures that were asked for beside those measured, and JSON.

#ifndef WEFT_BENCHMARK_COMMON_TABLE_H
#define WEFT_BENCHMARK_COMMON_TABLE_H

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace benchmark {

/// A number for people, with so many decimals and no minus before a zero.
inline std::string text(double value, int decimals)
{
  char digits[400];
  std::snprintf(digits, sizeof digits, "%.*f", decimals, value);
  const std::string result = digits;
  return result.find_first_of("123456789") == std::string::npos && result[0] == '-' ? result.substr(1) : result;
}

/// Seconds with three significant digits.
inline std::string seconds_text(double s)
{
  return text(s, s < 0.01 ? 4 : s < 0.1 ? 3 : s < 10 ? 2 : 1);
}

inline std::string markdown_row(const std::vector<std::string>& cells)
{
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + cell + " |";
  return row + "\n";
}

inline std::string markdown_head(const std::vector<std::string>& cells)
{
  std::string rule = "|";
  for (std::size_t i = 0; i < cells.size(); ++i) rule += " --- |";
  return markdown_row(cells) + rule + "\n";
}

/// One JSON object, written member by member.
class Json_object
{
public:
  Json_object& add_raw(const std::string& key, const std::string& json)
  {
    text_ += (text_.empty() ? "" : ", ") + quoted(key) + ": " + json;
    return *this;
  }
  Json_object& add(const std::string& key, const std::string& value) { return add_raw(key, quoted(value)); }
  Json_object& add(const std::string& key, double value)
  {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.10g", value);
    return add_raw(key, std::isfinite(value) ? digits : "null");
  }
  std::string str() const { return "{" + text_ + "}"; }

  static std::string quoted(const std::string& text)
  {
    std::string result = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\') result += '\\';
      result += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
    return result + "\"";
  }

private:
  std::string text_;
};

inline std::string json_array(const std::vector<std::string>& items)
{
  std::string result = "[";
  for (std::size_t i = 0; i < items.size(); ++i) result += (i ? ",\n  " : "\n  ") + items[i];
  return result + "\n]";
}

/// A figure that was asked for, and what was measured.
struct Figure
{
  std::string name;
  bool larger_is_better;
  bool on_average; ///< whether the mean decides, rather than each value
  double at_least, aim;
  int decimals;
  std::string unit;
  std::vector<std::pair<std::string, double>> values; ///< by run
  bool has_aim = true;

  void add(const std::string& run, double value) { values.emplace_back(run, value); }

  double mean() const
  {
    double sum = 0;
    for (const auto& v : values) sum += v.second;
    return sum / static_cast<double>(values.size());
  }

  const std::pair<std::string, double>& worst() const
  {
    return *std::max_element(values.begin(), values.end(), [this](const auto& a, const auto& b) {
      return larger_is_better ? a.second > b.second : a.second < b.second;
    });
  }

  /// By how much the value falls short of what was asked; 0 if it doesn't.
  double short_of(double asked, double value) const
  {
    // Rounding may cost the last digits of an input's own angle.
    const double lack = larger_is_better ? asked - value : value - asked;
    return lack > 1e-9 * std::max(1., std::abs(asked)) ? lack : 0;
  }

  std::string verdict(double asked) const
  {
    if (values.empty()) return "not measured";
    if (on_average) {
      const double lack = short_of(asked, mean());
      return lack > 0 ? "**missed by " + number(lack) + "**" : "met";
    }
    const auto met = static_cast<std::size_t>(
        std::count_if(values.begin(), values.end(), [&](const auto& v) { return short_of(asked, v.second) == 0; }));
    const std::string of = values.size() > 1 ? " of " + std::to_string(values.size()) : "";
    if (met == values.size()) return values.size() > 1 ? "met, all" + of : "met";
    return "**missed by " + number(short_of(asked, worst().second)) + "**" +
           (values.size() > 1 ? ", met on " + std::to_string(met) + of : "");
  }

  static std::vector<std::string> head()
  {
    return {"figure", "at least", "mean", "worst", "verdict", "aim", "verdict on the aim"};
  }

  std::vector<std::string> cells() const
  {
    if (values.empty()) return {name, bound(at_least), "", "", "not measured", has_aim ? bound(aim) : "", ""};
    return {name,
            bound(at_least),
            number(mean()),
            number(worst().second) + (values.size() > 1 ? " (" + worst().first + ")" : ""),
            verdict(at_least),
            has_aim ? bound(aim) : "",
            has_aim ? verdict(aim) : ""};
  }

  std::string json() const
  {
    Json_object o;
    o.add("figure", name).add("asked", at_least);
    if (has_aim) o.add("aim", aim);
    if (!values.empty()) o.add("mean", mean()).add("worst", worst().second).add("worst_run", worst().first);
    o.add("verdict", verdict(at_least));
    Json_object all;
    for (const auto& v : values) all.add(v.first, v.second);
    return o.add_raw("values", all.str()).str();
  }

private:
  std::string number(double value) const { return text(value, decimals) + unit; }
  std::string bound(double value) const { return (larger_is_better ? "≥ " : "≤ ") + number(value); }
};

} // namespace benchmark

#endif // WEFT_BENCHMARK_COMMON_TABLE_H
