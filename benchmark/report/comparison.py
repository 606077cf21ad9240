# SPDX-License-Identifier: GPL-3.0-or-later
"""weft beside its peers on the same inputs and bounds: quality, size and time in tables, and medians of ratios."""

from . import peers_2d, peers_3d, process, tables


def rounds(seconds, quick):
    """How many more runs give a median."""
    return 0 if seconds > 5 or (quick and seconds > 0.5) else 2


def summary(rows, baseline, angle, kept):
    """Medians of ratios of `baseline` to every other mesher over the inputs where both have a mesh.

    :param kept: (result) -> whether it kept the bound on edges.
    """
    by_input = {}
    for r in rows:
        by_input.setdefault(r["input"], {})[r["mesher"]] = r
    names = list(dict.fromkeys(r["mesher"] for r in rows))
    result = []
    for name in names:
        if name == baseline:
            continue
        pairs = [(i[baseline], i[name]) for i in by_input.values()
                 if name in i and "failure" not in i[name] and "failure" not in i.get(baseline, {"failure": ""})]
        tried = [i[name] for i in by_input.values() if name in i]
        result.append({
            "peer": name, "inputs": len(pairs), "failures": sum("failure" in t for t in tried),
            "kept": sum(kept(p) for _, p in pairs),
            "vertices": process.median([w["vertices"] / p["vertices"] for w, p in pairs]),
            "angle": process.median([w[angle] - p[angle] for w, p in pairs]),
            "seconds": process.median([w["seconds"] / max(p["seconds"], 1e-3) for w, p in pairs])})
    return result


def summary_table(lines):
    return tables.table(
        ["peer", "inputs", "failed", "kept the longest edge", "vertices, weft / peer", "smallest angle, weft − peer",
         "user s, weft / peer"],
        [[s["peer"], s["inputs"], s["failures"], f"{s['kept']} of {s['inputs']}", tables.number(s["vertices"], 2),
          tables.number(s["angle"], 1) + "°", tables.number(s["seconds"], 2)] for s in lines])


def each(meshers, inputs, mesh_once, repeat_times, quick, say):
    """Every mesher on every input; then, by turns, again for medians. Yields all rows so far after each input."""
    rows = []
    for given in inputs:
        results = []
        for mesher in meshers:
            result = mesh_once(mesher, given)
            result.update(input=given.name, mesher=mesher.name)
            results.append((mesher, result, [result.get("seconds")]))
            say(f"{given.name}, {mesher.name}: " + result.get("failure", f"{result.get('seconds', 0):.2f} s"))
        for _ in range(2):
            for mesher, result, times in results:
                if "failure" not in result and len(times) <= rounds(result["seconds"], quick):
                    times += repeat_times(mesher, given, result)
        for _, result, times in results:
            if "failure" not in result:
                result["seconds"] = process.median(times)
                result["runs"] = len(times)
            rows.append(result)
        yield rows


# ---- In the plane


def planar(programs, inputs, triangles, work, limit, quick, say):
    """Yields what there is after each input, as data and text."""
    meshers, missing = peers_2d.meshers(programs)
    out = work / "planar.mesh"

    def size(given):
        return given.size_for_one / (triangles / 1.5) ** 0.5

    def measure_of(given):
        def measure(mesh):
            outcome = process.run([programs.measure_mesh_2, "--size", size(given), given.poly, mesh], 120)
            if outcome.failure:
                raise ValueError(outcome.failure)
            return outcome.json()[0]
        return measure

    for rows in each(meshers, inputs,
                     lambda m, i: peers_2d.mesh_once(m, i, size(i), out, limit, measure_of(i)),
                     lambda m, i, r: peers_2d.repeat_times(m, i, r, out, limit, 1), quick, say):
        lines = summary(rows, "weft", "smallest_angle",
                        lambda r: max(r["longest_ratio"], r["longest_edge_ratio"]) <= 1 + 1e-9)
        text = summary_table(lines) + tables.table(
            ["input", "mesher", "Steiner points", "triangles / m_Δ", "angles", "longest edge / size", "Delaunay", "user s",
             "peak MB", "note"],
            [planar_row(r) for r in rows])
        yield {"rows": rows, "summary": lines, "missing": missing, "triangles_asked": triangles}, text


def planar_row(r):
    if "failure" in r:
        return [r["input"], r["mesher"], "", "", "", "", "", "", "", r["failure"]]
    notes = []
    if r["tries"] > 1:
        notes.append(f"size lowered, {r['tries']} tries")
    if "lower_failed" in r:
        notes.append("lower still: " + r["lower_failed"])
    if not (r["same_area"] and r["same_constraints"]):
        notes.append("**another domain**")
    if r["inverted"]:
        notes.append(f"**{r['inverted']:.0f} triangles turned over**")
    if r["stopped_early"]:
        notes.append("stopped early")
    return [r["input"], r["mesher"], tables.count(r["steiner"]), tables.number(r["relative_count"], 3),
            f"{r['smallest_angle']:.1f}–{r['largest_angle']:.1f}",
            tables.number(max(r["longest_ratio"], r["longest_edge_ratio"]), 3),
            "yes" if r["non_delaunay"] == 0 else f"no ({r['non_delaunay']:.0f})", tables.seconds(r["seconds"]),
            tables.number(r["memory"] / 1e6, 0), "; ".join(notes)]


# ---- In space


def measure_3(programs, surface):
    def measure(mesh):
        outcome = process.run([programs.measure_mesh_3, surface, mesh], 300)
        if outcome.failure:
            raise ValueError(outcome.failure)
        return outcome.json()[0]
    return measure


def spatial(programs, inputs, work, limit, seconds, quick, say):
    """Each input has `bounds`. Yields what there is after each of them, as data and text."""
    meshers, missing = peers_3d.meshers(programs, seconds)
    out = work / "spatial"
    for rows in each(meshers, inputs,
                     lambda m, i: peers_3d.mesh_once(m, i, i.bounds, out, limit, measure_3(programs, i.off)),
                     lambda m, i, r: peers_3d.repeat_times(m, i, i.bounds, r, out, limit, 1), quick, say):
        yield spatial_report(rows, inputs, missing)


def spatial_report(rows, inputs, missing):
    bounds = {i.name: i.bounds for i in inputs}
    lines = summary(rows, "weft", "smallest_dihedral", lambda r: r["longest_ratio"] <= 1 + 1e-9)
    text = summary_table(lines) + tables.table(
        ["input", "mesher", "vertices", "cells", "dihedral angles", "cells below 5° / 10° / 15°", "longest edge / l",
         "H / ε", "cell shape", "Delaunay", "user s", "peak MB", "note"],
        [spatial_row(r, bounds[r["input"]]) for r in rows])
    return {"rows": rows, "summary": lines, "missing": missing}, text


def spatial_row(r, bounds):
    if "failure" in r:
        return [r["input"], r["mesher"], *[""] * 10, r["failure"]]
    notes = []
    if r["tries"] > 1:
        notes.append(f"size lowered to {r['size_given']:.4f}, {r['tries']} tries")
    if "lower_failed" in r:
        notes.append("lower still: " + r["lower_failed"])
    if not r["oriented"]:
        notes.append("**cells turned over or flat**")
    if not r["manifold"]:
        notes.append("boundary isn't a manifold")
    if abs(r["volume"] / r["volume_enclosed"] - 1) > 0.05:
        notes.append(f"volume {100 * r['volume'] / r['volume_enclosed']:.0f} % of the input's")
    if r["stopped_early"]:
        notes.append("stopped by its limit")
    distance = (tables.number(r["hausdorff"] / bounds.approximation, 2) if bounds.approximation > 0 else
                tables.number(r["hausdorff"] / bounds.size, 3) + " l")
    return [r["input"], r["mesher"], tables.count(r["vertices"]), tables.count(r["cells"]),
            f"{r['smallest_dihedral']:.1f}–{r['largest_dihedral']:.1f}",
            " / ".join(tables.count(r[f"cells_below_{d}"]) for d in (5, 10, 15)), tables.number(r["longest_ratio"], 2),
            distance, tables.number(r["cell_shape"], 2), "yes" if r["delaunay"] else "no", tables.seconds(r["seconds"]),
            tables.number(r["memory"] / 1e6, 0), "; ".join(notes)]


def boundary(programs, inputs, Given, work, limit, quick, say):
    """The inside of the boundary of weft's mesh by the others, as in fig. 3.17 of the thesis. Yields what there is after
    each input, as data and text."""
    meshers, missing = peers_3d.meshers(programs, 0, boundary=True)
    rows = []
    for given in inputs:
        mesh = work / f"{given.name}_weft.mesh"
        off, stl = work / f"{given.name}_boundary.off", work / f"{given.name}_boundary.stl"
        outcome = process.run(peers_3d.weft_command(programs, given, given.bounds, mesh, "--output", off, "--output", stl),
                              limit, (0, 2))
        measure = measure_3(programs, given.off)
        try:
            own = {"failure": outcome.failure} if outcome.failure else measure(mesh)
        except ValueError as error:
            own = {"failure": str(error)}
        if "failure" not in own:
            own.update(seconds=outcome.seconds, memory=outcome.memory, size_given=given.bounds.size, tries=1,
                       longest_ratio=own["longest_edge"] / given.bounds.size, stopped_early=outcome.status == 2)
        rows.append({**own, "input": given.name, "mesher": "weft"})
        if "failure" in own:
            yield spatial_report(rows, inputs, missing)
            continue
        inside = Given(name=given.name, off=off, stl=stl, sharp_angle=0, bounds=given.bounds)
        for found in each(meshers, [inside],
                          lambda m, i: peers_3d.mesh_once(m, i, i.bounds, work / "inside", limit, measure),
                          lambda m, i, r: peers_3d.repeat_times(m, i, i.bounds, r, work / "inside", limit, 1), quick, say):
            rows += found
        yield spatial_report(rows, inputs, missing)
