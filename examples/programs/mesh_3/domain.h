// SPDX-License-Identifier: GPL-3.0-or-later
//
// What mesh_3 is made of, without CGAL's types: its parts are compiled apart from each other, since each that sees
// CGAL takes seconds and half a gigabyte at least.

#ifndef WEFT_EXAMPLES_PROGRAMS_MESH_3_DOMAIN_H
#define WEFT_EXAMPLES_PROGRAMS_MESH_3_DOMAIN_H

#include <weft/options.h>
#include <weft/report.h>
#include <weft/spatial/surface/Feature_options.h>
#include <weft/spatial/surface/Mend_options_3.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mesh_3_program {

/// What a mesh has to satisfy, as in `weft::Criteria_3`.
struct Bounds
{
  double size = 0, approximation = 0;              ///< in the input's units
  std::map<int, double> size_of, approximation_of; ///< instead, of subdomains with a label
  std::map<int, std::string> name_of;              ///< what subdomains with a label are called in files
  double facet_shape = 2, cell_shape = 2;
  bool topology = false, manifold = false;
  bool by_features = false; ///< sizes from the features of the domain, at most `size`
  double gradation = 0;     ///< growth of sizes per unit of distance; 0: any
  int order = 1;            ///< of the elements, 1 or 2
  /// Sizes at places, at most `size`; may be empty.
  std::function<double(const std::array<double, 3>&)> size_field;

  bool vary() const { return by_features || gradation > 0 || size_field; }
};

/// Reads a field of sizes.
/// \throws weft::File_error, weft::Option_error.
std::function<double(const std::array<double, 3>&)> read_size_field(const std::string& filename);

/// A mesh with what is known about it; see result.h.
struct Result;

/// What the input describes.
class Domain
{
public:
  virtual ~Domain() = default;

  virtual double extent() const = 0;              ///< diagonal of its bounding box
  virtual double detail() const = 0;              ///< size of the smallest details of the input that count; 0 if all do
  virtual double least_edge() const { return 0; } ///< below which refinement ends; 0 for weft's own floor
  /// What was changed in the input, for people.
  virtual std::vector<std::string> changes() const { return {}; }
  /// \throws weft::Option_error for a label that the input doesn't have.
  virtual std::shared_ptr<const Result> mesh(const Bounds& bounds, const weft::Mesh_options_3& options) const = 0;
};

/// What to do with surfaces that aren't closed surfaces.
struct Mending
{
  bool strict = false; ///< refuse them
  weft::Mend_options_3 options;
};

/// Reads the surfaces that bound a domain.
/// \throws weft::File_error if a file can't be read, weft::Domain_error if the surfaces don't bound a domain.
std::unique_ptr<Domain> read_surfaces(const std::vector<std::string>& filenames, const weft::Feature_options& features,
                                      const Mending& mending);

/// Whether a file is an image, by its name.
bool is_image_filename(const std::string& filename);

/// What the values of an image mean.
struct Image_options
{
  std::optional<double> iso; ///< grey values: that on the boundary of the domain; without it they are labels
  std::string inside;        ///< "above" or "below" it; empty for what the image's border tells
  bool takes_labels = false; ///< labels, however much they look like grey values
};

/// \throws weft::File_error if the file can't be read, weft::Domain_error if there is no domain in it, or if labels
///   look like grey values.
std::unique_ptr<Domain> read_image(const std::string& filename, const Image_options& options);

// ---- Results

const weft::Mesh_report_3& report(const Result& result);
bool is_empty(const Result& result);
double smallest_dihedral(const Result& result); ///< in degrees
/// How curved elements came out, a line for people; empty for elements of first order.
std::string second_order(const Result& result);
/// Components of labels that stayed out of the mesh, a line each, for people.
std::vector<std::string> left_out(const Result& result);

/// \param order of the elements.
bool is_mesh_filename(const std::string& filename, int order);
void write_mesh(const std::string& filename, const Result& result);
void write_report(const std::string& filename, const Result& result);
void write_histogram(const std::string& filename, const Result& result, const std::string& title);

} // namespace mesh_3_program

#endif // WEFT_EXAMPLES_PROGRAMS_MESH_3_DOMAIN_H
