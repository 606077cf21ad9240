// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's AABB tree of triangles under one name: its parts were renamed in CGAL 6.0. Not in cgal_version.h because few
// need it and it takes long to compile.

#ifndef WEFT_INTERNAL_BOXES_CGAL_AABB_TREE_H
#define WEFT_INTERNAL_BOXES_CGAL_AABB_TREE_H

#include <CGAL/AABB_tree.h>

#if __has_include(<CGAL/AABB_traits_3.h>)
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <vector>

namespace weft::internal {

#if __has_include(<CGAL/AABB_traits_3.h>)
template <class K>
using Triangle_tree_primitive_3 =
    CGAL::AABB_triangle_primitive_3<K, typename std::vector<typename K::Triangle_3>::const_iterator>;
template <class K>
using Triangle_tree_3 = CGAL::AABB_tree<CGAL::AABB_traits_3<K, Triangle_tree_primitive_3<K>>>;
#else
template <class K>
using Triangle_tree_primitive_3 =
    CGAL::AABB_triangle_primitive<K, typename std::vector<typename K::Triangle_3>::const_iterator>;
template <class K>
using Triangle_tree_3 = CGAL::AABB_tree<CGAL::AABB_traits<K, Triangle_tree_primitive_3<K>>>;
#endif

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_CGAL_AABB_TREE_H
