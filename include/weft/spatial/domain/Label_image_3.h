// SPDX-License-Identifier: GPL-3.0-or-later
//
// A labelled image of space, such as a segmented scan (Tournois 2009, sec. 4.2.1.3): every voxel belongs to a material.
// Between voxel centers, the material with the largest trilinear weight wins, which makes boundaries that are smooth
// within a voxel.
//
//   #include <weft/IO/read_label_image.h>
//
//   const weft::Label_image_3 image = weft::IO::read_label_image("liver.inr.gz");
//   const auto domain = weft::image_oracle_3<K>(image);

#ifndef WEFT_SPATIAL_DOMAIN_LABEL_IMAGE_3_H
#define WEFT_SPATIAL_DOMAIN_LABEL_IMAGE_3_H

#include <weft/errors.h>
#include <weft/spatial/domain/Image_oracle_3.h>
#include <weft/spatial/domain/Voxel_image_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// Labels of voxels. Copies share them.
class Label_image_3 final : public Voxel_image_3
{
public:
  /// \param size number of voxels along x, y, z.
  /// \param spacing of their centers, in the input's units.
  /// \param origin center of the first voxel.
  /// \param values of the voxels, x running fastest; 0 is outside. Other values are numbered 1, 2, ... in rising order.
  /// \throws Domain_error if sizes don't fit, spacings aren't positive, there is nothing but 0, or more values than
  ///   labels may be.
  Label_image_3(const std::array<std::size_t, 3>& size, const std::array<double, 3>& spacing,
                const std::array<double, 3>& origin, const std::vector<int>& values)
      : Voxel_image_3(size, spacing, origin, values.size())
  {
    number_labels(values);
    auto labels = std::make_shared<std::vector<std::uint16_t>>();
    labels->reserve(values.size());
    for (const int value : values)
      labels->push_back(static_cast<std::uint16_t>(
          value == 0 ? 0 : std::lower_bound(values_.begin() + 1, values_.end(), value) - values_.begin()));
    labels_ = std::move(labels);
  }

  int number_of_labels() const override { return static_cast<int>(values_.size()); }
  /// The value that voxels of a label have in the image.
  int value(int label) const { return values_[static_cast<std::size_t>(label)]; }
  /// The label of voxels with a value; -1 if there are none.
  int label_of_value(int value) const
  {
    if (value == 0) return 0;
    const auto found = std::lower_bound(values_.begin() + 1, values_.end(), value);
    return found != values_.end() && *found == value ? static_cast<int>(found - values_.begin()) : -1;
  }

  int label(const Voxel& v) const override { return (*labels_)[index(v)]; }

  /// The label at a point; 0 outside of the image. Ties go to the smaller label.
  int label_at(const std::array<double, 3>& p) const override
  {
    std::array<std::size_t, 8> corners;
    std::array<double, 3> t;
    if (!locate(p, corners, t)) return 0;
    std::array<int, 8> labels;
    bool all_same = true;
    for (std::size_t i = 0; i < 8; ++i) {
      labels[i] = (*labels_)[corners[i]];
      all_same = all_same && labels[i] == labels[0];
    }
    return all_same ? labels[0] : winner(labels, t);
  }

  double crossing(const Voxel&, const Voxel&) const override { return 0.5; }
  bool follows_labels() const override { return true; }

  int label_across(const std::array<Voxel, 4>& square) const override
  {
    const int a = label(square[0]), b = label(square[1]), c = label(square[2]), d = label(square[3]);
    return a == c ? (b == d ? -1 : a) : b == d ? b : -1;
  }

  /// The label with the largest weight between eight voxels, the smaller one of two.
  /// \param t how far along x, y and z the point is from the first voxel to the last.
  static int winner(const std::array<int, 8>& labels, const std::array<double, 3>& t)
  {
    int best = 0;
    double most = -1;
    for (const int label : labels) {
      double sum = 0;
      for (std::size_t i = 0; i < 8; ++i)
        if (labels[i] == label) sum += weight(i, t);
      if (sum > most || (sum == most && label < best)) best = label, most = sum;
    }
    return best;
  }

  /// More values than that aren't labels.
  static constexpr std::size_t most_labels = 255;

private:
  void number_labels(const std::vector<int>& values)
  {
    values_ = values;
    std::sort(values_.begin(), values_.end());
    values_.erase(std::unique(values_.begin(), values_.end()), values_.end());
    values_.erase(std::remove(values_.begin(), values_.end(), 0), values_.end());
    if (values_.empty()) throw Domain_error("the image has no voxel with a label other than 0", {}, {});
    if (values_.size() > most_labels)
      throw Domain_error("the image has " + std::to_string(values_.size()) + " labels, more than " +
                             std::to_string(most_labels) + ": is it a grey scale image?",
                         {}, {});
    values_.insert(values_.begin(), 0);
  }

  std::vector<int> values_; ///< by label; 0 first
  std::shared_ptr<const std::vector<std::uint16_t>> labels_;
};

/// The domain oracle of an image, which it keeps a copy of.
template <class K>
Image_oracle_3<K> image_oracle_3(const Label_image_3& image)
{
  return Image_oracle_3<K>(std::make_shared<const Label_image_3>(image));
}

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_LABEL_IMAGE_3_H
