# SPDX-License-Identifier: GPL-3.0-or-later
"""Spatial meshers as processes. The bounds in each tool's terms (l: longest edge, e: distance to the surface, r:
circumradius / shortest edge):

weft     --size l --approximation e --facet-shape r --cell-shape r
CGAL     edge_size l, facet_size l / sqrt 3, cell_size l sqrt 6 / 4, facet_distance e, facet_angle asin(1 / 2r),
         cell_radius_edge_ratio r (the circumradii of regular simplices of edge l)
TetGen   -q r -a V: V the volume of a regular tetrahedron of edge l; it keeps the surface's triangles, so needs no e
Gmsh     MeshSizeMax l; it has no bound of distance or shape
Netgen   maxh l, the same

None of the last three bounds edges: l is lowered for them until no edge is longer than asked, in at most four runs. One
that still keeps longer edges, mostly those of the given triangles, has them in the column "longest edge / l".
"""

import math
import shutil

from . import process
from .peers_2d import lowered, measured, meshing_seconds

NETGEN = __file__.replace("peers_3d.py", "netgen_mesh.py")
CHAINS = (("CGAL refine", ""), ("CGAL + perturb", "perturb"), ("CGAL + exude", "exude"),
          ("CGAL + ODT + perturb", "odt,perturb"), ("CGAL + Lloyd + perturb", "lloyd,perturb"),
          ("CGAL + ODT + perturb + exude", "odt,perturb,exude"))


class Bounds:
    def __init__(self, size, approximation=0.0, shape=2.0):
        self.size, self.approximation, self.shape = size, approximation, shape

    def volume(self):
        return self.size ** 3 / (6 * math.sqrt(2))


class Mesher:
    """One way to a spatial mesh.

    :param command: (input, bounds, mesh file) -> command line; `input` has `off`, `stl` and `sharp_angle`.
    :param bounds_edges: whether the tool bounds edges; else its size is lowered until no edge is longer.
    :param suffix: the format of its mesh.
    """

    def __init__(self, name, command, bounds_edges=True, suffix=".mesh", statuses=(0,)):
        self.name, self.command, self.bounds_edges = name, command, bounds_edges
        self.suffix, self.statuses = suffix, statuses


def weft_command(programs, given, b, out, *more):
    return [programs.mesh_3, given.off, "--size", b.size, "--approximation", b.approximation, "--facet-shape", b.shape,
            "--cell-shape", b.shape, "--sharp-angle", given.sharp_angle, "--output", out, "--threads", 1, "--quiet",
            *(["--topology"] if given.sharp_angle else []), *more]


def gmsh_file(given, b, out, algorithm, optimise, anew):
    """Writes the .geo file of a run. :param anew: whether the surface is meshed anew."""
    geo = out.with_suffix(".geo")
    geo.write_text(f'Merge "{given.stl}";\n'
                   + (f"ClassifySurfaces{{{given.sharp_angle or 60} * Pi / 180, 1, 1, Pi}};\nCreateGeometry;\n" if anew
                      else "") +
                   f"Surface Loop(1) = Surface{{:}};\nVolume(1) = {{1}};\nMesh.MeshSizeMax = {b.size};\n"
                   + (f"Mesh.MeshSizeMin = {b.size};\n" if anew else "") +
                   f"Mesh.Algorithm3D = {algorithm};\nMesh.Optimize = {optimise};\n")
    return geo


def gmsh_meshers(gmsh, anew):
    found = []
    for algorithm, title in ((1, "Delaunay"), (10, "HXT")):
        for optimise, suffix in ((0, ""), (1, ", optimised")):
            found.append(Mesher(f"Gmsh {title}{suffix}", lambda i, b, out, a=algorithm, o=optimise: [
                gmsh, "-3", "-nt", 1, "-format", "msh22", "-o", out, gmsh_file(i, b, out, a, o, anew)], False, ".msh"))
    return found


def tetgen_copy(given, out):
    """TetGen names its files after the input's."""
    copy = out.with_name(out.stem + "_in.off")
    shutil.copy(given.off, copy)
    return copy


def tetgen_meshers(tetgen, flags=""):
    def command(quality):
        return lambda i, b, out: [tetgen, f"-p{flags}q{quality(b)}a{b.volume():.12g}", tetgen_copy(i, out)]
    mesh = "_in.1.ele"
    return [Mesher("TetGen", command(lambda b: f"{b.shape:g}"), False, mesh),
            Mesher("TetGen, dihedral 18°", command(lambda b: "1.4/18O7"), False, mesh)]


def netgen_meshers(python, kind):
    return [Mesher(name, lambda i, b, out, o=optimise: [
        python, NETGEN, kind, i.stl if kind == "surface" else i.off, out, b.size, o], False, ".msh")
            for name, optimise in (("Netgen, not optimised", 0), ("Netgen", 1))]


def meshers(programs, seconds, boundary=False):
    """The meshers of a surface, or of the inside of a given boundary; and why others are left out.

    :param seconds: for weft's run as far as it goes, and for each stage of CGAL's chains.
    """
    found, missing = [], []
    if not boundary:
        found += [
            Mesher("weft refine", lambda i, b, out: weft_command(programs, i, b, out, "--no-optimise", "--no-perturb"),
                   statuses=(0, 2)),
            Mesher("weft", lambda i, b, out: weft_command(programs, i, b, out), statuses=(0, 2)),
            Mesher("weft, as far as it goes", lambda i, b, out: weft_command(
                programs, i, b, out, "--min-dihedral", 90, "--time-limit", seconds), statuses=(0, 2))]
        for name, chain in CHAINS:
            found.append(Mesher(name, lambda i, b, out, c=chain: [
                programs.cgal_mesh_3, "--size", b.size, "--approximation", b.approximation, "--shape", b.shape,
                "--sharp-angle", i.sharp_angle, "--time-limit", seconds, "--output", out,
                *(["--chain", c] if c else []), i.off]))
    tetgen, gmsh, python = shutil.which("tetgen"), shutil.which("gmsh"), process.python_with("netgen.stl")
    for tool, package, make in ((tetgen, "tetgen", lambda: tetgen_meshers(tetgen, "Y" if boundary else "")),
                                (gmsh, "gmsh", lambda: gmsh_meshers(gmsh, not boundary)),
                                (python, "python3-netgen",
                                 lambda: netgen_meshers(python, "boundary" if boundary else "surface"))):
        if tool:
            found += make()
        else:
            missing.append((package, f"not installed (package {package})"))
    return found, missing


def mesh_file(mesher, out):
    """Where a mesher leaves its mesh, for the path it was given."""
    return out.with_name(out.stem + mesher.suffix) if mesher.suffix.startswith("_") else out.with_suffix(mesher.suffix)


def mesh_once(mesher, given, bounds, out, limit, measure, most_tries=4):
    """As peers_2d.mesh_once(), in space."""
    out = out.with_suffix(mesher.suffix) if mesher.suffix[0] == "." else out
    mesh = mesh_file(mesher, out)

    def attempt(size, _):
        mesh.unlink(missing_ok=True)
        asked = Bounds(size, bounds.approximation, bounds.shape)
        result = measured(process.run(mesher.command(given, asked, out), limit, mesher.statuses), mesh, measure)
        if "failure" not in result:
            result["ratio"] = result["longest_ratio"] = result["longest_edge"] / bounds.size
        return result
    return lowered(mesher.bounds_edges, most_tries + 1, bounds.size, attempt)


def repeat_times(mesher, given, bounds, result, out, limit, repeats):
    again = Bounds(result["size_given"], bounds.approximation, bounds.shape)
    out = out.with_suffix(mesher.suffix) if mesher.suffix[0] == "." else out
    return [meshing_seconds(process.run(mesher.command(given, again, out), limit, mesher.statuses))
            for _ in range(repeats)]
