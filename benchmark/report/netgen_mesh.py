# SPDX-License-Identifier: GPL-3.0-or-later
"""Netgen as a program: meshes a planar domain, a surface that it may mesh anew, or the inside of a given boundary.

    netgen_mesh.py planar INPUT.poly OUTPUT.mesh SIZE OPTIMISE
    netgen_mesh.py surface INPUT.stl OUTPUT.msh SIZE OPTIMISE
    netgen_mesh.py boundary INPUT.off OUTPUT.msh SIZE OPTIMISE

OPTIMISE is 0 or 1. Prints the user seconds of meshing, without those of starting Python, as JSON.
"""

import json
import resource
import sys


def seconds():
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def numbers(filename):
    with open(filename) as file:
        return [line.split() for line in file if line.strip() and not line.startswith("#")]


def read_graph(filename):
    """Points and segments of a .poly file numbered from 0."""
    lines = numbers(filename)
    n = int(lines[0][0])
    points = [(float(a[1]), float(a[2])) for a in lines[1:n + 1]]
    m = int(lines[n + 1][0])
    return points, [(int(a[1]), int(a[2])) for a in lines[n + 2:n + 2 + m]]


def is_inside(points, segments, x, y):
    inside = False
    for a, b in segments:
        (x0, y0), (x1, y1) = points[a], points[b]
        if (y0 > y) != (y1 > y) and x < x0 + (x1 - x0) * (y - y0) / (y1 - y0):
            inside = not inside
    return inside


def closed_segments(points, segments):
    """Those that don't belong to chains with ends."""
    segments = list(segments)
    while True:
        degree = [0] * len(points)
        for a, b in segments:
            degree[a] += 1
            degree[b] += 1
        kept = [(a, b) for a, b in segments if degree[a] > 1 and degree[b] > 1]
        if len(kept) == len(segments):
            return kept
        segments = kept


def planar(filename, size, optimise):
    from netgen.geom2d import SplineGeometry
    points, segments = read_graph(filename)
    closed = closed_segments(points, segments)
    geometry = SplineGeometry()
    for p in points:
        geometry.AppendPoint(*p)
    for a, b in segments:
        (x0, y0), (x1, y1) = points[a], points[b]
        x, y, dx, dy = (x0 + x1) / 2, (y0 + y1) / 2, 1e-6 * (x1 - x0), 1e-6 * (y1 - y0)
        left, right = is_inside(points, closed, x - dy, y + dx), is_inside(points, closed, x + dy, y - dx)
        geometry.Append(["line", a, b], leftdomain=int(left), rightdomain=int(right), bc=1)
    start = seconds()
    mesh = geometry.GenerateMesh(maxh=size, grading=1, optsteps2d=3 if optimise else 0)
    return mesh, start


def surface(filename, size, optimise):
    from netgen.stl import LoadSTLGeometry
    geometry = LoadSTLGeometry(filename)
    start = seconds()
    return geometry.GenerateMesh(maxh=size, optsteps3d=3 if optimise else 0), start


def boundary(filename, size, optimise):
    import netgen.meshing as netgen
    lines = numbers(filename)
    n, m = int(lines[1][0]), int(lines[1][1])
    mesh = netgen.Mesh(dim=3)
    ids = [mesh.Add(netgen.MeshPoint(netgen.Pnt(*map(float, p[:3])))) for p in lines[2:2 + n]]
    face = mesh.Add(netgen.FaceDescriptor(surfnr=1, domin=1, domout=0, bc=1))
    for t in lines[2 + n:2 + n + m]:
        mesh.Add(netgen.Element2D(face, [ids[int(v)] for v in t[1:4]]))
    start = seconds()
    mesh.GenerateVolumeMesh(mp=netgen.MeshingParameters(maxh=size, optsteps3d=3 if optimise else 0))
    return mesh, start


def write_medit(mesh, filename):
    with open(filename, "w") as out:
        out.write(f"MeshVersionFormatted 2\nDimension 2\nVertices\n{len(mesh.Points())}\n")
        for p in mesh.Points():
            out.write(f"{p.p[0]!r} {p.p[1]!r} 0\n")
        for name, elements in (("Edges", list(mesh.Elements1D())), ("Triangles", list(mesh.Elements2D()))):
            out.write(f"{name}\n{len(elements)}\n")
            for e in elements:
                out.write(" ".join(str(v.nr) for v in e.points) + " 1\n")
        out.write("End\n")


def main():
    kind, source, target, size, optimise = sys.argv[1:]
    mesh, start = {"planar": planar, "surface": surface, "boundary": boundary}[kind](source, float(size), optimise == "1")
    end = seconds()
    if kind == "planar":
        write_medit(mesh, target)
    else:
        mesh.Export(target, "Gmsh2 Format")
    print("\n" + json.dumps({"meshing_seconds": end - start}))


main()
