// SPDX-License-Identifier: GPL-3.0-or-later

#include "result.h"

#include <weft/IO/read_label_image.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/domain/Label_image_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>

#include <algorithm>

namespace mesh_3_program {

namespace {

class Image_domain : public Domain
{
public:
  explicit Image_domain(const std::string& filename) : image_(weft::IO::read_label_image(filename)) {}

  double extent() const override { return diagonal(oracle_.bbox()); }
  double detail() const override { return *std::max_element(image_.spacing().begin(), image_.spacing().end()); }
  std::shared_ptr<const Result> mesh(const Bounds& bounds, const weft::Mesh_options_3& options) const override
  {
    const auto result = weft::make_mesh_3(oracle_, criteria(bounds), options);
    return make_result(weft::tetrahedral_mesh(result.restricted), result.report);
  }

private:
  weft::Label_image_3 image_;
  weft::Image_oracle_3<K> oracle_ = weft::image_oracle_3<K>(image_);
};

} // namespace

bool is_image_filename(const std::string& filename)
{
  return weft::IO::is_label_image_filename(filename);
}

std::unique_ptr<Domain> read_image(const std::string& filename)
{
  return std::make_unique<Image_domain>(filename);
}

} // namespace mesh_3_program
