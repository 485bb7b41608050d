"""`remodel noise`: an objective along a line of designs, by four ways of making their meshes."""

from harness import ProgramTest

# The length of the mesh's edges and the design's own numbers, each an objective.
EDGES = """import json, math, sys
lines = iter(open(sys.argv[1]).read().splitlines())
cells = [next(lines).split() for line in lines if line.startswith("NELEM=") for _ in range(int(line.split("=")[1]))]
lines = iter(open(sys.argv[1]).read().splitlines())
points = [next(lines).split() for line in lines if line.startswith("NPOIN=") for _ in range(int(line.split("=")[1]))]
point = [tuple(map(float, words[:2])) for words in points]
total = sum(math.dist(point[int(c[i])], point[int(c[i % 3 + 1])]) for c in cells for i in (1, 2, 3))
print(json.dumps({"objective": total}))
"""
DESIGN = """import json, sys
design = json.load(open(sys.argv[2]))
print(json.dumps({"objective": (1 + sum(design)) ** 3}))
"""
WAYS = ("fresh", "living", "hub", "reference")


class Noise(ProgramTest):
    def noise(self, *arguments):
        figures = self.figures("noise", "naca:0012", "--points", 20, "--farfield-points", 12, *arguments)
        self.assertKeys(figures, "spacing count degree places fresh living hub reference")
        return figures

    def test_living_meshes_are_smoother_than_fresh_ones(self):
        self.write("edges.py", EDGES)
        figures = self.noise("--count", 6, "--spacing", 1e-3, "--evaluator", "python3 edges.py", "-o", "noise.svg")
        for way in WAYS:
            self.assertEqual(len(figures[way]["objective"]), 6)
            self.assertEqual(figures[way]["not_found"], 0)
        for way in ("hub", "reference"):
            self.assertLess(figures[way]["objective_rms"], 1e-2 * figures["fresh"]["objective_rms"])
        self.assertIn(b"<svg", self.path("noise.svg").read_bytes())

    def test_slopes_are_those_of_the_function(self):
        self.write("design.py", DESIGN)
        direction = ",".join(["1"] + ["0"] * 11)
        options = ["--count", 5, "--evaluator", "python3 design.py", "--direction", direction]
        figures = self.noise(*options)
        middle = figures["hub"]["objective"][2]
        slope = 3 * middle ** (2 / 3)
        for way in WAYS:
            self.assertAlmostEqual(figures[way]["slope"][0], slope, delta=1e-8 * abs(slope) + 1e-10)
            self.assertLess(figures[way]["objective_rms"], 1e-15 + 1e-12 * abs(middle))

    def test_of_a_flow(self):
        figures = self.noise("--count", 5, "--spacing", 1e-4, "--degree", 2, "--mach", 0.4, "--alpha", 1)
        for way in WAYS:
            self.assertKeys(figures[way], "cl_rms cd_rms slope slope_error cl cd")
            self.assertEqual(figures[way]["not_found"], 0)
            self.assertEqual(len(figures[way]["adjoint"]), 2)
        self.assertLess(figures["hub"]["cl_rms"], 1e-6)
        self.assertLess(figures["reference"]["cl_rms"], 1e-6)

    def test_slopes_of_a_flow_are_those_of_the_adjoint(self):
        """On copies of one mesh the fitted slope is the derivative of what was computed; fresh meshes' noise hides it."""
        for count in (5, 6):
            figures = self.noise("--count", count, "--spacing", 1e-5, "--degree", 2, "--mach", 0.4, "--alpha", 1)
            for k in range(2):
                for way in ("hub", "reference"):
                    slope, adjoint = (figures[way][key][k] for key in ("slope", "adjoint"))
                    self.assertAlmostEqual(slope, adjoint, delta=1e-4 * abs(adjoint) + 1e-7)
                adjoint = figures["hub"]["adjoint"][k]
                self.assertAlmostEqual(figures["fresh"]["adjoint"][k], adjoint, delta=0.5 * abs(adjoint))
        text = self.succeed("noise", "naca:0012", "--points", 20, "--farfield-points", 12, "--count", 5, "--mach", 0.4).stdout
        self.assertEqual(text.count("by the adjoint"), 8)

    def test_an_evaluation_that_fails_is_not_found_and_the_rest_goes_on(self):
        """Of seven designs by four ways the third one fails each time, in a way of its own."""
        self.write("fails.py", """import json, os, sys
design = json.load(open(sys.argv[2]))
count = int(open("count").read()) if os.path.exists("count") else 0
open("count", "w").write(str(count + 1))
way, number = divmod(count, 7)
if number == 2 and way == 0: sys.exit("no licence")
if number == 2 and way == 1: print("no JSON"); sys.exit()
if number == 2 and way == 2: print('{"objective": NaN}'); sys.exit()
if number == 2: os.abort()
print(json.dumps({"objective": (1 + sum(design)) ** 3}))
""")
        line = ["noise", "naca:0012", "--points", 20, "--farfield-points", 12, "--count", 7]
        outcome = self.succeed(*line, "--evaluator", "python3 fails.py", "--json")
        figures = outcome.json()
        for way in WAYS:
            self.assertEqual(figures[way]["not_found"], 1)
            self.assertEqual([value is None for value in figures[way]["objective"]], [i == 2 for i in range(7)])
            self.assertEqual(len(figures[way]["failures"]), 1)
            self.assertLess(figures[way]["objective_rms"], 1e-12)
        self.assertIn("no licence", figures["fresh"]["failures"][0])
        lines = outcome.stderr.splitlines()
        self.assertEqual([row.split(":")[1].strip() for row in lines], list(WAYS))
        self.assertIn("1 of 7 designs have no value: ", lines[0])
        nothing = self.succeed(*line, "--evaluator", "exit 3", "--json", status=1)
        self.assertEqual([nothing.json()[way]["not_found"] for way in WAYS], [7] * 4)
        self.assertNotIn("bug", nothing.stderr)

    def test_what_is_no_line_is_refused(self):
        line = ["noise", "naca:0012", "--mach", 0.4]
        self.refused("noise", "naca:0012", names="--mach")
        self.refused(*line, "--evaluator", "true", names="--mach")
        self.refused(*line, "--count", 4, names="--count")
        self.refused(*line, "--direction", "1,0", names="--direction")
        self.refused(*line, "--direction", ",".join(["0"] * 12), names="--direction")
        self.refused(*line, "--spacing", 1, names="--spacing")
        self.refused(*line, "-o", "noise.txt", names="noise.txt")
