# SPDX-License-Identifier: GPL-3.0-or-later
"""Markdown tables and the numbers in them."""

import math


def row(cells):
    return "| " + " | ".join(str(c).replace("|", "\\|").replace("\n", " ") for c in cells) + " |\n"


def table(head, rows):
    return "\n" + row(head) + row(["---"] * len(head)) + "".join(row(r) for r in rows)


def number(value, decimals=1):
    if value is None or math.isnan(value):
        return "–"
    return f"{value:.{decimals}f}"


def seconds(value):
    """Three significant digits."""
    if value is None or math.isnan(value):
        return "–"
    return number(value, 4 if value < 0.01 else 3 if value < 0.1 else 2 if value < 10 else 1)


def count(value):
    return "–" if value is None else f"{value:.0f}"


def yes(value):
    return "yes" if value else "**no**"


def by(measured, asked, larger_is_better, decimals=1, unit=""):
    """Whether a figure was met, or by how much it was missed."""
    if measured is None or math.isnan(measured):
        return "not measured"
    lack = asked - measured if larger_is_better else measured - asked
    return "met" if lack <= 1e-9 * max(1, abs(asked)) else f"**missed by {lack:.{decimals}f}{unit}**"
