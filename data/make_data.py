#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the inputs in this folder: `python3 make_data.py [FOLDER]` writes them into FOLDER, or beside this script.

Nothing is random and nothing is read: each shape follows from the formulas below, and the coordinates are rounded to
a few digits, so that the files come out the same everywhere.
"""

import math
import os
import struct
import sys


class Graph:
    """A planar straight line graph that is written as a .poly file."""

    def __init__(self):
        self.points, self.segments, self.holes, self.regions = [], [], [], []

    def chain(self, points, marker, closed=True):
        """Adds points joined one to the next; returns their numbers."""
        first = len(self.points)
        self.points += points
        numbers = list(range(first, len(self.points)))
        self.join(numbers + numbers[:1] if closed else numbers, marker)
        return numbers

    def join(self, numbers, marker):
        self.segments += [(a, b, marker) for a, b in zip(numbers, numbers[1:])]

    def write(self, filename, title, digits):
        def place(p):
            return " ".join("%.*f" % (digits, c + 0.0) for c in p)

        with open(filename, "w", encoding="ascii", newline="\n") as out:
            out.write("# %s\n# Made by make_data.py, GPL-3.0-or-later.\n" % title)
            out.write("%d 2 0 0\n" % len(self.points))
            out.writelines("%d %s\n" % (i, place(p)) for i, p in enumerate(self.points))
            out.write("%d 1\n" % len(self.segments))
            out.writelines("%d %d %d %d\n" % (i, a, b, m) for i, (a, b, m) in enumerate(self.segments))
            out.write("%d\n" % len(self.holes))
            out.writelines("%d %s\n" % (i, place(p)) for i, p in enumerate(self.holes))
            if self.regions:
                out.write("%d\n" % len(self.regions))
                out.writelines("%d %s %d 0\n" % (i, place(p), m) for i, (p, m) in enumerate(self.regions))


# ---- gulf.poly: a coast as the zero line of a made-up terrain


def gradient(i, j, octave):
    """A direction for a point of the integer lattice, scattered by multiplications modulo 2^32."""
    n = (i * 374761393 + j * 668265263 + octave * 2246822519 + 3266489917) & 0xFFFFFFFF
    n = ((n ^ (n >> 13)) * 1274126177) & 0xFFFFFFFF
    n = ((n ^ (n >> 16)) * 2654435761) & 0xFFFFFFFF
    angle = 2 * math.pi * (n >> 8) / 2**24
    return math.cos(angle), math.sin(angle)


def noise(x, y, octave):
    """Gradient noise (Perlin, "An image synthesizer", 1985): smooth, about -0.7 to 0.7, features of size 1."""
    i, j = math.floor(x), math.floor(y)
    u, v = x - i, y - j

    def corner(a, b):
        gx, gy = gradient(i + a, j + b, octave)
        return gx * (u - a) + gy * (v - b)

    def blend(t, a, b):
        return a + (b - a) * t * t * t * (t * (6 * t - 15) + 10)

    return blend(v, blend(u, corner(0, 0), corner(1, 0)), blend(u, corner(0, 1), corner(1, 1)))


def terrain(x, y):
    """Height of the land above the sea, kilometres: a gulf that narrows inland from its mouth in the west."""
    axis = 42 + 8 * math.sin(x / 19 + 0.4) + 0.04 * x
    half_width = 23 * math.sqrt(max(0, 1 - ((x - 30) / 92) ** 2))
    height = max(abs(y - axis) - half_width, -6)  # shallow enough for islands to rise
    size, amplitude = 26.0, 24.0
    for octave in range(5):
        height += amplitude * noise(x / size + 2.3, y / size + 61.2, octave)
        size, amplitude = size / 2, amplitude * 0.52
    return height


def contours(height, columns, rows, step):
    """Closed zero lines of a function on a grid, the low side to the left (marching squares). Beyond the grid is high."""
    value = [[height(step * i, step * j) for i in range(columns + 1)] for j in range(rows + 1)]
    for j in range(rows + 1):
        for i in range(columns + 1):
            if i in (0, columns) or j in (0, rows):
                value[j][i] = 60.0
    following = {}
    for j in range(rows):
        for i in range(columns):
            corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            low = [value[q][p] < 0 for p, q in corners]
            # Sides where the boundary is crossed, counterclockwise: one that enters low ground joins the last that left.
            crossed = [k for k in range(4) if low[k] != low[(k + 1) % 4]]
            for n, k in enumerate(crossed):
                if low[k]:
                    other = crossed[n - 1] if len(crossed) == 4 else crossed[1 - n]
                    following[side(corners, k)] = side(corners, other)
    loops = []
    while following:
        key = min(following)
        loop = []
        while key in following:
            a, b = key
            t = value[a[1]][a[0]] / (value[a[1]][a[0]] - value[b[1]][b[0]])
            loop.append((step * (a[0] + t * (b[0] - a[0])), step * (a[1] + t * (b[1] - a[1]))))
            key = following.pop(key)
        loops.append(loop)
    return loops


def side(corners, k):
    return tuple(sorted((corners[k], corners[(k + 1) % 4])))


def area(loop):
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(loop, loop[1:] + loop[:1])) / 2


def length(points):
    return sum(math.dist(p, q) for p, q in zip(points, points[1:]))


def smoothed(points, passes, closed):
    """Rounds off what is as small as the grid; the ends of an open line stay."""
    for _ in range(passes):
        n = len(points)
        inner = [
            tuple((points[i - 1][c] + 2 * points[i][c] + points[(i + 1) % n][c]) / 4 for c in (0, 1)) for i in range(n)
        ]
        points = inner if closed else points[:1] + inner[1:-1] + points[-1:]
    return points


def resampled(points, spacing):
    """Points at equal distances along an open line, with both ends."""
    walked = [0.0]
    for p, q in zip(points, points[1:]):
        walked.append(walked[-1] + math.dist(p, q))
    n = max(1, round(walked[-1] / spacing))
    result, k = [], 0
    for i in range(n):
        stop = i * walked[-1] / n
        while walked[k + 1] < stop:
            k += 1
        t = (stop - walked[k]) / (walked[k + 1] - walked[k])
        result.append(tuple(points[k][c] + t * (points[k + 1][c] - points[k][c]) for c in (0, 1)))
    return result + points[-1:]


def gulf():
    """The sea of the terrain above, from its mouth on; the mouth has mark 1, the coast 2, islands 3, 4, ..."""
    mouth, step, spacing = 7.0, 0.5, 1.0
    loops = contours(lambda x, y: terrain(x, y) if x >= mouth else 60.0, 280, 180, step)
    sea = max(loops, key=area)
    # The mouth: the straight line between the westernmost points of the two shores.
    west = [i for i, p in enumerate(sea) if p[0] < mouth]
    north = max(west, key=lambda i: sea[i][1])
    south = min(west, key=lambda i: sea[i][1])
    coast = [sea[(south + i) % len(sea)] for i in range((north - south) % len(sea) + 1)]
    graph = Graph()
    shore = graph.chain(resampled(smoothed(coast, 6, False), spacing), 2, closed=False)
    graph.join([shore[-1], shore[0]], 1)
    islands = [loop[::-1] for loop in loops if area(loop) < -1.6 and surrounds(sea, loop[0])]
    for marker, island in enumerate(sorted(islands, key=area, reverse=True), 3):
        island = smoothed(island, 4, True)
        graph.chain(resampled(island + island[:1], 0.7 * spacing)[:-1], marker)
        graph.holes.append(inner_point(island))
    return graph


def surrounds(loop, p):
    return sum(
        (a[1] > p[1]) != (b[1] > p[1]) and p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        for a, b in zip(loop, loop[1:] + loop[:1])
    ) % 2 == 1


def inner_point(loop):
    """The middle of the first stretch inside the loop on the horizontal line through its middle height."""
    y = (min(p[1] for p in loop) + max(p[1] for p in loop)) / 2
    x = sorted(
        a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        for a, b in zip(loop, loop[1:] + loop[:1])
        if (a[1] > y) != (b[1] > y)
    )
    return (x[0] + x[1]) / 2, y


# ---- plate.poly: a mounting plate


def arc(center, radius, first, last, n):
    """n + 1 points on an arc, angles in degrees, ends included."""
    return [turned(center, radius, first + (last - first) * i / n) for i in range(n + 1)]


def turned(center, radius, degrees):
    angle = math.radians(degrees)
    return center[0] + radius * math.cos(angle), center[1] + radius * math.sin(angle)


def plate():
    """A plate of 200 by 120 millimetres. Marks: 1 outline, 2 bore, 3 bolt holes, 4 slots, 5 seat around the bore,
    6 ribs; regions: 1 the plate, 2 the seat."""
    width, height, corner = 200.0, 120.0, 15.0
    graph = Graph()
    outline = []
    for x, y, first in [(width - corner, corner, -90), (width - corner, height - corner, 0),
                        (corner, height - corner, 90), (corner, corner, 180)]:
        outline += arc((x, y), corner, first, first + 90, 8)
    graph.chain(outline, 1)

    bore = (100.0, 60.0)
    graph.chain(arc(bore, 22, 0, 360, 64)[:-1], 2)
    graph.holes.append(bore)
    seat = graph.chain(arc(bore, 32, 0, 360, 72)[:-1], 5)
    graph.regions += [((20.0, 60.0), 1), ((bore[0] + 27, bore[1]), 2)]

    for x in (20.0, width - 20):
        for y in (20.0, height - 20):
            graph.chain(arc((x, y), 7, 0, 360, 28)[:-1], 3)
            graph.holes.append((x, y))
    for y in (16.0, height - 16):
        slot = arc((125.0, y), 5, -90, 90, 10) + arc((75.0, y), 5, 90, 270, 10)
        graph.chain(slot, 4)
        graph.holes.append((100.0, y))

    # Ribs: from the seat at 30 degrees and its mirror images, ending in the open before the bolt holes.
    for number, degrees in [(6, 30), (30, 150), (42, 210), (66, 330)]:
        end = len(graph.points)
        graph.points.append(turned(bore, 68, degrees))
        graph.join([seat[number], end], 6)
    return graph


# ---- airfoil.poly: a NACA 0012 section in a wind tunnel


def airfoil():
    """A NACA 0012 section of chord 1, 4 degrees nose up, in a channel of 8 by 5. Marks: 1 inlet, 2 outlet, 3 walls,
    4 section. The thickness is that of Abbott and von Doenhoff, "Theory of Wing Sections" (1959), its last coefficient
    changed to -0.1036 so that the trailing edge is sharp. Points lie closer near both edges."""
    def thickness(x):
        return 0.6 * (0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)

    n = 60  # points a side
    upper = [(x, thickness(x)) for x in ((1 + math.cos(math.pi * i / n)) / 2 for i in range(n + 1))]
    upper[0] = (1.0, 0.0)
    lower = [(x, -y) for x, y in upper[-2:0:-1]]
    angle = math.radians(-4)
    cos, sin = math.cos(angle), math.sin(angle)
    section = [(cos * (x - 0.25) - sin * y, sin * (x - 0.25) + cos * y) for x, y in upper + lower]

    graph = Graph()
    corners = graph.chain([(-2.5, -2.5), (5.5, -2.5), (5.5, 2.5), (-2.5, 2.5)], 3)
    graph.segments = [(a, b, {1: 2, 3: 1}.get(a, 3)) for a, b in zip(corners, corners[1:] + corners[:1])]
    graph.chain(section, 4)
    graph.holes.append((cos * 0.05, sin * 0.05))
    return graph


# ---- gear.off: a spur gear with hubs


class Surface:
    """A surface of quadrilaterals that is written as an .off file."""

    def __init__(self):
        self.points, self.facets = [], []

    def write(self, filename, title, digits):
        with open(filename, "w", encoding="ascii", newline="\n") as out:
            out.write("OFF\n# %s\n# Made by make_data.py, GPL-3.0-or-later.\n" % title)
            out.write("%d %d 0\n" % (len(self.points), len(self.facets)))
            out.writelines(" ".join("%.*f" % (digits, c + 0.0) for c in p) + "\n" for p in self.points)
            out.writelines("%d %s\n" % (len(f), " ".join(map(str, f))) for f in self.facets)


def gear():
    """A spur gear of 14 teeth, 64 mm across and 12 mm wide, with a hub on both sides and a bore of 14 mm. Its web is
    thinner than its rim and blends into hub and rim with fillets. Half-planes through the axis cut it in the same
    profile but for the height of the teeth."""
    teeth, root, tip = 14, 26.0, 32.0

    # A tooth, as angles in parts of its pitch and heights: a flat root, a flank, a rounded tip, a flank.
    flank = [(0.24 + 0.025 * t + 0.045 * t * t, t) for t in (0, 0.5, 1)]
    tooth = [(0.0, 0.0), (0.12, 0.0)] + flank + [(0.5, 1.0)] + [(1 - a, h) for a, h in flank[::-1]] + [(0.88, 0.0)]
    around = [((k + a) / teeth, root + (tip - root) * h) for k in range(teeth) for a, h in tooth]

    # The profile from the middle of the bore over the upper side to the middle of the rim; None: the tooth's height.
    def fillet(center, radius, start, end):
        return arc(center, radius, start, end, 6)

    upper = [(7, 0), (7, 9), (12, 9)] + fillet((15, 6), 3, 180, 270) + fillet((19.5, 5.5), 2.5, 270, 360) + \
        [(22, 6), (None, 6), (None, 0)]
    profile = upper + [(r, -z) for r, z in upper[-2:0:-1]]

    surface = Surface()
    n = len(profile)
    for turn, height in around:
        c, s = math.cos(2 * math.pi * turn), math.sin(2 * math.pi * turn)
        surface.points += [((r or height) * c, (r or height) * s, z) for r, z in profile]
    total = len(around) * n
    for i in range(len(around)):
        for j in range(n):
            a, b = i * n + j, i * n + (j + 1) % n
            surface.facets.append((a, b, (b + n) % total, (a + n) % total))
    return surface


# ---- heat_sink.stl: a base with fins


def heat_sink():
    """Triangles of a heat sink of 40 mm by 40 mm by 20 mm: a base of 4 mm with six fins of 2.5 mm on it."""
    width, depth, base, height, fin, gap, fins = 40.0, 40.0, 4.0, 20.0, 2.5, 5.0, 6
    feet = [x for k in range(fins) for x in (k * (fin + gap), k * (fin + gap) + fin)]
    top = []  # the outline above the base, from left to right
    for left, right in zip(feet[::2], feet[1::2]):
        top += [(left, base), (left, height), (right, height), (right, base)]
    outline = [(0.0, 0.0), (width, 0.0)] + top[::-1]
    cap = [((0.0, 0.0), (right, base), (left, base)) for left, right in zip(feet, feet[1:])]
    cap.append(((0.0, 0.0), (width, 0.0), (width, base)))
    for left, right in zip(feet[::2], feet[1::2]):
        cap += [((left, base), (right, base), (right, height)), ((left, base), (right, height), (left, height))]

    def at(p, y):
        return p[0], y, p[1]

    triangles = []
    for a, b, c in cap:  # counterclockwise with z upwards seen from the front, which is y = 0
        triangles += [(at(a, 0.0), at(b, 0.0), at(c, 0.0)), (at(a, depth), at(c, depth), at(b, depth))]
    for p, q in zip(outline, outline[1:] + outline[:1]):
        triangles += [(at(p, 0.0), at(p, depth), at(q, 0.0)), (at(q, 0.0), at(p, depth), at(q, depth))]
    return triangles


def write_stl(filename, title, triangles):
    """Writes triangles as a binary .stl file; normals are left to readers."""
    with open(filename, "wb") as out:
        out.write(struct.pack("<80sI", title.encode("ascii"), len(triangles)))
        for triangle in triangles:
            out.write(struct.pack("<12fH", 0, 0, 0, *(c for p in triangle for c in p), 0))


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    gulf().write(os.path.join(folder, "gulf.poly"), "A gulf with islands; kilometres.", 3)
    plate().write(os.path.join(folder, "plate.poly"), "A mounting plate; millimetres.", 6)
    airfoil().write(os.path.join(folder, "airfoil.poly"), "A NACA 0012 section in a channel; chords.", 8)
    gear().write(os.path.join(folder, "gear.off"), "A spur gear; millimetres.", 4)
    write_stl(os.path.join(folder, "heat_sink.stl"), "Heat sink, mm. By make_data.py, GPL-3.0-or-later.", heat_sink())


if __name__ == "__main__":
    main()
