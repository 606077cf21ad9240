# SPDX-License-Identifier: GPL-3.0-or-later
"""How time and memory grow with the mesh, and what a second thread does."""

import json

from . import plots, process, tables


def exponent(points):
    """p of time ~ size^p, from the first to the last point."""
    import math
    (n0, t0), (n1, t1) = points[0], points[-1]
    return math.log(t1 / t0) / math.log(n1 / n0) if n1 > n0 and t0 > 0 and t1 > 0 else float("nan")


def growth(ways, steps, limit, say):
    """:param ways: {name: step -> (command, statuses, outcome -> number of vertices)}. A way that failed is left out
    from then on."""
    rows, given_up = [], set()
    for step in steps:
        for name, way in ways.items():
            if name in given_up:
                continue
            command, statuses, vertices = way(step)
            outcome = process.run(command, limit, statuses)
            row = {"way": name, "step": step, "seconds": outcome.seconds, "wall": outcome.wall, "memory": outcome.memory}
            if outcome.failure:
                given_up.add(name)
                row["failure"] = outcome.failure
            else:
                row["vertices"] = vertices(outcome)
            rows.append(row)
            say(f"{name}, {step:g}: " + row.get("failure", f"{outcome.seconds:.1f} s"))
    return rows


def growth_table(rows):
    lines = [[r["way"], tables.number(r["step"], 4) if r["step"] < 1 else tables.count(r["step"])]
             + ([r["failure"]] if "failure" in r else
                [tables.count(r["vertices"]), tables.seconds(r["seconds"]),
                 tables.number(1e6 * r["seconds"] / r["vertices"], 1), tables.number(r["memory"] / 1e6, 0),
                 tables.number(r["memory"] / r["vertices"], 0)]) for r in rows]
    text = tables.table(["way", "asked", "vertices", "user s", "µs a vertex", "peak MB", "bytes a vertex"], lines)
    found = series(rows, "seconds")
    return text + "\nTime grows as vertices to the power: " + ", ".join(
        f"{name} {exponent(points):.2f}" for name, points in found.items() if len(points) > 1) + ".\n"


def series(rows, key, factor=1.0):
    result = {}
    for r in rows:
        if "failure" not in r:
            result.setdefault(r["way"], []).append((r["vertices"], factor * r[key]))
    return result


def weft_way(command, report):
    return command, (0, 2), lambda _: json.loads(report.read_text())["vertices"]


def cgal_way(command):
    return command, (0,), lambda outcome: outcome.json()["vertices"]


def planar(programs, square, steps, work, limit, say):
    """:param steps: triangles asked for."""
    report = work / "growth.json"

    def size(n):
        return square.size_for_one / (n / 1.5) ** 0.5
    return growth({
        "weft": lambda n: weft_way([programs.mesh_2, square.poly, "--size", size(n), "--report", report, "--threads", 1,
                                    "--quiet"], report),
        "CGAL refine": lambda n: cgal_way([programs.cgal_mesh_2, "--size", size(n), square.poly])}, steps, limit, say)


def spatial(programs, ball, steps, most_optimised, work, limit, say):
    """:param steps: vertices asked for. :param most_optimised: of them, for weft's default run."""
    report = work / "growth.json"

    def size(n):
        return 0.05 * (14500 / n) ** (1 / 3)  # CGAL makes about 14500 vertices at 0.05

    def weft(n, *more):
        return weft_way([programs.mesh_3, ball.off, "--size", size(n), "--approximation", 0, "--sharp-angle", 0,
                         "--report", report, "--threads", 1, "--quiet", *more], report)
    rows = growth({"weft refine": lambda n: weft(n, "--no-optimise", "--no-perturb"),
                   "CGAL refine": lambda n: cgal_way([programs.cgal_mesh_3, "--size", size(n), ball.off])},
                  steps, limit, say)
    return rows + growth({"weft": weft}, [n for n in steps if n <= most_optimised], limit, say)


def plot(rows, work, name, title):
    made = plots.curves(work / f"{name}_time.svg", title + ": time", "vertices", "user seconds", series(rows, "seconds"))
    plots.curves(work / f"{name}_memory.svg", title + ": peak memory", "vertices", "MB", series(rows, "memory", 1e-6))
    return made


def threads(jobs, work, limit, say):
    """:param jobs: list of (name, command without threads and output, suffix)."""
    rows = []
    for name, command, suffix in jobs:
        row, meshes = {"input": name}, []
        for n in (1, 2):
            mesh = work / f"threads_{n}{suffix}"
            mesh.unlink(missing_ok=True)
            outcome = process.run([*command, "--threads", n, "--output", mesh, "--quiet"], limit, (0, 2))
            if outcome.failure:
                row["failure"] = outcome.failure
                break
            row[f"wall_{n}"], row[f"user_{n}"] = outcome.wall, outcome.seconds
            meshes.append(mesh.read_bytes())
        if "failure" not in row:
            row["same"] = meshes[0] == meshes[1]
        rows.append(row)
        say(f"threads, {name}: {row}")
    return rows, tables.table(
        ["input", "wall s, 1 thread", "2 threads", "speed-up", "user s, 1 thread", "2 threads", "same mesh"],
        [[r["input"], r["failure"]] if "failure" in r else
         [r["input"], tables.seconds(r["wall_1"]), tables.seconds(r["wall_2"]),
          tables.number(r["wall_1"] / r["wall_2"], 2), tables.seconds(r["user_1"]), tables.seconds(r["user_2"]),
          tables.yes(r["same"])] for r in rows])
