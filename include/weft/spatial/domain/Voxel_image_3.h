// SPDX-License-Identifier: GPL-3.0-or-later
//
// What images of space have in common, be they of labels or of grey values: voxels on a grid with one spacing per axis,
// and a label at every point of the box that the voxels fill. Towards the faces of that box values go on as they are at
// the centers of the outermost voxels, so that what fills an image to its border meets the faces at right angles.

#ifndef WEFT_SPATIAL_DOMAIN_VOXEL_IMAGE_3_H
#define WEFT_SPATIAL_DOMAIN_VOXEL_IMAGE_3_H

#include <weft/errors.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace weft {

/// An image that tells subdomains apart. All functions may be called by several threads at once.
class Voxel_image_3
{
public:
  using Voxel = std::array<std::ptrdiff_t, 3>; ///< numbers along x, y, z, from 0

  /// \param size number of voxels along x, y, z.
  /// \param spacing of their centers, in the input's units.
  /// \param origin center of the first voxel.
  /// \param values how many there are.
  /// \throws Domain_error if sizes don't fit or spacings aren't positive.
  Voxel_image_3(const std::array<std::size_t, 3>& size, const std::array<double, 3>& spacing,
                const std::array<double, 3>& origin, std::size_t values)
      : size_(size), spacing_(spacing), origin_(origin)
  {
    if (size[0] == 0 || size[1] == 0 || size[2] == 0 || values / size[0] / size[1] != size[2] ||
        values != size[0] * size[1] * size[2])
      throw Domain_error("the image has " + std::to_string(values) + " values, not " + std::to_string(size[0]) + " x " +
                             std::to_string(size[1]) + " x " + std::to_string(size[2]),
                         {}, {});
    for (const double s : spacing)
      if (!(s > 0) || !std::isfinite(s)) throw Domain_error("the spacing of the voxels must be positive", {}, {});
  }
  virtual ~Voxel_image_3() = default;

  const std::array<std::size_t, 3>& size() const { return size_; }
  const std::array<double, 3>& spacing() const { return spacing_; }
  double voxel_volume() const { return spacing_[0] * spacing_[1] * spacing_[2]; }

  /// The box that the voxels fill, half a spacing beyond the outermost centers.
  CGAL::Bbox_3 bbox() const
  {
    return CGAL::Bbox_3(border(0, 0), border(1, 0), border(2, 0), border(0, 1), border(1, 1), border(2, 1));
  }
  /// Coordinate of the lower (0) or upper (1) face of that box across an axis.
  double border(std::size_t axis, int side) const
  {
    return side == 0 ? origin_[axis] - 0.5 * spacing_[axis]
                     : origin_[axis] + (static_cast<double>(size_[axis]) - 0.5) * spacing_[axis];
  }

  /// Coordinate along an axis of a place in voxels; whole numbers are centers.
  double coordinate(std::size_t axis, double place) const { return origin_[axis] + place * spacing_[axis]; }

  bool contains(const Voxel& v) const
  {
    for (std::size_t k = 0; k < 3; ++k)
      if (v[k] < 0 || v[k] >= static_cast<std::ptrdiff_t>(size_[k])) return false;
    return true;
  }
  /// The voxel that a point lies in, or the nearest one.
  template <class Point>
  Voxel voxel_at(const Point& p) const
  {
    const std::array<double, 3> x{{p.x(), p.y(), p.z()}};
    Voxel v;
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = std::floor((x[k] - origin_[k]) / spacing_[k] + 0.5);
      v[k] = static_cast<std::ptrdiff_t>((std::max)(0., (std::min)(at, static_cast<double>(size_[k]) - 1)));
    }
    return v;
  }

  /// The label at a point; 0 outside of the box.
  template <class Point>
  int operator()(const Point& p) const
  {
    return label_at({{p.x(), p.y(), p.z()}});
  }

  // ---- what the kinds of images differ in

  /// Including 0, the outside.
  virtual int number_of_labels() const = 0;
  /// The label at the center of a voxel.
  /// \pre The image contains it.
  virtual int label(const Voxel& v) const = 0;
  virtual int label_at(const std::array<double, 3>& p) const = 0;
  /// Where the label changes between the centers of neighbours with different labels: part of the way from a to b.
  virtual double crossing(const Voxel& a, const Voxel& b) const = 0;
  /// The label that two voxels across a square of four neighbours share and that hangs together between them, where the
  /// two others don't; -1 if all four meet in the middle.
  /// \param square in order around; no two neighbours have the same label.
  virtual int label_across(const std::array<Voxel, 4>& square) const = 0;
  /// Whether labels between eight centers depend on their labels alone.
  virtual bool follows_labels() const = 0;

protected:
  Voxel_image_3(const Voxel_image_3&) = default;
  Voxel_image_3& operator=(const Voxel_image_3&) = default;

  /// The numbers of the eight voxels around a point, x running fastest, the nearest ones where there is no other, and
  /// how far the point lies from the center of the first to that of the last, along each axis.
  /// \returns whether the point lies in the box.
  bool locate(const std::array<double, 3>& x, std::array<std::size_t, 8>& corners, std::array<double, 3>& t) const
  {
    std::size_t first = 0, stride = 1;
    std::array<std::size_t, 3> step;
    for (std::size_t k = 0; k < 3; ++k) {
      const double last = static_cast<double>(size_[k]) - 1;
      double at = (x[k] - origin_[k]) / spacing_[k];
      if (!(at >= -0.5 - rounding && at <= last + 0.5 + rounding)) return false;
      at = (std::max)(0., (std::min)(at, last));
      const double floor = (std::max)(0., (std::min)(std::floor(at), last - 1));
      t[k] = at - floor;
      first += static_cast<std::size_t>(floor) * stride;
      step[k] = size_[k] > 1 ? stride : 0;
      stride *= size_[k];
    }
    for (std::size_t i = 0; i < 8; ++i)
      corners[i] = first + (i & 1 ? step[0] : 0) + (i & 2 ? step[1] : 0) + (i & 4 ? step[2] : 0);
    return true;
  }

  std::size_t index(const Voxel& v) const
  {
    return (static_cast<std::size_t>(v[2]) * size_[1] + static_cast<std::size_t>(v[1])) * size_[0] +
           static_cast<std::size_t>(v[0]);
  }
  /// The weight of one of these voxels.
  static double weight(std::size_t corner, const std::array<double, 3>& t)
  {
    return (corner & 1 ? t[0] : 1 - t[0]) * (corner & 2 ? t[1] : 1 - t[1]) * (corner & 4 ? t[2] : 1 - t[2]);
  }

private:
  static constexpr double rounding = 1e-9; // of the faces' coordinates, in voxels

  std::array<std::size_t, 3> size_;
  std::array<double, 3> spacing_, origin_;
};

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_VOXEL_IMAGE_3_H
