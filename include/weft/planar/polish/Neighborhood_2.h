// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices near a face of a Working_mesh_2 with the places they had, so that what a trial does to them can be judged
// and taken back.

#ifndef WEFT_PLANAR_POLISH_NEIGHBORHOOD_2_H
#define WEFT_PLANAR_POLISH_NEIGHBORHOOD_2_H

#include <weft/planar/polish/Polisher_2.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Calls a function with the faces of the domain around some vertices, once each. Face ids are scratch.
template <class Mesh, class Function>
void for_domain_faces_around(const Mesh& mesh, const std::vector<typename Mesh::Vertex_handle>& vertices,
                             const Function& function)
{
  using Face_handle = typename Mesh::Face_handle;
  const auto for_faces = [&](const auto& inner) {
    for (const auto v : vertices) {
      auto face = mesh.triangulation().incident_faces(v);
      const auto done = face;
      do inner(Face_handle(face));
      while (++face != done);
    }
  };
  for_faces([](Face_handle f) { f->set_id(0); });
  for_faces([&](Face_handle f) {
    if (f->id() == 0 && f->is_in_domain()) function(f);
    f->set_id(1); // seen
  });
}

/// Sum of what the faces of the domain around some vertices cost.
template <class Mesh>
double cost_around(const Mesh& mesh, const Polisher_2<Mesh>& polisher,
                   const std::vector<typename Mesh::Vertex_handle>& vertices)
{
  double sum = 0;
  for_domain_faces_around(mesh, vertices, [&](typename Mesh::Face_handle f) { sum += polisher.cost(f); });
  return sum;
}

/// The vertices within some rings of edges around a face, without the mesh's frame.
template <class Mesh>
class Neighborhood_2
{
public:
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  /// \param rings 1 for the vertices of the face and their neighbors.
  Neighborhood_2(Mesh& mesh, Face_handle f, int rings) : mesh_(mesh)
  {
    for (int i = 0; i < 3; ++i) append_with_neighbors(f->vertex(i));
    for (int ring = 1; ring < rings; ++ring)
      for (std::size_t i = 0, n = vertices_.size(); i < n; ++i) append_with_neighbors(vertices_[i]);
    for (const Vertex_handle v : vertices_) points_.push_back(v->point());
  }

  const std::vector<Vertex_handle>& vertices() const { return vertices_; }

  /// Forgets a vertex that is about to be removed. Returns the place it had.
  Point forget(Vertex_handle v)
  {
    const auto i = std::find(vertices_.begin(), vertices_.end(), v) - vertices_.begin();
    const Point p = points_[static_cast<std::size_t>(i)];
    vertices_.erase(vertices_.begin() + i);
    points_.erase(points_.begin() + i);
    return p;
  }

  /// Adds a vertex at its present place.
  void add(Vertex_handle v)
  {
    vertices_.push_back(v);
    points_.push_back(v->point());
  }

  /// Moves the vertices back to the places they had. A free vertex that can't walk there is removed and inserted
  /// again. Where rounding forbids even that, the mesh stays valid all the same.
  void put_back()
  {
    for (int attempt = 0; attempt < 3; ++attempt) {
      std::vector<Vertex_handle> moved;
      std::vector<Point> points;
      for (std::size_t i = 0; i < vertices_.size(); ++i)
        if (vertices_[i]->point() != points_[i]) {
          moved.push_back(vertices_[i]);
          points.push_back(points_[i]);
        }
      if (moved.empty()) return;
      mesh_.relocator().move(moved, points);
      for (const Vertex_handle v : moved) mesh_.update_target(v);
      for (std::size_t i = vertices_.size(); i-- > 0;)
        if (vertices_[i]->point() != points_[i] && vertices_[i]->constraint() == free_vertex) insert_again(i);
    }
  }

private:
  void insert_again(std::size_t i)
  {
    const int id = vertices_[i]->id();
    if (!mesh_.remove(vertices_[i])) return;
    vertices_[i] = mesh_.insert_inside(points_[i], vertices_[i == 0 ? 1 : 0]->face());
    if (vertices_[i] != Vertex_handle()) return mesh_.adopt(vertices_[i], id);
    vertices_.erase(vertices_.begin() + static_cast<std::ptrdiff_t>(i));
    points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(i));
  }

  void append_with_neighbors(Vertex_handle v)
  {
    append(v);
    auto neighbor = mesh_.triangulation().incident_vertices(v);
    const auto done = neighbor;
    do append(neighbor);
    while (++neighbor != done);
  }

  void append(Vertex_handle v)
  {
    if (!mesh_.triangulation().is_infinite(v) && !mesh_.is_frame(v) &&
        std::find(vertices_.begin(), vertices_.end(), v) == vertices_.end())
      vertices_.push_back(v);
  }

  Mesh& mesh_;
  std::vector<Vertex_handle> vertices_;
  std::vector<Point> points_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_POLISH_NEIGHBORHOOD_2_H
