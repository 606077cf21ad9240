// SPDX-License-Identifier: GPL-3.0-or-later
//
// What mesh_2 is made of, without CGAL's types: its parts are compiled apart from each other.

#ifndef WEFT_EXAMPLES_PROGRAMS_MESH_2_DOMAIN_H
#define WEFT_EXAMPLES_PROGRAMS_MESH_2_DOMAIN_H

#include "../../command_line.h"

#include <weft/IO/write_angle_histogram_svg.h>
#include <weft/options.h>
#include <weft/report.h>

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mesh_2_program {

/// Edge lengths that are asked for: by the local feature size if `lfs` isn't 0, else at most `size`, and by a file if
/// one is named.
struct Sizes
{
  command_line::Length size{5, true};
  std::map<int, command_line::Length> size_of_mark; ///< instead, in regions with a mark
  double lfs = 0;                                   ///< growth per unit of distance
  command_line::Length min_size;
  std::string field;       ///< name of the file
  bool is_bounded = false; ///< whether its sizes are at most `size`
  double gradation = 0.5;  ///< growth of its sizes per unit of distance
};

/// How a graph is read.
struct Input_options
{
  bool split_crossings = false;
  std::optional<command_line::Length> tolerance; ///< see weft::Pslg_options
};

/// What a planar straight line graph encloses, and its mesh once `mesh()` has been called.
class Domain
{
public:
  virtual ~Domain() = default;

  /// What is odd about the points of holes and regions.
  virtual const std::vector<std::string>& warnings() const = 0;

  /// \returns the report, with notes about the input.
  /// \param keeps_input whether `reference_angles()` is going to be called.
  /// \throws weft::Domain_error for sizes that the input doesn't allow, weft::File_error for a field that can't be
  /// read.
  virtual weft::Mesh_report_2 mesh(const Sizes& sizes, const weft::Mesh_options_2& options, bool keeps_input) = 0;

  virtual weft::Angle_histogram angles() const = 0;
  /// The angles of a mesh of the same sizes by CGAL; none if that was stopped.
  /// \param go_on called with the number of its vertices; returns false to stop.
  virtual weft::Angle_histogram reference_angles(const std::function<bool(std::size_t)>& go_on) const = 0;

  virtual void write_mesh(const std::string& filename) const = 0;
  virtual void draw_voronoi(const std::string& filename, const std::string& title) const = 0;
  virtual void write_report(const std::string& filename, const weft::Mesh_report_2& report) const = 0;
};

bool is_mesh_filename(const std::string& filename);

/// Reads a graph and finds what it encloses.
/// \throws weft::File_error if the file can't be read, weft::Domain_error if it doesn't describe a domain.
std::unique_ptr<Domain> read_domain(const std::string& filename, const Input_options& options);

} // namespace mesh_2_program

#endif // WEFT_EXAMPLES_PROGRAMS_MESH_2_DOMAIN_H
