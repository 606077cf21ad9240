// SPDX-License-Identifier: GPL-3.0-or-later
//
// The SVG that weft's pictures are made of: a frame that maps the plane (y up) to a picture (y down), paths, text, and
// a colour map that colour-blind readers can tell apart (red, yellow and blue differ in lightness, too).

#ifndef WEFT_IO_INTERNAL_SVG_CANVAS_H
#define WEFT_IO_INTERNAL_SVG_CANVAS_H

#include <weft/internal/cold.h>
#include <weft/IO/internal/Text_writer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace weft::internal {

/// Colour for a value in [0, 1]: dark red, orange, pale yellow, light blue, blue.
WEFT_COLD inline std::string colour(double value)
{
  static constexpr std::array<std::array<double, 3>, 6> stops = {
      {{150, 10, 38}, {222, 80, 50}, {253, 174, 97}, {254, 240, 176}, {158, 205, 226}, {49, 104, 168}}};
  const double place = std::clamp(value, 0., 1.) * (stops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  char text[8];
  int c[3];
  for (std::size_t k = 0; k < 3; ++k)
    c[k] =
        static_cast<int>(std::lround(stops[i][k] + (place - static_cast<double>(i)) * (stops[i + 1][k] - stops[i][k])));
  std::snprintf(text, sizeof text, "#%02x%02x%02x", c[0] & 255, c[1] & 255, c[2] & 255);
  return text;
}

/// Text with the characters that XML reserves replaced.
WEFT_COLD inline std::string xml_escaped(const std::string& text)
{
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

/// Number with one decimal for labels, with a dot in every locale.
WEFT_COLD inline std::string one_decimal(double value)
{
  char digits[400];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, 1).ptr;
  return std::string(digits, end);
}

/// Maps the bounding box of a drawing to a picture whose longer side has 1000 units.
class Svg_frame
{
public:
  void include(double x, double y)
  {
    lower_[0] = std::min(lower_[0], x), lower_[1] = std::min(lower_[1], y);
    upper_[0] = std::max(upper_[0], x), upper_[1] = std::max(upper_[1], y);
  }

  double width() const { return scaled(upper_[0], lower_[0]); }
  double height() const { return scaled(upper_[1], lower_[1]); }
  double x(double x) const { return margin + scaled(x, lower_[0]); }
  double y(double y) const { return margin + scaled(upper_[1], y); }

  static constexpr double margin = 20;

private:
  // Divides before it multiplies, so that no size of domain overflows.
  double scaled(double a, double b) const
  {
    const double longest = std::max(upper_[0] - lower_[0], upper_[1] - lower_[1]);
    return longest > 0 ? 1000 * ((a - b) / longest) : 0;
  }

  double lower_[2] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  double upper_[2] = {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
};

/// Writes one SVG picture on white ground.
class Svg_canvas
{
public:
  Svg_canvas(const std::string& filename, double width, double height) : out_(filename)
  {
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 ";
    number(width) << ' ';
    number(height) << "\" width=\"";
    number(width) << "\" height=\"";
    number(height) << "\" font-family=\"Helvetica, Arial, sans-serif\" fill=\"#222222\">\n"
                   << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  }

  /// Begins a path with the given attributes; follow with `move_to`, `line_to`, `close_loop`, then `end_path`.
  WEFT_COLD void begin_path(const std::string& attributes) { out_ << "<path " << attributes << " d=\""; }
  void move_to(double x, double y) { point('M', x, y); }
  void line_to(double x, double y) { point('L', x, y); }
  void close_loop() { out_ << "Z"; }
  void end_path() { out_ << "\"/>\n"; }

  WEFT_COLD void line(double x1, double y1, double x2, double y2, const std::string& attributes)
  {
    begin_path("fill=\"none\" " + attributes);
    move_to(x1, y1);
    line_to(x2, y2);
    end_path();
  }

  WEFT_COLD void rectangle(double x, double y, double width, double height, const std::string& attributes)
  {
    out_ << "<rect x=\"";
    number(x) << "\" y=\"";
    number(y) << "\" width=\"";
    number(width) << "\" height=\"";
    number(height) << "\" " << attributes << "/>\n";
  }

  void circle(double x, double y, double radius)
  {
    out_ << "<circle cx=\"";
    number(x) << "\" cy=\"";
    number(y) << "\" r=\"";
    number(radius) << "\"/>\n";
  }

  /// What follows is moved by (dx, dy), until `end_group`.
  WEFT_COLD void begin_group(double dx, double dy)
  {
    out_ << "<g transform=\"translate(";
    number(dx) << ' ';
    number(dy) << ")\">\n";
  }
  void end_group() { out_ << "</g>\n"; }

  /// \param anchor start, middle or end.
  WEFT_COLD void text(double x, double y, double size, const std::string& anchor, const std::string& text,
                      const std::string& attributes = "")
  {
    out_ << "<text x=\"";
    number(x) << "\" y=\"";
    number(y) << "\" font-size=\"";
    number(size) << "\" text-anchor=\"" << anchor << "\" " << attributes << ">" << xml_escaped(text) << "</text>\n";
  }

  /// \throws File_error if the file could not be written.
  void close()
  {
    out_ << "</svg>\n";
    out_.close();
  }

  WEFT_COLD static std::string stroke(const std::string& colour, double width)
  {
    return "stroke=\"" + colour + "\" stroke-width=\"" + decimals(width) +
           "\" stroke-linejoin=\"round\" stroke-linecap=\"round\"";
  }

  static std::string decimals(double value)
  {
    char digits[400];
    return std::string(digits, std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, 3).ptr);
  }

private:
  Text_writer& number(double value) { return out_.fixed(value, 2); }

  void point(char command, double x, double y)
  {
    out_ << command;
    number(x) << ' ';
    number(y);
  }

  Text_writer out_;
};

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_SVG_CANVAS_H
