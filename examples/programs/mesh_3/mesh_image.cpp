// SPDX-License-Identifier: GPL-3.0-or-later

#include "sizes.h"

#include <weft/errors.h>
#include <weft/internal/counted.h>
#include <weft/IO/read_grey_image.h>
#include <weft/IO/read_label_image.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/domain/contacts_at_edges_3.h>
#include <weft/spatial/domain/Grey_image_3.h>
#include <weft/spatial/domain/Label_image_3.h>
#include <weft/spatial/domain/looks_like_grey_values.h>
#include <weft/spatial/domain/missing_components_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>

namespace mesh_3_program {

namespace {

/// The domain of an image of either kind.
class Image_domain : public Domain
{
public:
  /// \param subdomains by label.
  Image_domain(weft::Image_oracle_3<K> oracle, std::map<int, int> subdomains, std::vector<std::string> notes)
      : oracle_(std::move(oracle)), notes_(std::move(notes))
  {
    parts_.subdomains = std::move(subdomains);
    for (int p = 0; p < oracle_.number_of_patches(); ++p) parts_.sides.push_back(oracle_.sides_of_patch(p));
  }

  double extent() const override { return diagonal(oracle_.bbox()); }
  double detail() const override
  {
    const auto& s = oracle_.image().spacing();
    return *std::max_element(s.begin(), s.end());
  }
  double least_edge() const override
  {
    const auto& s = oracle_.image().spacing();
    return 0.3 * std::cbrt(s[0] * s[1] * s[2]);
  }
  std::vector<std::string> changes() const override { return notes_; }

  std::shared_ptr<const Result> mesh(const Bounds& bounds, const weft::Mesh_options_3& options) const override
  {
    const weft::Mesh_names_3 names = names_of_parts(by_subdomain(bounds.name_of, parts_));
    const auto result = weft::make_mesh_3(oracle_, with_sizes(oracle_, criteria(bounds, parts_), bounds), options);
    weft::Tetrahedral_mesh_3<K> mesh = weft::tetrahedral_mesh(result.restricted);
    auto missing = weft::missing_components_3(oracle_.image(), oracle_.components(), mesh);
    for (weft::Voxel_component_3& c : missing) c.label = label_of(c.label);
    auto second = raised(mesh, oracle_, bounds.order);
    return make_result(std::move(mesh), result.report, names, std::move(second), std::move(missing));
  }

private:
  int label_of(int subdomain) const
  {
    for (const auto& [label, own] : parts_.subdomains)
      if (own == subdomain) return label;
    return 0;
  }

  /// Without any given, there are names only where labels aren't the numbers of subdomains.
  weft::Mesh_names_3 names_of_parts(std::map<int, std::string> given) const
  {
    weft::Mesh_names_3 names;
    const bool differ = std::any_of(parts_.subdomains.begin(), parts_.subdomains.end(),
                                    [](const auto& own) { return own.first != own.second; });
    if (given.empty() && !differ) return names;
    for (const auto& [label, subdomain] : parts_.subdomains)
      given.try_emplace(subdomain, "label " + std::to_string(label));
    static const char* const faces[] = {"x min", "x max", "y min", "y max", "z min", "z max"};
    for (std::size_t p = 0; p < parts_.sides.size(); ++p) {
      const int patch = static_cast<int>(p), face = oracle_.face_of_patch(patch);
      if (!oracle_.is_expected(patch)) continue;
      const auto [low, high] = parts_.sides[p];
      names.patches[patch] = given.at(high) + ", " +
                             (face >= 0  ? faces[face]
                              : low == 0 ? std::string("outside")
                                         : given.at(low));
    }
    names.subdomains = std::move(given);
    return names;
  }

  weft::Image_oracle_3<K> oracle_;
  Parts parts_;
  std::vector<std::string> notes_;
};

std::unique_ptr<Domain> read_grey(const std::string& filename, const Image_options& options)
{
  const weft::Iso_side side = options.inside == "above"   ? weft::Iso_side::above
                              : options.inside == "below" ? weft::Iso_side::below
                                                          : weft::Iso_side::away_from_border;
  const weft::Grey_image_3 image = weft::IO::read_grey_image(filename, *options.iso, side);
  std::vector<std::string> notes;
  if (options.inside.empty()) {
    std::ostringstream note;
    note << "the domain is where values are " << (image.lies_above() ? "above " : "below ") << image.iso()
         << ", as fewer are at the image's border; --inside says otherwise";
    notes.push_back(note.str());
  }
  return std::make_unique<Image_domain>(weft::image_oracle_3<K>(image), std::map<int, int>{{1, 1}}, notes);
}

constexpr const char* question = "are these grey values? --iso VALUE meshes what is above or below a value, --labels "
                                 "takes each value for a subdomain";

std::unique_ptr<Domain> read_labels(const std::string& filename, const Image_options& options)
{
  const weft::Label_image_3 image = weft::IO::read_label_image(filename);
  const int labels = image.number_of_labels() - 1;
  if (!options.takes_labels && weft::looks_like_grey_values(image))
    throw weft::Domain_error("the image has " + std::to_string(labels) + " different values: " + question, {}, {});
  std::map<int, int> subdomains;
  std::string numbers, values;
  for (int k = 1; k <= labels; ++k) {
    subdomains[image.value(k)] = k;
    numbers += (k > 1 ? ", " : "") + std::to_string(k);
    values += (k > 1 ? ", " : "") + std::to_string(image.value(k));
  }
  std::vector<std::string> notes;
  if (numbers != values)
    notes.push_back(labels == 1 ? "the subdomain is the label " + values
                                : "the subdomains " + numbers + " are the labels " + values);
  weft::Image_oracle_3<K> oracle = weft::image_oracle_3<K>(image);
  if (const std::size_t n = weft::number_of_contacts_at_edges(image); n > 0)
    notes.push_back("labels meet at edges of voxels alone in " + weft::internal::counted(n, "place", "places") +
                    ": the boundary is no manifold there, and shapes may not hold");
  return std::make_unique<Image_domain>(std::move(oracle), std::move(subdomains), notes);
}

} // namespace

bool is_image_filename(const std::string& filename)
{
  return weft::IO::is_label_image_filename(filename);
}

std::unique_ptr<Domain> read_image(const std::string& filename, const Image_options& options)
{
  if (options.iso) return read_grey(filename, options);
  try {
    return read_labels(filename, options);
  } catch (const weft::File_error& error) {
    if (std::string(error.what()).find("aren't integers") == std::string::npos) throw;
    throw weft::File_error(filename, 0, std::string("has voxels that aren't integers: ") + question);
  } catch (const weft::Domain_error& error) {
    if (std::string(error.what()).find("grey scale") == std::string::npos) throw;
    throw weft::Domain_error(error.what() + std::string(" --iso VALUE meshes what is above or below a value"), {}, {});
  }
}

} // namespace mesh_3_program
