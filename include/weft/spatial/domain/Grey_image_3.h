// SPDX-License-Identifier: GPL-3.0-or-later
//
// An image of grey values or signed distances whose domain is where the trilinear interpolation of its values lies
// above a value, or below it.
//
//   #include <weft/IO/read_grey_image.h>
//
//   const weft::Grey_image_3 image = weft::IO::read_grey_image("skull.inr.gz", 2.9);
//   const auto domain = weft::image_oracle_3<K>(image);

#ifndef WEFT_SPATIAL_DOMAIN_GREY_IMAGE_3_H
#define WEFT_SPATIAL_DOMAIN_GREY_IMAGE_3_H

#include <weft/errors.h>
#include <weft/spatial/domain/Image_oracle_3.h>
#include <weft/spatial/domain/Voxel_image_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <sstream>
#include <utility>
#include <vector>

namespace weft {

/// Which side of the value belongs to the domain.
enum class Iso_side
{
  above,
  below,
  /// That on which fewer of the voxels at the border of the image lie; above if there are as many.
  away_from_border
};

/// Grey values of voxels and the value that bounds the domain. Copies share them.
class Grey_image_3 final : public Voxel_image_3
{
public:
  /// \param size number of voxels along x, y, z.
  /// \param spacing of their centers, in the input's units.
  /// \param origin center of the first voxel.
  /// \param values of the voxels, x running fastest.
  /// \param iso the value on the boundary of the domain.
  /// \throws Domain_error if sizes don't fit, spacings aren't positive, values aren't numbers, or no voxel lies in the
  ///   domain.
  Grey_image_3(const std::array<std::size_t, 3>& size, const std::array<double, 3>& spacing,
               const std::array<double, 3>& origin, std::vector<float> values, double iso,
               Iso_side side = Iso_side::away_from_border)
      : Voxel_image_3(size, spacing, origin, values.size()), iso_(iso), lies_above_(side != Iso_side::below)
  {
    for (const float value : values)
      if (!std::isfinite(value)) throw Domain_error("the image has values that aren't numbers", {}, {});
    values_ = std::make_shared<const std::vector<float>>(std::move(values));
    if (side == Iso_side::away_from_border) choose_side();
    if (std::none_of(values_->begin(), values_->end(), [this](float value) { return excess(value) > 0; })) refuse();
  }

  double iso() const { return iso_; }
  /// Whether the domain is where values are above `iso()`.
  bool lies_above() const { return lies_above_; }

  int number_of_labels() const override { return 2; }
  int label(const Voxel& v) const override { return excess_of(v) > 0; }

  int label_at(const std::array<double, 3>& p) const override
  {
    std::array<std::size_t, 8> corners;
    std::array<double, 3> t;
    if (!locate(p, corners, t)) return 0;
    double sum = 0;
    for (std::size_t i = 0; i < 8; ++i) sum += weight(i, t) * excess(static_cast<double>((*values_)[corners[i]]));
    return sum > 0;
  }

  /// Not quite at a center, where creases would degenerate.
  double crossing(const Voxel& a, const Voxel& b) const override
  {
    const double from = excess_of(a), to = excess_of(b);
    return (std::max)(0.01, (std::min)(0.99, from / (from - to)));
  }

  bool follows_labels() const override { return false; }

  int label_across(const std::array<Voxel, 4>& square) const override
  {
    const double a = excess_of(square[0]), b = excess_of(square[1]), c = excess_of(square[2]), d = excess_of(square[3]);
    return (a * c - b * d) / (a + c - b - d) > 0; // at the saddle
  }

private:
  /// How far a value lies on the domain's side.
  double excess(double value) const { return lies_above_ ? value - iso_ : iso_ - value; }
  double excess_of(const Voxel& v) const { return excess(static_cast<double>((*values_)[index(v)])); }

  void choose_side()
  {
    std::ptrdiff_t above = 0, below = 0;
    Voxel v;
    std::array<std::ptrdiff_t, 3> n;
    for (std::size_t k = 0; k < 3; ++k) n[k] = static_cast<std::ptrdiff_t>(size()[k]);
    for (v[2] = 0; v[2] < n[2]; ++v[2])
      for (v[1] = 0; v[1] < n[1]; ++v[1]) {
        const bool whole_row = v[2] == 0 || v[2] == n[2] - 1 || v[1] == 0 || v[1] == n[1] - 1;
        for (v[0] = 0; v[0] < n[0]; v[0] += whole_row ? 1 : (std::max)(n[0] - 1, std::ptrdiff_t(1)))
          ++(excess_of(v) > 0 ? above : below);
      }
    lies_above_ = above <= below;
  }

  void refuse() const
  {
    const auto [least, most] = std::minmax_element(values_->begin(), values_->end());
    std::ostringstream text;
    text << "no voxel of the image has a value " << (lies_above_ ? "above " : "below ") << iso_ << ": they are between "
         << *least << " and " << *most;
    throw Domain_error(text.str(), {}, {});
  }

  double iso_;
  bool lies_above_;
  std::shared_ptr<const std::vector<float>> values_;
};

/// The domain oracle of an image, which it keeps a copy of.
template <class K>
Image_oracle_3<K> image_oracle_3(const Grey_image_3& image)
{
  return Image_oracle_3<K>(std::make_shared<const Grey_image_3>(image));
}

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_GREY_IMAGE_3_H
