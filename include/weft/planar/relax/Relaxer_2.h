// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relaxation in sweeps: all targets of Lloyd's iteration are computed, then all vertices moved (Tournois 2009, sec.
// 2.2.2). Vertices that have come to rest are left alone while their neighbors rest, too; so the last sweeps cost
// little.

#ifndef WEFT_PLANAR_RELAX_RELAXER_2_H
#define WEFT_PLANAR_RELAX_RELAXER_2_H

#include <weft/internal/as_index.h>
#include <weft/planar/relax/Lloyd_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/planar/triangulation/Relocator_2.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Relaxes a Working_mesh_2.
template <class Mesh>
class Relaxer_2
{
public:
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  /// When to end, and how exact to be.
  struct Effort
  {
    double move_ratio; ///< ends when no vertex moves farther, in parts of its cell's size
    int quadrature;    ///< quadrature triangles a Voronoi cell; ignored by uniform sizing
    int most_sweeps;
  };
  /// What a relaxation did.
  struct Outcome
  {
    std::size_t sweeps = 0;
    Relocation_counts moves;
  };

  /// \param size_feedback,threads as in Mesh_options_2.
  Relaxer_2(Mesh& mesh, double size_feedback, int threads)
      : mesh_(mesh), size_feedback_(size_feedback), threads_(threads)
  {}

  /// Moves some vertices, then those that moved and their neighbors, and so on.
  /// \param go_on callable without arguments, called before every sweep; false stops.
  template <class Go_on>
  Outcome run(std::vector<Vertex_handle> active, const Effort& effort, const Go_on& go_on)
  {
    // A vertex rests when it moves less than this part of the stopping ratio.
    constexpr double rest = 0.1;
    Outcome outcome;
    Lloyd_2<Mesh> smoother(mesh_, size_feedback_, effort.quadrature, threads_);
    is_active_.assign(mesh_.vertices().size(), 0);
    std::vector<Vertex_handle> moving;
    std::vector<Point> targets;
    for (int sweep = 0; sweep < effort.most_sweeps && !active.empty() && go_on(); ++sweep) {
      smoother.compute(faces_around(active));
      moving.clear();
      targets.clear();
      double largest = 0;
      for (const Vertex_handle v : active) {
        if (v->constraint() == fixed_vertex || mesh_.is_frozen(v)) continue;
        const auto t = smoother.target(v);
        largest = (std::max)(largest, t.move_ratio);
        if (t.move_ratio < rest * effort.move_ratio) continue;
        moving.push_back(v);
        targets.push_back(t.point);
      }
      outcome.moves += mesh_.relocator().move(moving, targets);
      for (const Vertex_handle v : moving) mesh_.update_target(v);
      ++outcome.sweeps;
      if (largest < effort.move_ratio) break;
      active = with_neighbors(moving);
    }
    return outcome;
  }

  /// The vertices and their neighbors, without frozen ones, once each, by number.
  std::vector<Vertex_handle> with_neighbors(const std::vector<Vertex_handle>& vertices) const
  {
    std::vector<char> listed(mesh_.vertices().size(), 0);
    std::size_t count = 0;
    const auto list = [&](Vertex_handle v) {
      if (mesh_.is_frame(v) || mesh_.is_frozen(v) || listed[as_index(v->id())]) return;
      listed[as_index(v->id())] = 1;
      ++count;
    };
    for (const Vertex_handle v : vertices) {
      list(v);
      auto neighbor = mesh_.triangulation().incident_vertices(v);
      const auto done = neighbor;
      do list(neighbor);
      while (++neighbor != done);
    }
    std::vector<Vertex_handle> result;
    result.reserve(count);
    for (std::size_t i = 0; i < listed.size(); ++i)
      if (listed[i]) result.push_back(mesh_.vertices()[i]);
    return result;
  }

private:
  /// Faces of the domain around the vertices, once each.
  std::vector<Face_handle> faces_around(const std::vector<Vertex_handle>& active)
  {
    if (active.size() * 3 > mesh_.vertices().size()) return mesh_.faces();
    for (const Vertex_handle v : active) is_active_[as_index(v->id())] = 1;
    std::vector<Face_handle> faces;
    for (const Vertex_handle v : active) {
      auto face = mesh_.triangulation().incident_faces(v);
      const auto done = face;
      do
        if (face->is_in_domain() && is_first_active(face, v)) faces.push_back(face);
      while (++face != done);
    }
    for (const Vertex_handle v : active) is_active_[as_index(v->id())] = 0;
    return faces;
  }

  /// A face is listed by the active vertex of it with the smallest number.
  bool is_first_active(Face_handle f, Vertex_handle v) const
  {
    for (int i = 0; i < 3; ++i)
      if (f->vertex(i)->id() < v->id() && is_active_[as_index(f->vertex(i)->id())]) return false;
    return true;
  }

  Mesh& mesh_;
  double size_feedback_;
  int threads_;
  std::vector<char> is_active_; // by vertex, while faces are listed
};

} // namespace weft::internal

#endif // WEFT_PLANAR_RELAX_RELAXER_2_H
