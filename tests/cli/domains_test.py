"""Domains of any kind: several airfoils with their places, domain files, planar graphs; every file that is meshed is
validated by `check`."""

import json
import math
import random
from pathlib import Path

from harness import ProgramTest, main

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "domains"
TINY = 1e-8


def poly(points, segments, holes=(), base=1, markers=True):
    """The text of a .poly file; segments are (from, to, marker), 0-based."""
    lines = [f"{len(points)} 2 0 0"]
    lines += [f"{i + base} {x!r} {y!r}" for i, (x, y) in enumerate(points)]
    lines.append(f"{len(segments)} {int(markers)}")
    for i, (a, b, marker) in enumerate(segments):
        lines.append(f"{i + base} {a + base} {b + base}" + (f" {marker}" if markers else ""))
    lines.append(str(len(holes)))
    lines += [f"{i + base} {x!r} {y!r}" for i, (x, y) in enumerate(holes)]
    return "\n".join(lines) + "\n"


def ring(corners, first=0, marker=1):
    n = len(corners)
    return [(first + i, first + (i + 1) % n, marker) for i in range(n)]


def circle(x, y, r, n):
    return [(x + r * math.cos(2 * math.pi * i / n), y + r * math.sin(2 * math.pi * i / n)) for i in range(n)]


BOX = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]


def outlines(*all_corners, holes=(), extra=()):
    """A graph of closed outlines, and of open ones (extra)."""
    points, segments = [], []
    for corners in all_corners:
        segments += ring(corners, len(points))
        points += corners
    for chain in extra:
        segments += [(len(points) + i, len(points) + i + 1, 2) for i in range(len(chain) - 1)]
        points += chain
    return poly(points, segments, holes)


def star(x, y, r, tips, inner):
    corners = []
    for i in range(2 * tips):
        radius = r if i % 2 == 0 else inner * r
        corners.append((x + radius * math.cos(math.pi * i / tips), y + radius * math.sin(math.pi * i / tips)))
    return corners


def spiral(turns, n):
    def arm(start):
        return [((start + 0.1 * t) * math.cos(t), (start + 0.1 * t) * math.sin(t))
                for t in (i * turns * 2 * math.pi / n for i in range(n + 1))]
    return arm(0.2) + arm(0.15)[::-1]


def guitar(n):
    def radius(t):
        return 2 + 0.6 * math.cos(2 * t) + 0.25 * math.cos(4 * t)
    return [(1.3 * radius(t) * math.cos(t), radius(t) * math.sin(t)) for t in (2 * math.pi * i / n for i in range(n))]


def coast(n, seed):
    draw = random.Random(seed)
    waves = [(k, draw.gauss(0, 0.25) / k**1.1, draw.uniform(0, 6.28)) for k in range(1, 60)]
    result = []
    for i in range(n):
        angle = 2 * math.pi * i / n
        radius = abs(1 + 0.3 * sum(a * math.sin(k * angle + phase) for k, a, phase in waves))
        result.append((radius * math.cos(angle), radius * math.sin(angle)))
    return result


def koch(a, b, depth):
    if depth == 0:
        return [a]
    (ax, ay), (bx, by) = a, b
    dx, dy = (bx - ax) / 3, (by - ay) / 3
    p, q = (ax + dx, ay + dy), (ax + 2 * dx, ay + 2 * dy)
    s, c = -math.sqrt(0.75), 0.5
    tip = (p[0] + c * dx - s * dy, p[1] + s * dx + c * dy)
    return koch(a, p, depth - 1) + koch(p, tip, depth - 1) + koch(tip, q, depth - 1) + koch(q, b, depth - 1)


def snowflake(depth):
    a, b, c = (0.0, 0.0), (1.0, 0.0), (0.5, math.sqrt(0.75))
    return koch(a, b, depth) + koch(b, c, depth) + koch(c, a, depth)


def lines(count, seed):
    draw = random.Random(seed)
    def end():
        return (draw.uniform(0, 10), draw.uniform(0, 10))
    return [[end(), end()] for _ in range(count)]


LETTER_A = [(0.0, 0.0), (1.0, 0.0), (1.6, 2.0), (3.4, 2.0), (4.0, 0.0), (5.0, 0.0), (3.0, 7.0), (2.0, 7.0)]
HOLES = [(x + 0.5, y + 0.5) for x in range(10) for y in range(10)]
KINDS = {
    "letter": outlines(LETTER_A, [(1.9, 3.0), (3.1, 3.0), (2.5, 5.0)], holes=[(2.5, 3.5)]),
    "hundred_holes": outlines(BOX, *[circle(x, y, 0.3, 24) for x, y in HOLES], holes=HOLES),
    "channel": outlines([(0.0, 0.0), (10.0, 0.0), (10.0, 0.01), (5.0, 0.02), (0.0, 0.01)]),
    "small_angle": outlines([(0.0, 0.0), (10.0, 0.0), (10.0, 0.05)]),
    "star_of_needles": outlines(star(0, 0, 1, 24, 0.05)),
    "crack": outlines(BOX, extra=[[(2.0, 2.0), (5.0, 5.0), (8.0, 5.1)]]),
    "crack_from_the_edge": outlines(
        BOX, extra=[[(0.0, 5.0), (5.0, 5.0)], [(5.0, 5.0), (9.0, 5.3)], [(5.0, 5.0), (9.0, 4.7)]]
    ),
    "crossing_outlines": outlines(BOX, [(3.0, -2.0), (12.0, 4.0), (8.0, 12.0), (-2.0, 7.0)]),
    "overlapping": outlines(
        BOX, [(10.0, 2.0), (14.0, 2.0), (14.0, 8.0), (10.0, 8.0)],
        extra=[[(0.0, 0.0), (5.0, 0.0), (12.0, 0.0)], [(2.0, 3.0), (8.0, 3.0)], [(4.0, 3.0), (11.0, 3.0)]],
    ),
    "coast": outlines(coast(5000, 1)),
    "snowflake": outlines(snowflake(5)),
    "spiral": outlines(spiral(6, 600)),
    "guitar": outlines(guitar(400), circle(0.4, 0, 0.5, 40), holes=[(0.4, 0.0)], extra=[[(-2.0, -0.3), (-1.0, -0.3)]]),
    "comb": outlines(
        [p for i in range(50) for p in [(i * 0.1, 0.0), (i * 0.1, 5.0), (i * 0.1 + 0.05, 5.0), (i * 0.1 + 0.05, 0.0)]]
        + [(5.0, 0.0), (5.0, -1.0), (0.0, -1.0)]
    ),
    "lines_at_random": outlines(BOX, extra=lines(25, 1)),
    "grid_and_diagonals": outlines(
        BOX, extra=[[(i * 0.5, 0.0), (i * 0.5, 10.0)] for i in range(1, 20)]
        + [[(0.0, i * 0.5), (10.0, i * 0.5)] for i in range(1, 20)] + [[(0.0, 0.0), (10.0, 10.0)]],
    ),
    "fan_of_6_degrees": outlines(BOX, extra=[[(5.0, 5.0), p] for p in circle(5, 5, 4, 60)]),
    "bow_tie": outlines([(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 4.0)]),
    "holes_that_touch": outlines(
        BOX, [(2.0, 2.0), (4.0, 2.0), (4.0, 4.0), (2.0, 4.0)], [(4.0, 4.0), (6.0, 4.0), (6.0, 6.0), (4.0, 6.0)],
        holes=[(3.0, 3.0), (5.0, 5.0)],
    ),
    "far_and_tiny": outlines([(1e6, 1e6), (1e6 + 1e-3, 1e6), (1e6 + 1e-3, 1e6 + 1e-3), (1e6, 1e6 + 1e-3)]),
}

def shuffled(text, seed):
    """The same graph: points and segments in another order, segments the other way round."""
    draw = random.Random(seed)
    rows = [line.split() for line in text.splitlines()]
    count = int(rows[0][0])
    points, places = rows[1:1 + count], list(range(count))
    draw.shuffle(places)
    number = {row[0]: str(places[i]) for i, row in enumerate(points)}
    lines = [" ".join(rows[0])]
    lines += [" ".join([number[row[0]], *row[1:]]) for row in sorted(points, key=lambda row: int(number[row[0]]))]
    head = rows[1 + count]
    segments = rows[2 + count:2 + count + int(head[0])]
    draw.shuffle(segments)
    lines.append(" ".join(head))
    for i, (_, a, b, *marker) in enumerate(segments):
        ends = [number[a], number[b]] if draw.random() < 0.5 else [number[b], number[a]]
        lines.append(" ".join([str(i), *ends, *marker]))
    return "\n".join(lines + [" ".join(row) for row in rows[2 + count + int(head[0]):]]) + "\n"


def house(x, y):
    return [(x, y), (x + 3.0, y), (x + 3.0, y + 2.5), (x, y + 2.5)]


def town(houses):
    """Houses in a square; one with a neighbour against its wall where there is a sixth corner."""
    corners = [[(0.0, 0.0), (42.0, 0.0), (42.0, 32.0), (0.0, 32.0)], *houses]
    holes = [(sum(x for x, _ in h) / len(h), sum(y for _, y in h) / len(h)) for h in houses]
    return outlines(*corners, holes=holes)


HOUSES = [house(4.0 + 9.0 * i, 4.0 + 9.0 * j) for i in range(4) for j in range(3)]
TERRACE = [*HOUSES, [(7.0, 4.0), (9.0, 4.0), (9.0, 6.5), (7.0, 6.5)]]


class Orders(ProgramTest):
    """What a mesh keeps does not depend on the order of its domain."""

    def preserved(self, before, after, *more):
        self.write("before.poly", before)
        self.write("after.poly", after)
        self.figures("mesh", "before.poly", "-o", "before.vtkhdf")
        figures = self.figures("update", "before.vtkhdf", "after.poly", "-o", "after.vtkhdf", *more)
        self.assertTrue(self.figures("check", "after.vtkhdf")["valid"])
        return figures["preserved_percent"]

    def test_graphs_in_another_order_keep_all_triangles(self):
        for name, text in KINDS.items():
            with self.subTest(name):
                self.assertEqual(self.preserved(text, shuffled(text, 7)), 100)

    def test_a_town_listed_backwards_or_from_other_corners_keeps_all_triangles(self):
        for strategy in ("chain", "renew", "morph", "reference"):
            for after in (HOUSES[::-1], [h[2:] + h[:2] for h in HOUSES], [h[::-1] for h in HOUSES]):
                self.assertEqual(self.preserved(town(HOUSES), town(after), "--strategy", strategy), 100)
                self.assertEqual(self.preserved(town(TERRACE), shuffled(town(TERRACE), 3), "--strategy", strategy), 100)

    def test_a_house_that_is_gone_or_new_leaves_the_others(self):
        for strategy in ("chain", "renew", "morph", "reference"):
            for gone in (3, 7, 11):
                less = TERRACE[:gone] + TERRACE[gone + 1:]
                self.assertGreater(self.preserved(town(TERRACE), town(less), "--strategy", strategy), 85)
                self.assertGreater(self.preserved(town(less), town(TERRACE[::-1]), "--strategy", strategy), 85)

    def test_an_edge_that_opens_or_closes_keeps_connectivity(self):
        for points in ("naca:2412", "rae2822"):
            self.figures("mesh", points, "-o", "x.vtkhdf", "--points", 100)
            fit = self.figures("fit", points, "-o", "x.json")
            self.assertTrue(fit)
            airfoil = json.loads(self.path("x.json").read_text())
            airfoil["te_upper"], airfoil["te_lower"] = airfoil["te_upper"] + 0.002, airfoil["te_lower"] - 0.002
            self.write("open.json", json.dumps(airfoil))
            there = self.figures("update", "x.vtkhdf", "open.json", "--strategy", "morph", "-o", "y.vtkhdf")
            back = self.figures("update", "y.vtkhdf", points, "--strategy", "morph", "-o", "z.vtkhdf")
            for figures in (there, back):
                self.assertEqual(figures["method"], "specialised")
                self.assertGreater(figures["connectivity_percent"], 90)
            for file in ("y.vtkhdf", "z.vtkhdf"):
                self.assertTrue(self.figures("check", file)["valid"])


class Graphs(ProgramTest):
    def mesh(self, text, *more):
        file = self.write("graph.poly", text)
        figures = self.figures("mesh", file, "--min-angle", 30, "-o", "x.vtkhdf", *more)
        checked = self.figures("check", "x.vtkhdf")
        self.assertTrue(checked["valid"])
        self.assertEqual(figures["stopped"], "done")
        self.assertEqual(figures["triangles"], checked["triangles"])
        held = figures["min_angle_deg"] if figures["exempt_triangles"] == 0 else figures.get("min_held_angle_deg")
        if held is not None and figures["exempt_triangles"] < figures["triangles"]:
            self.assertGreaterEqual(held, 30 * (1 - TINY))
        if figures["exempt_triangles"] > 0:
            self.assertGreater(figures["small_angles"], 0)
        return figures

    def test_every_kind(self):
        for name, text in KINDS.items():
            with self.subTest(name):
                self.mesh(text)

    def test_what_was_found_is_reported(self):
        found = self.mesh(KINDS["crossing_outlines"])["input"]
        self.assertGreater(found["crossings"], 0)
        found = self.mesh(KINDS["overlapping"])["input"]
        self.assertGreater(found["overlaps"], 0)
        self.assertGreater(found["points_on_segments"], 0)
        self.assertGreater(found["duplicate_points"], 0)

    def test_numbering_markers_and_a_node_file(self):
        square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
        sizes = set()
        for base in (0, 1):
            text = poly(square, ring(square, marker=7), base=base)
            figures = self.mesh(text)
            self.assertEqual(list(figures["boundary"]), ["7"])
            sizes.add(figures["triangles"])
            figures = self.mesh(poly(square, ring(square), base=base, markers=False))
            self.assertEqual(list(figures["boundary"]), ["boundary"])
            points, _, rest = text.partition("\n4 1\n")
            self.write("graph.node", points + "\n")
            sizes.add(self.mesh("# the points are in graph.node\n0 2 0 0\n4 1\n" + rest)["triangles"])
        self.assertEqual(len(sizes), 1)

    def test_map_coordinates_end_at_every_angle(self):
        points = [(403218.728, 5492388.775), (403318.142, 5492388.150), (403318.758, 5492488.033),
                  (403218.678, 5492488.062), (403245.139, 5492433.236), (403254.548, 5492434.749),
                  (403254.458, 5492446.538), (403296.422, 5492427.209)]
        ends = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 4), (7, 4), (7, 5)]
        self.write("map.poly", poly(points, [(a, b, 1) for a, b in ends], base=0))
        for angle in (20, 30, 33, 34):
            with self.subTest(angle):
                outcome = self.run_program("mesh", "map.poly", "--min-angle", angle, "--max-vertices", 30000,
                                           "-o", "x.vtkhdf", "--json")
                self.assertIn(outcome.status, (0,) if angle <= 30 else (0, 3), outcome)
                self.assertTrue(self.figures("check", "x.vtkhdf", "--min-angle", 0, "--max-gradation", 1e9)["valid"])

    def test_a_point_has_its_length_scale_from_its_surroundings(self):
        counts = set()
        for size in (0.1, 1.0, 1e7):
            square = [(0.0, 0.0), (size, 0.0), (size, size), (0.0, size), (0.5 * size, 0.5 * size)]
            counts.add(self.mesh(poly(square, ring(square[:4])))["triangles"])
        self.assertLess(max(counts) - min(counts), 0.1 * min(counts))

    def test_the_report_is_of_what_there_is(self):
        square = self.write("square.poly", poly(BOX, ring(BOX)))
        self.assertNotIn("farfield", self.succeed("mesh", square, "-o", "x.vtkhdf").stdout)
        self.assertIn("farfield", self.succeed("mesh", "naca:0012", "--points", 20, "-o", "x.vtkhdf").stdout)
        open_square = self.write("open.poly", poly(BOX, ring(BOX)[:3]))
        self.assertNotIn("holes", self.refused("mesh", open_square, "-o", "x.vtkhdf", names="nothing"))
        crossed = self.write("crossed.poly", outlines(BOX, extra=[[(2, 2), (8, 8)], [(2, 8), (8, 2)]]))
        self.assertIn(" 1 crossing of ", self.succeed("mesh", crossed, "-o", "x.vtkhdf").stdout)

    def test_refusals(self):
        crossing = self.write("crossing.poly", KINDS["crossing_outlines"])
        self.refused("mesh", crossing, "--crossings", "refuse", "-o", "x.vtkhdf", names="cross at (")
        square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
        good = poly(square, ring(square))
        bad = [
            ("open.poly", good.replace("4 1\n1 1 2 1\n", "3 1\n", 1), "enclose nothing"),
            ("short.poly", good[:20], "short.poly:3: "),
            ("number.poly", good.replace("2 1.0 0.0", "2 1.0 zero"), "number.poly:3: 'zero' found"),
            ("order.poly", good.replace("2 1.0 0.0", "5 1.0 0.0"), "order.poly:3: '5' found, 2 expected"),
            ("astray.poly", good.replace("4 4 1 1", "4 4 9 1"), "astray.poly:10: '9' found, a vertex from 1 to 4"),
            ("three.poly", good.replace("4 2 0 0", "4 3 0 0"), "dimension"),
            ("many.poly", good.replace("4 2 0 0", "400000000 2 0 0"), "many.poly:1: "),
            ("flat.poly", poly([(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)], ring([0, 1, 2])), "one line"),
            ("hole.poly", poly(square, ring(square), holes=[(0.5, 0.5)]), "enclose nothing"),
        ]
        for name, text, message in bad:
            with self.subTest(name):
                self.refused("mesh", self.write(name, text), "-o", "x.vtkhdf", names=message)


class Domains(ProgramTest):
    def test_the_examples(self):
        for file in sorted(EXAMPLES.iterdir()):
            with self.subTest(file.name):
                figures = self.figures("mesh", file, "-o", "x.vtkhdf")
                self.assertEqual(figures["stopped"], "done")
                self.assertGreaterEqual(figures["min_angle_deg"], 30 * (1 - TINY))
                self.assertTrue(self.figures("check", "x.vtkhdf")["valid"])

    def test_one_example_becomes_another(self):
        names = ["circles", "circles_swapped", "circle_gone", "square", "star", "crack", "circles"]
        self.succeed("mesh", EXAMPLES / "circles.json", "-o", "x.vtkhdf")
        for name in names:
            for method in ("auto", "general"):
                with self.subTest(name):
                    figures = self.figures(
                        "update", "x.vtkhdf", EXAMPLES / f"{name}.json", "--method", method, "-o", "x.vtkhdf"
                    )
                    self.assertFalse(figures["regenerated"])
                    self.assertGreaterEqual(figures["min_angle_deg"], 30 * (1 - TINY))
                    self.assertTrue(self.figures("check", "x.vtkhdf")["valid"])

    def test_several_airfoils_and_their_places(self):
        airfoils = ["naca:2408", "naca:4412", "naca:2408"]
        places = ["0.18,25,-0.17,-0.08", "1,0,0,0", "0.3,-30,1.0,-0.03"]
        def arguments(places):
            return airfoils + [word for place in places for word in ("--place", place)]
        figures = self.figures("mesh", *arguments(places), "--points", 60, "-o", "x.vtkhdf")
        self.assertEqual(set(figures["boundary"]), {"naca2408", "naca4412", "naca2408_2", "farfield"})
        self.assertTrue(self.figures("check", "x.vtkhdf")["valid"])
        places[2] = "0.3,-30.001,1.0,-0.03"
        figures = self.figures("update", "x.vtkhdf", *arguments(places), "-o", "y.vtkhdf")
        self.assertTrue(figures["full_adjustment"])
        places[2] = "0.3,-5,1.1,-0.05"
        figures = self.figures("update", "y.vtkhdf", *arguments(places), "-o", "y.vtkhdf")
        self.assertEqual(figures["method"], "specialised")
        self.assertGreaterEqual(figures["min_angle_deg"], 30 * (1 - TINY))
        self.assertTrue(self.figures("check", "y.vtkhdf")["valid"])
        self.refused("mesh", "naca:0012", "--place", "1,0,0,0", "--place", "1,0,0,0", names="--place")
        self.refused("mesh", "naca:0012", "--place", "0,0,0,0", names="chord")
        self.refused("mesh", "naca:0012", "--place", "1,0,0", names="--place")
        self.refused("mesh", "naca:0012", "naca:0012", "-o", "z.vtkhdf", names="touch or cross")

    def test_refusals_name_the_key(self):
        box = {"role": "outer", "curves": [{"name": "box", "shape": {"kind": "polyline", "points": [
            [0, 0], [1, 0], [1, 1], [0, 0]]}, "stations": 3}]}
        def with_change(**changes):
            return json.dumps({"loops": [{**box, **changes}]})
        for name, text, message in [
            ("role.json", with_change(role="inner"), "loops[0].role: found \"inner\""),
            ("open.json", with_change(open=True), "expected internal, left or right"),
            ("place.json", with_change(placement={"chord": -1}), "placement"),
            ("key.json", with_change(colour=1), "colour"),
            ("none.json", json.dumps({"loops": []}), "found no loop"),
            ("airfoil.json", json.dumps({"loops": [{"airfoil": "no such", "stations": 20}]}), "no such"),
            ("odd.json", json.dumps({"loops": [{"airfoil": "naca:0012", "stations": 21}]}), "even"),
        ]:
            with self.subTest(name):
                self.refused("mesh", self.write(name, text), "-o", "x.vtkhdf", names=message)


if __name__ == "__main__":
    import sys

    main(sys.argv)
