# SPDX-License-Identifier: GPL-3.0-or-later
"""Planar meshers as processes: each gets the same graph and the same largest edge length, in its own terms."""

import json
import shutil

from . import process

NETGEN = __file__.replace("peers_2d.py", "netgen_mesh.py")


class Mesher:
    """One way to a planar mesh.

    :param command: (input, size, mesh file) -> command line. `input` has `poly` and `geo`, paths.
    :param bounds_edges: whether the tool's size is a largest edge length; else it is lowered until no edge is longer.
    """

    def __init__(self, name, command, bounds_edges, statuses=(0,)):
        self.name, self.command, self.bounds_edges, self.statuses = name, command, bounds_edges, statuses


def meshers(programs, threads=1):
    """The meshers that are installed, and why the others are left out.

    :returns: list of Mesher, list of (name, why).
    """
    found = [
        Mesher("weft", lambda i, s, out: [programs.mesh_2, i.poly, "--size", s, "--output", out, "--threads", threads,
                                          "--quiet"], True, (0, 2)),
        Mesher("CGAL refine", lambda i, s, out: [programs.cgal_mesh_2, "--size", s, "--output", out, i.poly], True),
        Mesher("CGAL refine + Lloyd 100",
               lambda i, s, out: [programs.cgal_mesh_2, "--size", s, "--lloyd", 100, "--output", out, i.poly], True),
    ]
    missing = []
    gmsh = shutil.which("gmsh")
    if gmsh:
        for name, algorithm in (("Gmsh frontal", "front2d"), ("Gmsh Delaunay", "del2d"), ("Gmsh MeshAdapt", "meshadapt")):
            found.append(Mesher(name, lambda i, s, out, a=algorithm: [
                gmsh, "-2", "-algo", a, "-nt", 1, "-clmax", s, "-format", "mesh", "-o", out, i.geo], False))
    else:
        missing.append(("Gmsh", "not installed (package gmsh)"))
    python = process.python_with("netgen.geom2d")
    if python:
        for name, optimise in (("Netgen, not optimised", 0), ("Netgen", 1)):
            found.append(Mesher(name, lambda i, s, out, o=optimise: [python, NETGEN, "planar", i.poly, out, s, o], False))
    else:
        missing.append(("Netgen", "not installed (package python3-netgen)"))
    missing.append(("Triangle", "not in Debian's main section (its licence isn't free)"))
    return found, missing


def meshing_seconds(outcome):
    """User seconds of the process; of Netgen without those of starting Python, which it reports."""
    if '"meshing_seconds"' in outcome.output:
        return json.loads(outcome.output.strip().splitlines()[-1])["meshing_seconds"]
    return outcome.seconds


def mesh_once(mesher, given, size, out, limit, measure):
    """Meshes, with a size lowered as often as it takes where the tool's size isn't a bound.

    :param measure: (mesh file) -> measures, or raises ValueError.
    :returns: dict with measures, "seconds" (of the last run), "memory", "size_given", "tries"; or "failure".
    """
    return lowered(mesher.bounds_edges, 7, size, lambda asked, tries: once(mesher, given, asked, out, limit, measure))


def once(mesher, given, size, out, limit, measure):
    out.unlink(missing_ok=True)
    outcome = process.run(mesher.command(given, size, out), limit, mesher.statuses)
    result = measured(outcome, out, measure)
    if "failure" not in result:
        result["ratio"] = max(result["longest_ratio"], result["longest_edge_ratio"])
    return result


def measured(outcome, mesh, measure):
    """What a mesher's run has left, measured; or why not."""
    if outcome.failure:
        return {"failure": outcome.failure}
    if not mesh.exists() or mesh.stat().st_size == 0:
        return {"failure": "wrote no mesh"}
    try:
        result = measure(mesh)
    except ValueError as error:
        return {"failure": f"its mesh can't be used: {error}"}
    return {**result, "seconds": meshing_seconds(outcome), "memory": outcome.memory,
            "stopped_early": outcome.status == 2}


def lowered(bounds_edges, most_tries, size, attempt):
    """Lowers a size until the longest edge is as asked, where the tool doesn't see to that. Where a lower size fails,
    the last mesh stays, with the failure as "lower_failed".

    :param attempt: (size, number of the try) -> result with "ratio", longest edge / asked; or with "failure".
    """
    result, asked = None, size
    for tries in range(1, 2 if bounds_edges else most_tries):
        found = attempt(asked, tries)
        if "failure" in found:
            return {**result, "lower_failed": found["failure"]} if result else found
        result = {**found, "size_given": asked, "tries": tries}
        if result["ratio"] <= 1 + 1e-9:
            break
        asked *= 0.998 / result["ratio"]
    return result


def repeat_times(mesher, given, result, out, limit, repeats):
    """More times of a run like the last, for a median."""
    return [meshing_seconds(process.run(mesher.command(given, result["size_given"], out), limit, mesher.statuses))
            for _ in range(repeats)]
