# SPDX-License-Identifier: GPL-3.0-or-later
"""What must hold of every mesh, on a small fixed subset of the inputs: no times."""

import json

from . import process

PLANAR = (("square", 2000), ("star", 2000), ("coastline", 2000), ("nested_holes", 1000))  # inputs, triangles asked
SPATIAL = (("ball", 0.15, 0.0), ("cylinder", 0.1, 0.002), ("wedge_52", 0.15, 0.002), ("gear", 0.1, 0.002))
LIMIT = 120


class Broken(Exception):
    """An invariant doesn't hold."""


def require(holds, what):
    if not holds:
        raise Broken(what)


def meshed(command, outputs):
    outcome = process.run(command, LIMIT)
    require(not outcome.failure, outcome.failure + "".join(" " + line for line in outcome.log.splitlines()[-2:]))
    for file in outputs:
        require(file.exists() and file.stat().st_size > 0, f"wrote no {file.name}")


def measured(command):
    outcome = process.run(command, LIMIT)
    require(not outcome.failure, "its mesh can't be measured: " + outcome.failure)
    return outcome.json()[0]


def same_for_threads(command, work, suffix):
    """Meshes with one thread, again, and with two; returns the mesh."""
    meshes = []
    for threads in (1, 1, 2):
        mesh, report = work / f"mesh_{len(meshes)}{suffix}", work / f"report_{len(meshes)}.json"
        for file in (mesh, report):
            file.unlink(missing_ok=True)
        meshed([*command, "--threads", threads, "--output", mesh, "--report", report, "--quiet"], (mesh, report))
        require(json.loads(report.read_text())["ok"], "criteria aren't met, though the status says so")
        meshes.append(mesh)
    contents = [mesh.read_bytes() for mesh in meshes]
    require(contents[0] == contents[1], "a second run makes another mesh")
    require(contents[0] == contents[2], "two threads make another mesh than one")
    return meshes[0]


def check_planar(programs, given, triangles, work):
    size = given.size_for_one / (triangles / 1.5) ** 0.5
    mesh = same_for_threads([programs.mesh_2, given.poly, "--size", size], work, ".mesh")
    m = measured([programs.measure_mesh_2, "--size", size, given.poly, mesh])
    require(m["oversize"] == 0, f"{m['oversize']:.0f} triangles or edges are larger than asked")
    require(m["inverted"] == 0, f"{m['inverted']:.0f} triangles are turned over")
    require(m["non_delaunay"] == 0, f"{m['non_delaunay']:.0f} edges aren't Delaunay")
    require(m["same_area"] and m["same_constraints"], "it isn't a mesh of the input")
    least = min(25, m["smallest_input_angle"] - 1e-6)
    require(m["smallest_angle"] >= least, f"smallest angle {m['smallest_angle']:.2f}° below {least:.2f}°")
    return f"{m['vertices']:.0f} vertices, {m['smallest_angle']:.1f}°–{m['largest_angle']:.1f}°"


def check_spatial(programs, given, size, approximation, work):
    command = [programs.mesh_3, given.off, "--size", size, "--approximation", approximation, "--sharp-angle",
               given.sharp_angle]
    mesh = same_for_threads(command, work, ".mesh")
    m = measured([programs.measure_mesh_3, "--samples", 20000, given.off, mesh])
    require(m["longest_edge"] <= size * (1 + 1e-9), f"longest edge {m['longest_edge']:.4f} above {size}")
    require(m["oriented"], "cells are turned over")
    require(m["delaunay"], "it isn't Delaunay")
    require(m["manifold"], "its boundary isn't a manifold")
    require(max(m["cell_shape"], m["facet_shape"]) <= 2 * (1 + 1e-9), "shapes above 2")
    require(abs(m["volume"] / m["volume_enclosed"] - 1) < 0.05, "its volume isn't that of the input")
    if approximation > 0:
        require(m["hausdorff"] <= 10 * approximation, f"it strays {m['hausdorff']:.4f} from the surface")
    return f"{m['vertices']:.0f} vertices, {m['smallest_dihedral']:.1f}°–{m['largest_dihedral']:.1f}°"


def check(programs, planar, spatial, work):
    """:returns: rows (input, what was found, broken invariant or "")."""
    rows = []
    jobs = [(name, lambda n=name, t=t: check_planar(programs, planar[n], t, work)) for name, t in PLANAR]
    jobs += [(name, lambda n=name, s=s, a=a: check_spatial(programs, spatial[n], s, a, work)) for name, s, a in SPATIAL]
    for name, job in jobs:
        try:
            rows.append((name, job(), ""))
        except Broken as broken:
            rows.append((name, "", str(broken)))
        print("ok  " if not rows[-1][2] else "FAIL", name, rows[-1][1] or rows[-1][2], flush=True)
    return rows
