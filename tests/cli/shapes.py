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


def layered(around=48, layers=6, rings=14, first=0.002, clockwise=False, triangles_first=True):
    """A .su2 mesh around an ellipse with a layer of flat quadrilaterals on its wall, triangles outside, and the numbers
    of both."""
    heights = [0.0]
    for k in range(layers):
        heights.append(heights[-1] + first * 1.3**k)
    for k in range(rings):
        heights.append(heights[-1] + 0.02 * 1.5**k)
    turn = [2 * math.pi * i / around for i in range(around)]
    points = [(0.5 + (0.5 + h) * math.cos(t), (0.1 + h) * math.sin(t)) for h in heights for t in turn]
    at = lambda i, j: j * around + i % around
    quads, triangles = [], []
    for j in range(layers + rings):
        for i in range(around):
            a, b, c, d = at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)
            if j < layers:
                quads.append((a, b, c, d))
            else:
                triangles += [(a, b, c), (a, c, d)]
    if clockwise:
        quads, triangles = [q[::-1] for q in quads], [t[::-1] for t in triangles]
    cells = [(5, *t) for t in triangles] + [(9, *q) for q in quads]
    if not triangles_first:
        cells.reverse()
    top = layers + rings
    walls = {"airfoil": [(at(i + 1, 0), at(i, 0)) for i in range(around)], "farfield": [(at(i, top), at(i + 1, top)) for i in range(around)]}
    lines = ["NDIME= 2", f"NELEM= {len(cells)}", *(" ".join(map(str, cell)) for cell in cells), f"NPOIN= {len(points)}"]
    lines += [f"{x!r} {y!r}" for x, y in points] + [f"NMARK= {len(walls)}"]
    for name, edges in walls.items():
        lines += [f"MARKER_TAG= {name}", f"MARKER_ELEMS= {len(edges)}", *(f"3 {a} {b}" for a, b in edges)]
    return "\n".join(lines) + "\n", len(triangles), len(quads)
