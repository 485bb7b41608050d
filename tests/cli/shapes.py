"""Airfoil files for the tests, made from the NACA formula."""

import math


def thickness(x, percent=12):
    polynomial = 0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4
    return 5 * percent / 100 * polynomial


def selig_points(half=20, percent=12):
    """Trailing edge, upper surface, leading edge, lower surface, trailing edge."""
    stations = [(1 + math.cos(math.pi * i / half)) / 2 for i in range(half + 1)]
    upper = [(x, thickness(x, percent)) for x in stations]
    lower = [(x, -y) for x, y in reversed(upper[:-1])]
    return [(1.0, 0.0)] + upper[1:] + lower[:-1] + [(1.0, 0.0)]


def text_of(points, header="NACA 0012"):
    return "\n".join([header] + [f"{x:.6f} {y:.6f}" for x, y in points]) + "\n"


def selig():
    return text_of(selig_points())


def lednicer():
    points = selig_points()
    nose = min(range(len(points)), key=lambda i: points[i][0])
    upper, lower = points[nose::-1], points[nose:]
    lines = ["NACA 0012", f" {len(upper)}.  {len(lower)}.", ""]
    lines += [f"{x:.6f} {y:.6f}" for x, y in upper] + [""] + [f"{x:.6f} {y:.6f}" for x, y in lower]
    return "\n".join(lines) + "\n"


def with_row(row, index=10):
    """The Selig file with one row replaced."""
    lines = selig().splitlines()
    lines[index] = row
    return "\n".join(lines) + "\n"
