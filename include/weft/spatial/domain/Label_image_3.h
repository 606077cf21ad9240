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
#include <weft/spatial/domain/Labelled_oracle_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// Labels of voxels. Copies share them.
class Label_image_3
{
public:
  /// \param size number of voxels along x, y, z.
  /// \param spacing of their centers, in the input's units.
  /// \param origin center of the first voxel.
  /// \param values of the voxels, x running fastest; 0 is outside. Other values are numbered 1, 2, ... in rising order.
  /// \throws Domain_error if sizes don't fit, spacings aren't positive or there is nothing but 0.
  Label_image_3(const std::array<std::size_t, 3>& size, const std::array<double, 3>& spacing,
                const std::array<double, 3>& origin, const std::vector<int>& values)
      : size_(size), spacing_(spacing), origin_(origin)
  {
    if (size[0] == 0 || size[1] == 0 || size[2] == 0 || values.size() / size[0] / size[1] != size[2] ||
        values.size() != size[0] * size[1] * size[2])
      throw Domain_error("the image has " + std::to_string(values.size()) + " values, not " + std::to_string(size[0]) +
                             " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]),
                         {}, {});
    for (const double s : spacing)
      if (!(s > 0) || !std::isfinite(s)) throw Domain_error("the spacing of the voxels must be positive", {}, {});
    number_labels(values);
    auto labels = std::make_shared<std::vector<std::uint16_t>>();
    labels->reserve(values.size());
    for (const int value : values)
      labels->push_back(static_cast<std::uint16_t>(
          value == 0 ? 0 : std::lower_bound(values_.begin() + 1, values_.end(), value) - values_.begin()));
    labels_ = std::move(labels);
  }

  const std::array<std::size_t, 3>& size() const { return size_; }
  const std::array<double, 3>& spacing() const { return spacing_; }

  int number_of_labels() const { return static_cast<int>(values_.size()); }
  /// The value that voxels of a label have in the image.
  int value(int label) const { return values_[static_cast<std::size_t>(label)]; }

  /// Contains all voxels.
  CGAL::Bbox_3 bbox() const
  {
    std::array<double, 3> low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = origin_[k] - 0.5 * spacing_[k];
      high[k] = origin_[k] + (static_cast<double>(size_[k]) - 0.5) * spacing_[k];
    }
    return CGAL::Bbox_3(low[0], low[1], low[2], high[0], high[1], high[2]);
  }

  /// The label at a point; 0 outside of the image. Ties go to the smaller label.
  template <class Point>
  int operator()(const Point& p) const
  {
    std::array<std::ptrdiff_t, 3> cell;
    std::array<double, 3> t;
    const std::array<double, 3> x{{p.x(), p.y(), p.z()}};
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = (x[k] - origin_[k]) / spacing_[k];
      if (!(at > -1 && at < static_cast<double>(size_[k]))) return 0;
      const double floor = std::floor(at);
      cell[k] = static_cast<std::ptrdiff_t>(floor);
      t[k] = at - floor;
    }
    std::array<int, 8> labels;
    bool all_same = true;
    for (int i = 0; i < 8; ++i) {
      labels[static_cast<std::size_t>(i)] = voxel(cell[0] + (i & 1), cell[1] + (i >> 1 & 1), cell[2] + (i >> 2));
      all_same = all_same && labels[static_cast<std::size_t>(i)] == labels[0];
    }
    return all_same ? labels[0] : winner(labels, t);
  }

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

  int voxel(std::ptrdiff_t x, std::ptrdiff_t y, std::ptrdiff_t z) const
  {
    const auto within = [](std::ptrdiff_t i, std::size_t n) { return i >= 0 && i < static_cast<std::ptrdiff_t>(n); };
    if (!within(x, size_[0]) || !within(y, size_[1]) || !within(z, size_[2])) return 0;
    return (*labels_)[(static_cast<std::size_t>(z) * size_[1] + static_cast<std::size_t>(y)) * size_[0] +
                      static_cast<std::size_t>(x)];
  }

  static int winner(const std::array<int, 8>& labels, const std::array<double, 3>& t)
  {
    int best = 0;
    double most = -1;
    for (const int label : labels) {
      double weight = 0;
      for (std::size_t i = 0; i < 8; ++i)
        if (labels[i] == label)
          weight += (i & 1 ? t[0] : 1 - t[0]) * (i & 2 ? t[1] : 1 - t[1]) * (i & 4 ? t[2] : 1 - t[2]);
      if (weight > most || (weight == most && label < best)) best = label, most = weight;
    }
    return best;
  }

  static constexpr std::size_t most_labels = 255;

  std::array<std::size_t, 3> size_;
  std::array<double, 3> spacing_, origin_;
  std::vector<int> values_; ///< by label; 0 first
  std::shared_ptr<const std::vector<std::uint16_t>> labels_;
};

/// The domain oracle of an image. Its boundary is looked for from voxel to voxel, up to 160 along the longest side.
template <class K>
Labelled_oracle_3<K, Label_image_3> image_oracle_3(const Label_image_3& image)
{
  const CGAL::Bbox_3 b = image.bbox();
  const double longest = (std::max)({b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin()});
  const auto& s = image.spacing();
  const double voxels = std::ceil(longest / (std::min)({s[0], s[1], s[2]}));
  return Labelled_oracle_3<K, Label_image_3>(image, b, image.number_of_labels(),
                                             static_cast<int>((std::min)(160., (std::max)(2., voxels))));
}

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_LABEL_IMAGE_3_H
