# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots as SVG: curves over logarithmic or linear axes, and points by category."""

import math
from xml.sax.saxutils import escape

COLOURS = ("#2166ac", "#b2182b", "#35978f", "#e08214", "#762a83", "#4d4d4d", "#1b7837", "#c51b7d", "#8c510a", "#01665e",
           "#5e4fa2", "#d6604d", "#878787", "#003c30")
LEFT, RIGHT, TOP, HEIGHT = 90, 640, 60, 360


def ticks(low, high, logarithmic):
    if logarithmic:
        decades = range(math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9) + 1)
        return [10.0 ** e for e in decades]
    step = 10 ** math.floor(math.log10((high - low) / 4))
    step *= next(m for m in (1, 2, 5, 10) if (high - low) / (m * step) <= 6)
    return [step * k for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def label(value):
    for unit, name in ((1e6, "M"), (1e3, "k")):
        if value >= unit:
            return f"{value / unit:g}{name}"
    return f"{value:g}"


class Axis:
    def __init__(self, values, start, end, logarithmic, low=None):
        self.logarithmic, self.start, self.end = logarithmic, start, end
        values = [v for v in values if not logarithmic or v > 0] or [1, 10]
        self.low, self.high = min(values), max(values)
        if logarithmic:
            self.low, self.high = self.low / 1.3, self.high * 1.3
        else:
            self.low = 0 if low is None else low
            self.high = max(self.high * 1.05, self.low + 1e-9)

    def __call__(self, value):
        transform = math.log10 if self.logarithmic else float
        share = (transform(value) - transform(self.low)) / (transform(self.high) - transform(self.low))
        return self.start + share * (self.end - self.start)

    def ticks(self):
        return ticks(self.low, self.high, self.logarithmic)


def document(title, width, height, parts):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
            'font-family="sans-serif" font-size="13">\n<rect width="100%" height="100%" fill="white"/>\n'
            f'<text x="{LEFT}" y="30" font-size="18" font-weight="bold">{escape(title)}</text>\n'
            + "\n".join(parts) + "\n</svg>\n")


def text(x, y, words, anchor="start", extra=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {extra}>{escape(str(words))}</text>'


def line(x0, y0, x1, y1, colour="#e2e2e2", width=1.0):
    return f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" stroke="{colour}" stroke-width="{width}"/>'


def frame(y, vertical_title, parts):
    for v in y.ticks():
        parts += [line(LEFT, y(v), RIGHT, y(v)), text(LEFT - 8, y(v) + 4, label(v), "end")]
    parts += [line(LEFT, TOP, LEFT, TOP + HEIGHT, "#222222"), line(LEFT, TOP + HEIGHT, RIGHT, TOP + HEIGHT, "#222222"),
              text(LEFT - 60, TOP - 12, vertical_title)]


def legend(names, parts):
    for k, name in enumerate(names):
        y = TOP + 16 + 22 * k
        parts += [line(RIGHT + 24, y - 4, RIGHT + 54, y - 4, COLOURS[k % len(COLOURS)], 3), text(RIGHT + 62, y, name)]


def curves(filename, title, horizontal_title, vertical_title, series, log_x=True, log_y=True):
    """:param series: {name: [(x, y), ...]}; names keep their order."""
    series = {name: points for name, points in series.items() if points}
    if not series:
        return False
    x = Axis([p[0] for points in series.values() for p in points], LEFT, RIGHT, log_x)
    y = Axis([p[1] for points in series.values() for p in points], TOP + HEIGHT, TOP, log_y)
    parts = []
    frame(y, vertical_title, parts)
    for v in x.ticks():
        parts += [line(x(v), TOP, x(v), TOP + HEIGHT), text(x(v), TOP + HEIGHT + 18, label(v), "middle")]
    parts.append(text((LEFT + RIGHT) / 2, TOP + HEIGHT + 42, horizontal_title, "middle"))
    for k, points in enumerate(series.values()):
        colour = COLOURS[k % len(COLOURS)]
        path = " ".join(f"{x(a):.1f},{y(b):.1f}" for a, b in points)
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        parts += [f'<circle cx="{x(a):.1f}" cy="{y(b):.1f}" r="3.5" fill="{colour}"/>' for a, b in points]
    legend(series, parts)
    filename.write_text(document(title, 940, TOP + HEIGHT + 64, parts))
    return True


def by_category(filename, title, vertical_title, categories, series):
    """Points above the names of categories. :param series: {name: {category: y}}."""
    series = {name: values for name, values in series.items() if values}
    if not series:
        return False
    y = Axis([v for values in series.values() for v in values.values()], TOP + HEIGHT, TOP, False)
    width = (RIGHT - LEFT) / len(categories)
    parts = []
    frame(y, vertical_title, parts)
    for i, category in enumerate(categories):
        row = i % 2 if len(categories) > 8 else 0  # names side by side would overlap
        parts.append(text(LEFT + (i + 0.5) * width, TOP + HEIGHT + 20 + 18 * row, category, "middle"))
        for k, values in enumerate(series.values()):
            if category not in values:
                continue
            x = LEFT + (i + 0.15 + 0.7 * (k + 0.5) / len(series)) * width
            colour = COLOURS[k % len(COLOURS)]
            parts += [line(x, y(0), x, y(values[category]), colour, min(5, 0.5 * width / len(series))),
                      f'<circle cx="{x:.1f}" cy="{y(values[category]):.1f}" r="3.5" fill="{colour}"/>']
    legend(series, parts)
    filename.write_text(document(title, 940, max(TOP + HEIGHT + 58, TOP + 40 + 22 * len(series)), parts))
    return True
