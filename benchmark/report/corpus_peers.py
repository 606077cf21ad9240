# SPDX-License-Identifier: GPL-3.0-or-later
"""What other ways make of a corpus: CGAL's alpha wrap meshed by weft, TetGen and Gmsh, beside weft itself. All are asked
for the same size; what they mesh is judged by judge_domain, against the surface as the file has it.

weft            mesh_3 FILE
alpha wrap      wrap_surface FILE, alpha 1 %, offset 0.1 % of the diagonal, then mesh_3
TetGen          -p -q2 -a V: V the volume of a regular tetrahedron of the size; facets stay as they are
Gmsh            Surface Loop, Volume, MeshSizeMax; facets stay as they are
"""

import json
import math
import shutil
import subprocess
import time

EPSILON = 0.001  # parts of the diagonal: mesh_3's default approximation
SIZE = 0.05      # and its default size


class Failed(Exception):
    """No mesh, and why."""


def diagonal(off):
    """Of a file that wrap_surface has written."""
    words = off.read_text().split()
    n = int(words[1])
    xyz = [tuple(map(float, words[4 + 3 * i:7 + 3 * i])) for i in range(n)]
    return math.dist(tuple(map(min, zip(*xyz))), tuple(map(max, zip(*xyz))))


def is_closed_and_oriented(off):
    """Whether each edge has one triangle on each side."""
    lines = off.read_text().split("\n")
    n, m = map(int, lines[1].split()[:2])
    sides = set()
    for line in [line for line in lines[2:] if line.strip()][n:n + m]:
        corners = line.split()[1:4]
        for i in range(3):
            side = (corners[i], corners[(i + 1) % 3])
            if side in sides:
                return False
            sides.add(side)
    return all((b, a) in sides for a, b in sides)


class Runner:
    """Runs the steps of one way within a common time limit."""

    def __init__(self, seconds):
        self.seconds, self.start = seconds, time.monotonic()

    def __call__(self, *command, statuses=(0,), folder=None):
        left = self.seconds - (time.monotonic() - self.start)
        try:
            run = subprocess.run([str(c) for c in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, timeout=max(left, 0.1), cwd=folder, errors="replace")
        except subprocess.TimeoutExpired:
            raise Failed("time limit")
        if run.returncode not in statuses:
            lines = [line for line in run.stdout.splitlines() if line.strip()]
            raise Failed("crashed" if run.returncode < 0 else (lines[-1].split(": ")[-1][:60] if lines else "failed"))
        return run.stdout


def by_weft(run, programs, file, work, limit):
    mesh = work / "weft.mesh"
    run(programs / "examples" / "mesh_3", file, "--quiet", "--threads", "1", "--time-limit", limit, "--output", mesh,
        statuses=(0, 2))
    return mesh


def by_wrap(run, programs, file, work, limit):
    run(programs / "benchmark" / "wrap_surface", file, work / "wrap.off")
    mesh = work / "wrap.mesh"
    run(programs / "examples" / "mesh_3", work / "wrap.off", "--quiet", "--threads", "1", "--time-limit", limit,
        "--output", mesh,
        statuses=(0, 2))
    return mesh


def by_tetgen(run, programs, file, work, limit):
    size = SIZE * diagonal(work / "copy.off")
    run("tetgen", f"-pq2a{size ** 3 / (6 * math.sqrt(2)):.12f}gQ", "copy.off", folder=work)
    mesh = work / "tetgen.mesh"
    lines = (work / "copy.1.mesh").read_text().split("\n")
    mesh.write_text("\n".join(line for line in lines if not line.startswith("#")))
    return mesh


def by_gmsh(run, programs, file, work, limit):
    geo = work / "copy.geo"
    geo.write_text('Merge "copy.stl";\nSurface Loop(1) = Surface{:};\nVolume(1) = {1};\n'
                   f"Mesh.MeshSizeMax = {SIZE * diagonal(work / 'copy.off')};\nMesh.SaveAll = 1;\n")
    run("gmsh", geo.name, "-3", "-v", "1", "-format", "mesh", "-o", "gmsh.mesh", folder=work)
    return work / "gmsh.mesh"


def ways():
    found = [("weft", by_weft), ("alpha wrap + weft", by_wrap)]
    return found + [(title, way) for title, program, way in (("TetGen", "tetgen", by_tetgen), ("Gmsh", "gmsh", by_gmsh))
                    if shutil.which(program)]


def judged(programs, file, mesh):
    """Figures of judge_domain. It takes volume and topology from the triangles as they are: where these aren't a closed
    and oriented surface, only the surface says whether the mesh is whole."""
    run = subprocess.run([str(programs / "benchmark" / "judge_domain"), str(file), str(mesh), str(100 * EPSILON)],
                         stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=300)
    if run.returncode != 0:
        raise Failed("an unreadable or empty mesh")
    return json.loads(run.stdout)


def compare(programs, files, limit, work, say):
    """One row for each file and way, as dictionaries."""
    rows = []
    for file in files:
        folder = work / f"peers{len(rows)}"
        folder.mkdir(parents=True)
        try:
            copying = Runner(limit)
            copying(programs / "benchmark" / "wrap_surface", file, folder / "copy.off", "--copy")
            copying(programs / "benchmark" / "wrap_surface", file, folder / "copy.stl", "--copy")
        except Failed as failure:
            say(f"{file.name}: {failure}")
            continue
        is_closed = is_closed_and_oriented(folder / "copy.off")
        for title, way in ways():
            row = {"file": file.name, "way": title, "why": ""}
            run = Runner(limit + 10)
            try:
                mesh = way(run, programs, file.resolve(), folder, limit)
                row["seconds"] = time.monotonic() - run.start
                figures = judged(programs, folder / "copy.off", mesh)
                row.update(figures, why="", fault=figures["why"])
                row["whole"] = figures["right"] or (not is_closed and figures["surface_holds"])
            except (Failed, subprocess.TimeoutExpired, ValueError) as failure:
                row["why"] = str(failure) or "failed"
                row.setdefault("seconds", time.monotonic() - run.start)
            rows.append(row)
            say(f"{file.name}: {title}: {row['why'] or ('whole' if row['whole'] else row['fault'])}")
        shutil.rmtree(folder)
    return rows


def distance(row):
    return row["surface_to_mesh"] / row["approximation"] if row["approximation"] > 0 else math.inf


def median(values):
    ordered = sorted(values)
    return ordered[len(ordered) // 2] if ordered else math.nan


def table(rows):
    """Markdown: a summary by way, then every run."""
    lines = ["| way | meshes | of them whole | median distance from the surface, in bounds |"
             " median seconds | median vertices | smallest dihedral, degrees: median, least |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    for title in dict.fromkeys(row["way"] for row in rows):
        of = [row for row in rows if row["way"] == title]
        meshed = [row for row in of if not row["why"]]
        angles = [row["smallest_dihedral"] for row in meshed]
        lines.append(f"| {title} | {len(meshed)} of {len(of)} | {sum(bool(row['whole']) for row in meshed)} | "
                     f"{median(map(distance, meshed)):.2f} | {median(row['seconds'] for row in meshed):.1f} | "
                     f"{median(row['vertices'] for row in meshed):.0f} | {median(angles):.1f}, "
                     f"{min(angles, default=math.nan):.2f} |")
    lines += ["", "| file | way | whole | distance, bounds | seconds | vertices | smallest dihedral | why not |",
              "| --- | --- | --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        if row["why"]:
            lines.append(f"| {row['file']} | {row['way']} | no mesh | | {row['seconds']:.1f} | | | "
                         f"{row['why'].replace('|', ' ')} |")
            continue
        lines.append(f"| {row['file']} | {row['way']} | {'yes' if row['whole'] else 'no'} | {distance(row):.2f} | "
                     f"{row['seconds']:.1f} | {row['vertices']:.0f} | {row['smallest_dihedral']:.1f} | "
                     f"{'' if row['whole'] else row['fault'].replace('|', ' ')} |")
    return "\n".join(lines) + "\n"
