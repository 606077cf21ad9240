// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options and report of `improve_3()`.

#ifndef WEFT_SPATIAL_LOCAL_IMPROVE_OPTIONS_3_H
#define WEFT_SPATIAL_LOCAL_IMPROVE_OPTIONS_3_H

#include <weft/errors.h>
#include <weft/internal/counted.h>
#include <weft/report.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/visitor.h>

#include <cstddef>
#include <limits>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// What may happen to the boundary of a mesh.
enum class Boundary_3
{
  slide, ///< vertices slide on the surface that the boundary triangles of the input are
  fixed  ///< every boundary and interface triangle stays as it is; only what lies inside changes
};

/// Options of `improve_3()`.
struct Improve_options_3
{
  Boundary_3 boundary = Boundary_3::slide;
  std::vector<std::size_t> fixed_vertices; ///< of the input, that have to stay where they are

  /// Smallest dihedral angle in degrees to reach; 90: as far as it goes, which takes long without a `time_limit`.
  double min_dihedral_angle = 25;
  // For boundaries that slide:

  /// Edges of the boundary are sharp from this angle between the normals of their facets on, in degrees; 0: none by
  /// their angle.
  double sharp_angle = 60;
  /// Whether edges between patches and those listed in the mesh are sharp, too, and its corners stay. Else patches are
  /// what the nearest triangle of the input belongs to: for tags that mean nothing, such as the charts that Netgen cuts
  /// surfaces into, which would cost vertices.
  bool tagged_features = true;
  /// How far the boundary may get from that of the input, in parts of the length of boundary edges nearby.
  double deviation = 0.1;
  int smoothing_sweeps = 3; ///< most sweeps of smoothing
  bool coarsen = false;     ///< take away vertices that neither the boundary nor sizes need
  /// Whether the mesh ends as a Delaunay mesh, by perturbation of its vertices. Local changes reach more in less time.
  bool delaunay = false;

  std::size_t max_vertices = 20000000;                         ///< vertex budget
  double time_limit = std::numeric_limits<double>::infinity(); ///< seconds of wall time
  unsigned seed = 0;                                           ///< start of every random choice
  int threads = 1; ///< threads to use where oneTBB is linked; never changes the result
  Visitor visitor; ///< sees progress, may stop the run; may be empty

  /// \throws Option_error naming the first option outside its range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    require(min_dihedral_angle >= 0 && min_dihedral_angle <= 90, "min_dihedral_angle must lie in [0, 90] degrees");
    require(sharp_angle >= 0 && sharp_angle <= 180, "sharp_angle must lie in [0, 180] degrees");
    require(deviation > 0 && deviation <= 1, "deviation must lie in (0, 1]");
    require(smoothing_sweeps >= 0, "smoothing_sweeps must not be negative");
    require(time_limit >= 0, "time_limit must not be negative");
    require(threads > 0, "threads must be positive");
  }
};

/// What `improve_3()` did.
struct Improve_report_3
{
  Quality_3 before, after;
  std::size_t inverted_before = 0, inverted_after = 0; ///< cells that aren't positively oriented
  bool manifold = false;                               ///< whether the boundary is a closed 2-manifold at the end
  /// Elements of the boundary that could not be brought to represent that of the input as asked: where angles are too
  /// acute for a Delaunay mesh. 0 for fixed boundaries.
  std::size_t unrepresented = 0;
  /// The largest smallest dihedral angle that the worst boundary or interface facet allows a cell on it, in degrees: no
  /// mesh that keeps it is better. 180 where the boundary slides.
  double boundary_bound = 180;
  std::size_t moves = 0, insertions = 0, removals = 0, flips = 0; ///< of vertices, and changes of connectivity
  Stop_reason stop_reason = Stop_reason::criteria_met;
  std::vector<std::string> notes;                            ///< about the input, for people
  std::vector<std::pair<std::string, double>> stage_seconds; ///< wall time by stage, in order

  /// Whether the mesh has no inverted cells, represents its boundary, and the run ended by itself.
  bool ok() const
  {
    return stop_reason == Stop_reason::criteria_met && inverted_after == 0 && unrepresented == 0 && manifold;
  }
};

/// Several lines for a person.
inline std::ostream& operator<<(std::ostream& out, const Improve_report_3& r)
{
  using internal::counted;
  const auto line = [&out](const char* when, const Quality_3& q, std::size_t inverted) {
    out << when << q.vertices << " vertices, " << q.cells << " cells, dihedral angles " << q.smallest_dihedral.degrees
        << " to " << q.largest_dihedral.degrees << " degrees; below 5, 10, 15, 20 degrees " << q.cells_below(5) << ", "
        << q.cells_below(10) << ", " << q.cells_below(15) << ", " << q.cells_below(20) << " cells";
    if (inverted) out << "; " << inverted << " inverted";
    out << "\n";
  };
  line("before: ", r.before, r.inverted_before);
  line("after:  ", r.after, r.inverted_after);
  out << counted(r.moves, "move", "moves") << ", " << counted(r.insertions, "insertion", "insertions") << ", "
      << counted(r.removals, "removal", "removals") << ", " << counted(r.flips, "flip", "flips") << "\n"
      << name(r.stop_reason) << ", boundary " << (r.manifold ? "a closed manifold" : "not manifold");
  if (r.boundary_bound < 180) out << ", which allows " << r.boundary_bound << " degrees at most";
  if (r.unrepresented) out << ", " << r.unrepresented << " elements of it not as asked";
  out << "\n";
  for (std::size_t i = 0; i < r.stage_seconds.size(); ++i)
    out << (i ? " " : "") << r.stage_seconds[i].first << " " << r.stage_seconds[i].second << " s";
  return out << "\n";
}

} // namespace weft

#endif // WEFT_SPATIAL_LOCAL_IMPROVE_OPTIONS_3_H
