# SPDX-License-Identifier: GPL-3.0-or-later
"""Given solids with small dihedral angles: meshed as they are, turned at random and with other seeds, cells that the
angles force apart from the others; and beside what peers make with edges no longer."""

import collections
import math
import pathlib
import sys
import types

from . import peers_3d, process

TOOLS = ("benchmark/measure_angles", "benchmark/judge_domain")
TOOLS_FOR_PEERS = ("benchmark/measure_mesh_3", "benchmark/cgal_mesh_3")

Given = collections.namedtuple("Given", "name off size")


def read_solid(text, halve):
    """Of FILE=SIZE the solid at that size and, if asked, at half of it."""
    file, equals, size = text.rpartition("=")
    if not equals or not float(size) > 0:
        raise ValueError(f"'{text}' isn't FILE=SIZE")
    off = pathlib.Path(file).resolve(strict=True)
    return [Given(off.stem, off, float(size) / part) for part in ((1, 2) if halve else (1,))]


def runs_of(given, request, is_whole):
    """(name, options of measure_angles)"""
    yield "", []
    if is_whole:
        yield from ((f"turned {k}", ["--turn", k]) for k in range(1, request.turns + 1))
        yield from ((f"seed {k}", ["--seed", k]) for k in range(1, request.seeds + 1))


def mesh(given, options, request, build, work):
    """Figures of measure_angles; with "faults", what is wrong, if anything."""
    output, turned = work / "mesh.mesh", work / "surface.off"
    outcome = process.run([build / TOOLS[0], given.off, given.size, "--approximation", request.approximation,
                           "--time-limit", request.time_limit, "--output", output, "--turned", turned, *options],
                          request.time_limit + request.grace)
    if outcome.failure:
        return {"faults": outcome.failure}
    figures, faults = outcome.json(), []
    if not figures["ok"]:
        faults.append(f"{figures['stop_reason']}, {figures['bad']:g} bad")
    if not figures["manifold"]:
        faults.append("not manifold")
    if figures["creases_given_up"]:
        faults.append(f"{figures['creases_given_up']:g} creases given up")
    judged = process.run([build / TOOLS[1], turned, output, request.approximation], request.grace)
    if judged.failure:
        faults.append(judged.failure)
    elif not judged.json()["right"]:
        faults.append(judged.json()["why"])
    return {**figures, "faults": "; ".join(faults)}


def span(values, digits=0):
    low, high = min(values), max(values)
    texts = [f"{x:.{digits}f}" for x in (low, high)]
    return texts[0] if texts[0] == texts[1] else " to ".join(texts)


def row(given, results):
    done = [r for r in results if "vertices" in r]
    wrong = [r for r in results if r["faults"]]
    cells = [given.name, f"{given.size:g}", f"{len(results) - len(wrong)} of {len(results)}"]
    if done:
        unforced, part = min(r["unforced"] for r in done), min(r["part"] for r in done)
        cells += [span([r["vertices"] for r in done]), f"{unforced:.1f}°" if unforced < 180 else "none",
                  f"{part:.2f}" if part < 180 else "none", f"{max(r['largest'] for r in done):.1f}°",
                  f"{max(r['seconds'] for r in done):.1f}"]
    return f"| {' | '.join(cells)} |"


def write_stl(off, stl):
    """Facets of an OFF file as fans."""
    words = iter(off.read_text().split())
    next(words)
    points, facets, _ = (int(next(words)) for _ in range(3))
    at = [[next(words) for _ in range(3)] for _ in range(points)]
    lines = ["solid s"]
    for _ in range(facets):
        corners = [int(next(words)) for _ in range(int(next(words)))]
        for i in range(2, len(corners)):
            lines += ["facet normal 0 0 0", "outer loop",
                      *("vertex " + " ".join(at[c]) for c in (corners[0], corners[i - 1], corners[i])), "endloop",
                      "endfacet"]
    stl.write_text("\n".join([*lines, "endsolid s", ""]))


def diagonal(off):
    words = off.read_text().split()
    numbers = [float(w) for w in words[4:4 + 3 * int(words[1])]]
    return math.dist(*([f(numbers[k::3]) for k in range(3)] for f in (min, max)))


def peers(given, request, build, work):
    """(mesher, figures or failure) of each peer, with its size lowered until no edge is longer than asked."""
    stl = work / "surface.stl"
    write_stl(given.off, stl)
    source = types.SimpleNamespace(off=given.off, stl=stl, sharp_angle=60)
    bounds = peers_3d.Bounds(given.size, diagonal(given.off) * request.approximation / 100)
    programs = types.SimpleNamespace(mesh_3=None, cgal_mesh_3=build / TOOLS_FOR_PEERS[1])
    meshers, missing = peers_3d.meshers(programs, request.time_limit)
    for mesher in meshers:
        if mesher.name.startswith("weft") or "ODT" in mesher.name or "Lloyd" in mesher.name:
            continue
        mesher.bounds_edges = False  # CGAL bounds circumradii
        found = peers_3d.mesh_once(mesher, source, bounds, work / "peer", request.time_limit,
                                   lambda m: process.run([build / TOOLS_FOR_PEERS[0], given.off, m], request.grace))
        yield mesher.name, {**found, "approximation": bounds.approximation}
    for name, why in missing:
        yield name, {"failure": why}


def why_not_valid(figures):
    """A valid mesh has a closed manifold as its boundary, is near the surface and has no longer edges."""
    if "failure" in figures:
        return figures["failure"]
    if not figures["manifold"] or not figures["oriented"]:
        return "not manifold"
    if figures["ratio"] > 1 + 1e-9:
        return f"edges of {figures['ratio']:.2f}"
    if figures["hausdorff"] > 2 * figures["approximation"]:
        return f"distance {figures['hausdorff'] / figures['approximation']:.1f} ε"
    return ""


def peer_row(given, own, found):
    """The best valid peer has the fewest vertices."""
    valid = sorted((f["vertices"], name) for name, f in found if not why_not_valid(f))
    cells = [given.name, f"{given.size:g}", f"{own:g}"]
    cells += [f"{valid[0][0]:g} ({valid[0][1]})", f"{own / valid[0][0]:.2f}"] if valid else ["none", ""]
    others = [f"{name}: {why_not_valid(f) or format(f['vertices'], 'g')}" for name, f in found]
    return f"| {' | '.join([*cells, '; '.join(others)])} |"


def report(request, build, work):
    """(Markdown, whether all is right)"""
    lines = ["| solid | size | right | vertices | smallest angle, not forced | forced, in parts of the input's | largest "
             "angle | user s |", "| --- " * 8 + "|"]
    against = ["", "| solid | size | weft's vertices | the best valid peer's | ratio | all peers |", "| --- " * 6 + "|"]
    notes, all_right = [], True
    for text in request.solid:
        for i, given in enumerate(read_solid(text, request.halve)):
            results = []
            for name, options in runs_of(given, request, i == 0):
                results.append(mesh(given, options, request, build, work))
                if results[-1]["faults"]:
                    notes.append(f"- {given.name} {given.size:g} {name}: {results[-1]['faults']}")
            all_right = all_right and not any(r["faults"] for r in results)
            lines.append(row(given, results))
            print(lines[-1], file=sys.stderr, flush=True)
            if request.peers and "vertices" in results[0]:
                against.append(peer_row(given, results[0]["vertices"], list(peers(given, request, build, work))))
                print(against[-1], file=sys.stderr, flush=True)
    return "\n".join([*lines, *([""] if notes else []), *notes, *(against if request.peers else [])]) + "\n", all_right
