// SPDX-License-Identifier: GPL-3.0-or-later
//
// The domain oracle of an image, of labels or of grey values (Tournois 2009, sec. 4.2.1.3). Its subdomains end at the
// faces of the image's box, which are patches of their own; the box's edges and the curves where labels meet the faces
// are creases. Every component of a label has points to start from.

#ifndef WEFT_SPATIAL_DOMAIN_IMAGE_ORACLE_3_H
#define WEFT_SPATIAL_DOMAIN_IMAGE_ORACLE_3_H

#include <weft/errors.h>
#include <weft/internal/as_index.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/domain/Domain_by_labels_3.h>
#include <weft/spatial/domain/Image_border_3.h>
#include <weft/spatial/domain/interface_seeds_3.h>
#include <weft/spatial/domain/shape_of_image_3.h>
#include <weft/spatial/domain/Voxel_components_3.h>
#include <weft/spatial/domain/Voxel_image_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace weft {

/// A domain that an image describes; `image_oracle_3()` makes it.
/// \tparam K a CGAL kernel whose coordinates are doubles.
template <class K>
class Image_oracle_3 : public Domain_by_labels_3<Image_oracle_3<K>, K>
{
  using Base = Domain_by_labels_3<Image_oracle_3<K>, K>;

public:
  using Point = typename K::Point_3;
  static constexpr bool is_thread_safe = true;

  /// O(voxels).
  /// \throws Domain_error if there is no boundary.
  explicit Image_oracle_3(std::shared_ptr<const Voxel_image_3> image)
      : Base(image->bbox(), internal::Image_border_3<K>(*image).creases()),
        image_(std::move(image)),
        labels_(image_->number_of_labels()),
        components_(std::make_shared<const Voxel_components_3>(*image_))
  {
    find_seeds();
    bool found = false;
    for (int p = 0; p < number_of_patches(); ++p) found = found || Base::is_expected(p);
    if (!found) throw Domain_error("no point of the boundary was found: the image is empty", {}, {});
  }

  const Voxel_image_3& image() const { return *image_; }
  /// Of its voxels, those of the outside among them.
  const Voxel_components_3& components() const { return *components_; }

  int label(const Point& p) const { return (*image_)(p); }

  // ---- Patches: first the interfaces, then for each face of the box those of each label

  int number_of_patches() const { return number_of_interfaces() + 6 * (labels_ - 1); }

  /// The number of the patch between two subdomains: 0-1, 0-2, 1-2, 0-3, ... Those of 0 are within the image.
  static int patch_between(int a, int b)
  {
    const int low = (std::min)(a, b), high = (std::max)(a, b);
    return high * (high - 1) / 2 + low;
  }
  /// The patch where a subdomain ends at the border.
  /// \param face 0 and 1 at the ends of x, then y, then z.
  int patch_at_border(int label, int face) const { return number_of_interfaces() + face * (labels_ - 1) + label - 1; }

  /// The face of the box that a patch lies on, -1 for those inside.
  int face_of_patch(int patch) const
  {
    return patch < number_of_interfaces() ? -1 : (patch - number_of_interfaces()) / (labels_ - 1);
  }
  /// The two subdomains beside a patch, the smaller first.
  std::pair<int, int> sides_of_patch(int patch) const
  {
    if (face_of_patch(patch) >= 0) return {0, (patch - number_of_interfaces()) % (labels_ - 1) + 1};
    int high = 1;
    while ((high + 1) * high / 2 <= patch) ++high;
    return {patch - high * (high - 1) / 2, high};
  }

  int patch(int from, int to, const Point& a, const Point& b) const
  {
    if (!Base::is_in_box(a)) return patch_at_border(to, face_passed(a));
    if (!Base::is_in_box(b)) return patch_at_border(from, face_passed(b));
    return patch_between(from, to);
  }

  /// On a face exactly where it is left there.
  Surface_hit_3<K> crossing(const Point& p, const Point& q, int at_p, int at_q) const
  {
    Surface_hit_3<K> hit = Base::crossing(p, q, at_p, at_q);
    if (const int face = face_of_patch(hit.patch); face >= 0) hit.point = on_face(hit.point, face);
    return hit;
  }

  Surface_hit_3<K> project_on_patch(const Point& p, int patch) const
  {
    if (const int face = face_of_patch(patch); face >= 0) {
      const Point foot = on_face(p, face);
      if (label(foot) == sides_of_patch(patch).second) return {foot, patch};
    }
    return Base::project_on_patch(p, patch);
  }

  /// n well-spread points on each part of a patch; all that there are where these are few, since small components come
  /// into the mesh only as a whole.
  std::vector<Surface_hit_3<K>> patch_seeds(int patch, std::size_t n) const
  {
    std::vector<Surface_hit_3<K>> hits;
    if (!Base::is_expected(patch)) return hits;
    for (const auto& part : Base::seeds()[static_cast<std::size_t>(patch)]) {
      const std::size_t wanted = part.size() <= few_seeds ? part.size() : n;
      for (const auto& hit : internal::spread_over_parts<K>({part}, patch, wanted)) hits.push_back(hit);
    }
    return hits;
  }

  // ---- For the comparison of mesh and domain

  /// Volumes of the interpolated subdomains; see `shape_of_image()`. O(voxels).
  Domain_shape_3 shape() const { return shape_of_image(*image_, *components_); }

  /// Calls `visit(point, patch, unit normal)` for a point of each interface between eight voxels, and for centers of
  /// voxels' faces on the border. Normals point out of the subdomain with the smaller number, but into the outside.
  /// Where the voxels are closer than the spacing, for one of those within a spacing with the same patch, component and
  /// side.
  template <class Visit>
  void visit_samples(double spacing, const Visit& visit) const
  {
    Voxel block; // of which one is enough
    for (std::size_t k = 0; k < 3; ++k)
      block[k] = static_cast<std::ptrdiff_t>(
          (std::max)(1., (std::min)(1e6, std::floor(spacing / (1.8 * image_->spacing()[k])))));
    const bool all = block == Voxel{{1, 1, 1}};
    std::set<std::tuple<Voxel, int, std::size_t, int>> seen;
    const auto is_wanted = [&](const Voxel& v, int patch, std::size_t a, const std::array<double, 3>& normal) {
      const int octant = (normal[0] < 0) + 2 * (normal[1] < 0) + 4 * (normal[2] < 0);
      return all || seen.emplace(Voxel{{v[0] / block[0], v[1] / block[1], v[2] / block[2]}}, patch, a, octant).second;
    };
    for_each_interface([&](const Voxel& v, const Voxel& w, const Point& p, const Point& q) {
      const int patch = patch_between(image_->label(v), image_->label(w));
      const std::array<double, 3> normal = image_->label(w) == 0 ? direction(p, q) : direction(q, p);
      if (!is_wanted(v, patch, components_->component(v), normal)) return;
      const Surface_hit_3<K> hit = crossing(p, q, image_->label(v), image_->label(w));
      if (hit.patch == patch) visit(hit.point, patch, normal);
    });
    for_each_side([&](const Voxel& v, const Voxel& w, std::size_t axis, int side) {
      const bool inside = image_->contains(w);
      const std::size_t a = components_->component(v);
      if (inside && has_interface_[a]) return;
      const int patch = inside ? patch_between(image_->label(v), image_->label(w))
                               : patch_at_border(image_->label(v), static_cast<int>(2 * axis) + side);
      std::array<double, 3> normal{{0, 0, 0}};
      normal[axis] = (side == 0) == (!inside || image_->label(w) == 0) ? -1 : 1;
      if (is_wanted(v, patch, a, normal)) visit(point_between(v, w, axis, side), patch, normal);
    });
  }

  /// Distance from a point of the boundary to where the label changes again along a normal, on either side; at most
  /// `reach`, which it is for a zero normal.
  double thickness(const Point& p, const std::array<double, 3>& normal, double reach) const
  {
    if (normal == std::array<double, 3>()) return reach;
    const auto& s = image_->spacing();
    const double step = 0.25 * (std::min)({s[0], s[1], s[2]});
    double nearest = reach;
    for (const double side : {-1., 1.}) {
      const auto at = [&](double d) { return Base::subdomain(Base::moved(p, internal::Xyz_3{normal}, side * d)); };
      const int first = at(0.2 * step);
      for (double d = step; d < nearest; d += step)
        if (at(d) != first) nearest = d;
    }
    return nearest;
  }

private:
  using Voxel = Voxel_image_3::Voxel;

  int number_of_interfaces() const { return labels_ * (labels_ - 1) / 2; }

  /// The face of the box that a point lies farthest beyond.
  int face_passed(const Point& p) const
  {
    int face = 0;
    double farthest = -HUGE_VAL;
    for (std::size_t k = 0; k < 3; ++k)
      for (int side = 0; side < 2; ++side) {
        const double x = internal::xyz(p)[k], beyond = side == 0 ? image_->border(k, 0) - x : x - image_->border(k, 1);
        if (beyond > farthest) farthest = beyond, face = static_cast<int>(2 * k) + side;
      }
    return face;
  }

  Point on_face(const Point& p, int face) const
  {
    std::array<double, 3> x = internal::xyz(p);
    for (std::size_t k = 0; k < 3; ++k) x[k] = (std::max)(image_->border(k, 0), (std::min)(x[k], image_->border(k, 1)));
    x[static_cast<std::size_t>(face / 2)] = image_->border(static_cast<std::size_t>(face / 2), face % 2);
    return Point(x[0], x[1], x[2]);
  }

  /// Calls `visit(voxel, neighbour, axis, side)` for each two neighbours with different labels, once, and for each face
  /// of a voxel with a label on the border.
  template <class Visit>
  void for_each_side(const Visit& visit) const
  {
    std::array<std::ptrdiff_t, 3> n;
    for (std::size_t k = 0; k < 3; ++k) n[k] = static_cast<std::ptrdiff_t>(image_->size()[k]);
    Voxel v;
    for (v[2] = 0; v[2] < n[2]; ++v[2])
      for (v[1] = 0; v[1] < n[1]; ++v[1])
        for (v[0] = 0; v[0] < n[0]; ++v[0]) {
          const int own = image_->label(v);
          for (std::size_t axis = 0; axis < 3; ++axis) {
            Voxel w = v;
            if (++w[axis] < n[axis]) {
              const int other = image_->label(w);
              if (other == own) continue;
              // From the component with the larger label, which isn't the outside.
              if (other > own)
                visit(w, v, axis, 0);
              else
                visit(v, w, axis, 1);
            } else if (own != 0) {
              visit(v, w, axis, 1);
            }
            if (v[axis] == 0 && own != 0) {
              w = v;
              --w[axis];
              visit(v, w, axis, 0);
            }
          }
        }
  }

  /// Where the label changes between a voxel and its neighbour.
  Point point_between(const Voxel& v, const Voxel& w, std::size_t axis, int side) const
  {
    std::array<double, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = image_->coordinate(k, static_cast<double>(v[k]));
    if (!image_->contains(w))
      x[axis] = image_->border(axis, side);
    else
      x[axis] = image_->coordinate(axis, static_cast<double>(v[axis]) + (side == 0 ? -1 : 1) * image_->crossing(v, w));
    return Point(x[0], x[1], x[2]);
  }

  static std::array<double, 3> direction(const Point& p, const Point& q)
  {
    std::array<double, 3> d{{q.x() - p.x(), q.y() - p.y(), q.z() - p.z()}};
    const double length = std::hypot(d[0], d[1], d[2]);
    for (double& x : d) x /= length;
    return d;
  }

  // ---- Interfaces between eight voxels

  /// Calls `visit(voxel, other, p, q)` for each two labels among eight voxels around a point, the larger first: a voxel
  /// of each, and the mean places of the two, between which they meet. There the boundary is flattest; on the lines
  /// between centers it has its tips, which refinement would follow.
  template <class Visit>
  void for_each_interface(const Visit& visit) const
  {
    for_each_mixed_cell([&](const std::array<Voxel, 8>& voxels, const std::array<int, 8>& labels) {
      for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < 8; ++j) {
          if (labels[i] <= labels[j] || is_repeated(labels, i) || is_repeated(labels, j)) continue;
          const Point p = mean_place(voxels, labels, labels[i]), q = mean_place(voxels, labels, labels[j]);
          if (label(p) == labels[i] && label(q) == labels[j]) visit(voxels[i], voxels[j], p, q);
        }
    });
  }

  /// Calls `visit(voxels, labels)` for each eight voxels around a point that haven't all the same label; at the border
  /// some are taken twice.
  template <class Visit>
  void for_each_mixed_cell(const Visit& visit) const
  {
    std::array<std::ptrdiff_t, 3> last;
    for (std::size_t k = 0; k < 3; ++k) last[k] = static_cast<std::ptrdiff_t>(image_->size()[k]) - 1;
    Voxel low;
    for (low[2] = 0; low[2] < (std::max)(last[2], std::ptrdiff_t(1)); ++low[2])
      for (low[1] = 0; low[1] < (std::max)(last[1], std::ptrdiff_t(1)); ++low[1])
        for (low[0] = 0; low[0] < (std::max)(last[0], std::ptrdiff_t(1)); ++low[0]) {
          std::array<Voxel, 8> voxels;
          std::array<int, 8> labels;
          bool all_same = true;
          for (std::size_t i = 0; i < 8; ++i) {
            for (std::size_t k = 0; k < 3; ++k)
              voxels[i][k] = (std::min)(low[k] + static_cast<std::ptrdiff_t>(i >> k & 1), last[k]);
            labels[i] = image_->label(voxels[i]);
            all_same = all_same && labels[i] == labels[0];
          }
          if (!all_same) visit(voxels, labels);
        }
  }

  static bool is_repeated(const std::array<int, 8>& labels, std::size_t i)
  {
    const auto end = labels.begin() + static_cast<std::ptrdiff_t>(i);
    return std::find(labels.begin(), end, labels[i]) != end;
  }

  Point mean_place(const std::array<Voxel, 8>& voxels, const std::array<int, 8>& labels, int label) const
  {
    std::array<double, 3> x{{0, 0, 0}};
    const auto n = static_cast<double>(std::count(labels.begin(), labels.end(), label));
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        if (labels[i] == label) x[k] += image_->coordinate(k, static_cast<double>(voxels[i][k])) / n;
    return Point(x[0], x[1], x[2]);
  }

  // ---- Seeds

  /// Points of each patch by the components that it lies between: all of small ones, of others one in each block of
  /// voxels, so that images of any size have about as many.
  void find_seeds()
  {
    constexpr double most = 100; // blocks along an axis
    Voxel block;
    for (std::size_t k = 0; k < 3; ++k)
      block[k] = static_cast<std::ptrdiff_t>(std::ceil(static_cast<double>(image_->size()[k]) / most));
    const bool all = block == Voxel{{1, 1, 1}};
    std::set<std::tuple<Voxel, int, std::size_t, std::size_t>> seen;
    std::map<std::tuple<int, std::size_t, std::size_t>, std::vector<Point>> parts;
    has_interface_.assign(components_->components().size(), false);
    const auto is_wanted = [&](const Voxel& v, int patch, std::size_t a, std::size_t b) {
      return all || components_->components()[a].voxels <= few_voxels ||
             seen.emplace(Voxel{{v[0] / block[0], v[1] / block[1], v[2] / block[2]}}, patch, a, b).second;
    };
    for_each_interface([&](const Voxel& v, const Voxel& w, const Point& p, const Point& q) {
      const int patch = patch_between(image_->label(v), image_->label(w));
      const std::size_t a = components_->component(v), b = components_->component(w);
      if (!is_wanted(v, patch, a, b)) return;
      const Surface_hit_3<K> hit = crossing(p, q, image_->label(v), image_->label(w));
      if (hit.patch != patch) return; // a third label lies between
      parts[{patch, a, b}].push_back(hit.point);
      has_interface_[a] = true;
    });
    for_each_side([&](const Voxel& v, const Voxel& w, std::size_t axis, int side) {
      const bool inside = image_->contains(w);
      const std::size_t a = components_->component(v), b = inside ? components_->component(w) : 0;
      if (inside && has_interface_[a]) return;
      const int patch = inside ? patch_between(image_->label(v), image_->label(w))
                               : patch_at_border(image_->label(v), static_cast<int>(2 * axis) + side);
      if (is_wanted(v, patch, a, b)) parts[{patch, a, b}].push_back(point_between(v, w, axis, side));
    });
    std::vector<std::vector<std::vector<Point>>> seeds;
    for (auto& [key, points] : parts) {
      const auto patch = static_cast<std::size_t>(std::get<0>(key));
      if (patch >= seeds.size()) seeds.resize(patch + 1);
      seeds[patch].push_back(std::move(points));
    }
    Base::set_seeds(std::move(seeds));
  }

  static constexpr std::size_t few_seeds = 100;
  static constexpr std::size_t few_voxels = 1000;

  std::shared_ptr<const Voxel_image_3> image_;
  int labels_;
  std::shared_ptr<const Voxel_components_3> components_;
  std::vector<char> has_interface_; ///< by component, whether `for_each_interface()` has points of it
};

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_IMAGE_ORACLE_3_H
