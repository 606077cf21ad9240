# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures and tables of Tournois 2009 beside what weft makes, each with "met" or "missed by". Its models aren't to
be had; what stands in for each is said in its row."""

import json
import math

from . import peers_2d, peers_3d, plots, process, tables
from .comparison import measure_3

HEAD = ["thesis", "what", "thesis' input", "here", "figure", "thesis", "measured", "verdict"]


class Rows:
    def __init__(self):
        self.rows = []

    def add(self, figure, what, theirs, ours, name, asked, measured, larger_is_better, decimals=1, unit=""):
        """A figure that is met or missed. `asked` None: only shown."""
        verdict = "" if asked is None else tables.by(measured, asked, larger_is_better, decimals, unit)
        self.rows.append({"figure": figure, "what": what, "thesis_input": theirs, "input": ours, "name": name,
                          "thesis": asked, "measured": measured, "verdict": verdict.replace("*", ""),
                          "cells": [figure, what, theirs, ours, name,
                                    "" if asked is None else tables.number(asked, decimals) + unit,
                                    tables.number(measured, decimals) + unit, verdict]})

    def fail(self, figure, what, theirs, ours, why):
        self.rows.append({"figure": figure, "what": what, "thesis_input": theirs, "input": ours, "failure": why,
                          "cells": [figure, what, theirs, ours, "", "", "", f"**{why}**"]})

    def table(self):
        return tables.table(HEAD, [r["cells"] for r in self.rows])

    def json(self):
        return [{k: v for k, v in r.items() if k != "cells"} for r in self.rows]


class Bench:
    """Runs of one size: programs, inputs, where files go, seconds a run may take."""

    def __init__(self, programs, planar, spatial, work, limit, seconds, say):
        self.programs, self.planar, self.spatial, self.work = programs, planar, spatial, work
        self.limit, self.seconds, self.say = limit, seconds, say

    def mesh_2(self, name, *sizes):
        """weft's and CGAL's meshes of an input, measured; either may be {"failure": why}."""
        given, results = self.planar[name], []
        mesh = self.work / "thesis.mesh"
        for command, statuses in (([self.programs.mesh_2, given.poly, "--output", mesh, "--quiet"], (0, 2)),
                                  ([self.programs.cgal_mesh_2, "--output", mesh, given.poly], (0,))):
            mesh.unlink(missing_ok=True)
            outcome = process.run([*command, *sizes], self.limit, statuses)
            if not outcome.failure:
                measured = process.run([self.programs.measure_mesh_2, *sizes, given.poly, mesh], self.limit)
                outcome.failure = measured.failure
            results.append({"failure": outcome.failure} if outcome.failure else
                           {**measured.json()[0], "seconds": outcome.seconds, "complete": outcome.status == 0})
        self.say(f"thesis, {name} {sizes}")
        return results

    def mesh_3(self, name, bounds, *more, output=()):
        given, mesh, report = self.spatial[name], self.work / "thesis_3.mesh", self.work / "thesis_3.json"
        mesh.unlink(missing_ok=True)
        outputs = [w for file in output for w in ("--output", file)]
        outcome = process.run(peers_3d.weft_command(self.programs, given, bounds, mesh, "--report", report, *outputs,
                                                    *more), self.limit, (0, 2))
        self.say(f"thesis, {name} {more}: {outcome.failure or f'{outcome.seconds:.1f} s'}")
        if outcome.failure:
            return {"failure": outcome.failure}
        try:
            result = measure_3(self.programs, given.off)(mesh)
        except ValueError as error:
            return {"failure": str(error)}
        result.update(seconds=outcome.seconds, complete=json.loads(report.read_text())["ok"])
        return result


# ---- Chapter 2

def radius_edge(angle):
    """Largest circumradius / shortest edge of triangles with a smallest angle."""
    return 1 / (2 * math.sin(math.radians(angle)))


# Of fig. 2.9 the thesis gives 5.73; the input's own angle of 5 degrees makes it 5.737.
UNIFORM = (  # figure, input, size in a domain of area 1, fewer Steiner points in per cent, angles, largest ratio
    ("2.6", "square", 0.05, 20, (35, 96), 0.88), ("2.7", "comb", 0.02, 22, (33, 99), 0.85),
    ("2.8", "nested_holes", 0.02, 23, (29, 103), 1.00), ("2.9", "star", 0.02, 26, (5, 128), radius_edge(5)),
    ("2.10", "parallel", 0.01, 25, None, None))
GRADED = (("2.12", "smooth_curve", 0.45, 1440, 256), ("2.13", "coastline", 1, 9691, 3632),
          ("2.14", "airfoil", 0.6, 981, 205))


def unit_size(given, mu):
    return mu * given.size_for_one / math.sqrt(4 / math.sqrt(3))


def chapter_2(bench, rows):
    for figure, name, mu, fewer, angles, ratio in UNIFORM:
        what, theirs, ours = f"uniform, μ = {mu}", {"star": "star of 17 spikes, 5° to 37°"}.get(name, "not named"), name
        weft, cgal = bench.mesh_2(name, "--size", unit_size(bench.planar[name], mu))
        if "failure" in weft or "failure" in cgal:
            rows.fail(figure, what, theirs, ours, f"weft: {weft.get('failure', 'meshed')}; CGAL: {cgal.get('failure', 'meshed')}")
            continue
        rows.add(figure, what, theirs, ours, "fewer Steiner points than Delaunay refinement", fewer,
                 100 * (1 - weft["steiner"] / cgal["steiner"]), True, 1, " %")
        if angles:
            rows.add(figure, what, theirs, ours, "smallest angle", angles[0], weft["smallest_angle"], True, 1, "°")
            rows.add(figure, what, theirs, ours, "largest angle", angles[1], weft["largest_angle"], False, 1, "°")
            rows.add(figure, what, theirs, ours, "circumradius / shortest edge", ratio,
                     radius_edge(weft["smallest_angle"] + 1e-6), False, 2)
    what, theirs, ours = "uniform, μ = 0.01", "smooth, 256 vertices; 9761 vertices", "smooth_curve, 256 vertices"
    weft, cgal = bench.mesh_2("smooth_curve", "--size", unit_size(bench.planar["smooth_curve"], 0.01))
    if "failure" in weft or "failure" in cgal:
        rows.fail("2.11", what, theirs, ours, weft.get("failure", cgal.get("failure", "")))
    else:
        rows.add("2.11", what, theirs, ours, "vertices (its area isn't known)", None, weft["vertices"], False, 0)
        rows.add("2.11", what, theirs, ours, "fewer Steiner points than Delaunay refinement", None,
                 100 * (1 - weft["steiner"] / cgal["steiner"]), True, 1, " %")
    for figure, name, k, vertices, given in GRADED:
        what, theirs = f"lfs, k = {k}", f"{given} vertices"
        weft, cgal = bench.mesh_2(name, "--lfs", k)
        ours = f"{name}, {bench.planar[name].vertices:.0f} vertices"
        if "failure" in weft:
            rows.fail(figure, what, theirs, ours, weft["failure"])
            continue
        rows.add(figure, what, theirs, ours, "vertices per vertex of the input", vertices / given,
                 weft["vertices"] / weft["input_vertices"], False, 2)
        rows.add(figure, what, theirs, ours, "largest edge / size", 1,
                 max(weft["longest_ratio"], weft["longest_edge_ratio"]), False, 4)
        if "failure" not in cgal:
            rows.add(figure, what, theirs, ours, "fewer Steiner points than Delaunay refinement", None,
                     100 * (1 - weft["steiner"] / cgal["steiner"]), True, 1, " %")


# ---- Chapter 3


def models_of_chapter_3(bench, rows, large):
    b = peers_3d.Bounds(0.1, 0.001)
    uniform = 0.0125 if large else 0.04
    for name, what, bounds, vertices in (
            ("armadillo", f"uniform, l = {uniform}", peers_3d.Bounds(uniform, 0.001), 1e6),
            ("armadillo", "ε and shape alone", peers_3d.Bounds(1, 0.0005 if large else 0.001), 250e3)):
        theirs, ours = f"David, 800k triangles; {vertices / 1e3:.0f}k vertices", "armadillo, 53k triangles"
        if name not in bench.spatial:
            rows.fail("3.1", what, theirs, ours, "not measured: no such model here")
            continue
        m = bench.mesh_3(name, bounds)
        if "failure" in m:
            rows.fail("3.1", what, theirs, ours, m["failure"])
            continue
        rows.add("3.1", what, theirs, ours, "vertices (1000)", None, m["vertices"] / 1e3, True)
        rows.add("3.1", what, theirs, ours, "all criteria met", 1, float(m["complete"]), True, 0)
        rows.add("3.1", what, theirs, ours, "smallest dihedral angle", None, m["smallest_dihedral"], True, 1, "°")
    for figure, what, theirs, name, fewer, angle in (
            ("3.2", "shape and ε: interleaved against refinement", "body with an armhole; 5,499 → 3,701 vertices", "homer",
             32.7, 15), ("3.16", "l = 0.1, ε = 0.001", "turbine; 14k vertices, 51k cells", "turbine", 13, 15)):
        if name not in bench.spatial:
            rows.fail(figure, what, theirs, name, "not measured: no such model here")
            continue
        refined = bench.mesh_3(name, b, "--no-optimise", "--no-perturb")
        whole = bench.mesh_3(name, b)
        if "failure" in refined or "failure" in whole:
            rows.fail(figure, what, theirs, name, refined.get("failure") or whole.get("failure"))
            continue
        rows.add(figure, what, theirs, name, f"fewer vertices than refinement ({refined['vertices']:.0f} → "
                 f"{whole['vertices']:.0f})", fewer, 100 * (1 - whole["vertices"] / refined["vertices"]), True, 1, " %")
        rows.add(figure, what, theirs, name, "cells below 15° after it (refined: "
                 f"{refined['cells_below_15']:.0f})", 0, whole["cells_below_15"], False, 0)
        rows.add(figure, what, theirs, name, "smallest dihedral angle", angle, whole["smallest_dihedral"], True, 1, "°")
    cover(bench, rows)


def cover(bench, rows):
    """Fig. 3.17."""
    figure, what, theirs, name = "3.17", "l = 0.1, ε = 0.001, σ = 1.5, topology", "cover rear", "joint"
    if name not in bench.spatial:
        return rows.fail(figure, what, theirs, name, "not measured: no such model here")
    given, b = bench.spatial[name], peers_3d.Bounds(0.1, 0.001, 1.5)
    off, stl = bench.work / "cover.off", bench.work / "cover.stl"
    weft = bench.mesh_3(name, b, output=(off, stl))
    if "failure" in weft:
        return rows.fail(figure, what, theirs, name, weft["failure"])
    rows.add(figure, what, theirs, name, "all criteria met", 1, float(weft["complete"]), True, 0)
    rows.add(figure, what, theirs, name, "smallest dihedral angle", None, weft["smallest_dihedral"], True, 1, "°")
    meshers = {m.name: m for m in peers_3d.meshers(bench.programs, bench.seconds)[0]}
    inside = {m.name: m for m in peers_3d.meshers(bench.programs, bench.seconds, boundary=True)[0]}
    boundary = type(given)(name=name, off=off, stl=stl, sharp_angle=0)
    for title, mesher, source, share in (
            ("vertices / CGAL's refinement (thesis: DelPSC)", meshers.get("CGAL refine"), given, 4050 / 15157),
            ("vertices / TetGen's, on our boundary", inside.get("TetGen"), boundary, 4050 / 4189),
            ("vertices / Gmsh HXT's, on our boundary (thesis: GHS3D)", inside.get("Gmsh HXT, optimised"), boundary,
             4050 / 6641)):
        if mesher is None:
            rows.fail(figure, what, theirs, name, title + ": not installed")
            continue
        m = peers_3d.mesh_once(mesher, source, b, bench.work / "cover_peer", bench.limit,
                               measure_3(bench.programs, given.off))
        if "failure" in m:
            rows.fail(figure, what, theirs, name, f"{title}: {m['failure']}")
            continue
        rows.add(figure, what, theirs, name, f"{title}, {m['vertices']:.0f}, from {m['smallest_dihedral']:.1f}°", share,
                 weft["vertices"] / m["vertices"], False, 2)


def smoothers(rows, data):
    """Fig. 3.6, from the program `optimisation`."""
    for r in data:
        what, theirs, name = "cells below 10° after 100 sweeps / before", "model not named; 136 → 3", r["input"]
        for smoother, title, asked in (("nodt", "NODT", 3 / 136), ("lloyd", "Lloyd", 55 / 136)):
            rows.add("3.6", what, theirs, name, f"{title} ({r['refined']:.0f} → {r[smoother]['free_100']:.0f}), criteria "
                     "not kept", asked, r[smoother]["free_100"] / max(1, r["refined"]), False, 3)


def perturbation(rows, data):
    """Table 3.1, fig. 3.10 and 3.11."""
    bounds_3_10 = {"refined": (17, 611), "refined, Lloyd": (21, 76), "refined, ODT": (25, 11)}
    for r in data:
        theirs = "Dinosaur" if r["input"] == "dino" else "Bimba"
        figure = "3.10" if r["input"] == "dino" else "3.11"
        if "failed" in r:
            rows.fail("table 3.1", r["preparation"], theirs, r["input"], r["failed"])
            continue
        exuded = f" (CGAL's exudation {r['exuded']:.1f}°, the thesis' {r['thesis_exuded']:.1f}°)"
        for key, title in (("combined", "combined perturbation" + exuded), ("random", "random perturbation")):
            rows.add("table 3.1", f"smallest dihedral angle, {r['preparation']}", theirs, r["input"], title,
                     r[f"thesis_{key}"], r[key], True, 1, "°")
        combined, at_random = r["combined_seconds"], r["random_seconds"]
        both = [b for b in combined if b in at_random]
        if both:
            last = max(both, key=float)
            rows.add(figure, f"time to a bound, {r['preparation']}", theirs, r["input"],
                     f"random / combined at {last}°, the largest both reach", 1,
                     at_random[last] / max(combined[last], 1e-3), True, 2)
        if figure == "3.10":
            bound, theirs_seconds = bounds_3_10[r["preparation"]]
            note = f" (after {combined[str(bound)]:.1f} s; thesis {theirs_seconds} s)" if str(bound) in combined else ""
            rows.add(figure, f"bound reached, {r['preparation']}", theirs, r["input"], "combined perturbation" + note,
                     bound, r["combined"], True, 1, "°")


def plot_perturbation(data, work):
    for model in dict.fromkeys(r["input"] for r in data):
        series = {}
        for r in data:
            if r["input"] == model and "failed" not in r:
                for key in ("combined", "random"):
                    series[f"{r['preparation']}: {key}"] = [(float(b), s) for b, s in r[f"{key}_seconds"].items() if s > 0]
        plots.curves(work / f"perturbation_{model}.svg", f"Perturbation of {model} (fig. 3.10, 3.11)",
                     "bound on dihedral angles, degrees", "user seconds", series, log_x=False)


# ---- Chapter 4


def chapter_4(bench, rows):
    for name, what, sizes, theirs in (
            ("star", "uniform, μ = 0.03", ("--size", unit_size(bench.planar["star"], 0.03)), "star, 5°; 855 vertices"),
            ("star", "lfs, k = 0.1", ("--lfs", 0.1), "star, 5°; 472 vertices"),
            ("mushroom", "uniform, μ = 0.02", ("--size", unit_size(bench.planar["mushroom"], 0.02)),
             "mushroom, 2.7°; 2392 vertices"),
            ("mushroom", "lfs, k = 0.7", ("--lfs", 0.7), "mushroom, 2.7°; 1737 vertices")):
        weft, _ = bench.mesh_2(name, *sizes)
        if "failure" in weft:
            rows.fail("4.1", what, theirs, name, weft["failure"])
            continue
        rows.add("4.1", what, theirs, name, f"ends with all criteria met ({weft['vertices']:.0f} vertices)", 1,
                 float(weft["complete"]), True, 0)
        rows.add("4.1", what, theirs, name, "smallest angle: the input's", weft["smallest_input_angle"],
                 weft["smallest_angle"] + 1e-6, True, 2, "°")
    for degrees, theirs in ((70, "Point, 70°; 9,374 vertices"), (52, "Sculpt, 52°; 11,897 vertices"),
                            (47, "Sword, 47°; 3,574 vertices"), (5, "Blade, 5°; doesn't end")):
        name, what = f"wedge_{degrees}", "l = 0.1, ε = 0.001"
        m = bench.mesh_3(name, peers_3d.Bounds(0.1, 0.001))
        if "failure" in m:
            rows.fail("4.2", what, theirs, name, m["failure"])
            continue
        rows.add("4.2", what, theirs, name, f"ends with a mesh ({m['vertices']:.0f} vertices, from "
                 f"{m['smallest_dihedral']:.1f}°)", 1, float(m["oriented"] and m["manifold"]), True, 0)
        rows.add("4.2", what, theirs, name, "all criteria met", 1, float(m["complete"]), True, 0)
