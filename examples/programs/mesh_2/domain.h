// SPDX-License-Identifier: GPL-3.0-or-later
//
// What mesh_2 is made of, without CGAL's types: its parts are compiled apart from each other.

#ifndef WEFT_EXAMPLES_PROGRAMS_MESH_2_DOMAIN_H
#define WEFT_EXAMPLES_PROGRAMS_MESH_2_DOMAIN_H

#include <weft/IO/write_angle_histogram_svg.h>
#include <weft/options.h>
#include <weft/report.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace mesh_2_program {

/// Edge lengths that are asked for, in the input's units: at most `size`, or by the local feature size if that is 0.
struct Sizes
{
  double size = 0;
  double lfs = 0, min_size = 0; ///< growth per unit of distance, and smallest length
};

/// What a planar straight line graph encloses, and its mesh once `mesh()` has been called.
class Domain
{
public:
  virtual ~Domain() = default;

  /// \param keeps_input whether `reference_angles()` is going to be called.
  /// \throws weft::Domain_error for sizes that the input doesn't allow.
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
/// \param split_crossings whether to split segments that cross or overlap.
/// \throws weft::File_error if the file can't be read, weft::Domain_error if it doesn't describe a domain.
std::unique_ptr<Domain> read_domain(const std::string& filename, bool split_crossings);

} // namespace mesh_2_program

#endif // WEFT_EXAMPLES_PROGRAMS_MESH_2_DOMAIN_H
