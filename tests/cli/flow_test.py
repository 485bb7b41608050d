"""`remodel flow`: keys of the contract, flows that agree with each other, refusals."""

import json

from harness import ProgramTest

KEYS = "cl cd cm alpha_deg mach converged residual newton_steps factorisations krylov_iterations seconds warm"


class Flows(ProgramTest):
    def test_keys_and_values(self):
        figures = self.figures("flow", "naca:0012", "--points", 60, "--mach", 0.5, "--alpha", 1.25)
        self.assertKeys(figures, KEYS + " status bodies history memory_mb triangles vertices model")
        self.assertTrue(figures["converged"])
        self.assertEqual(figures["warm"], "cold")
        self.assertLessEqual(figures["residual"], 1e-10)
        self.assertAlmostEqual(figures["cl"], 0.18, delta=0.03)
        self.assertEqual(len(figures["bodies"]), 1)

    def test_a_mesh_file_has_the_flow_of_its_shape(self):
        self.succeed("mesh", "naca:2412", "--points", 40, "-o", "mesh.vtkhdf", "-o", "mesh.su2")
        shape = self.figures("flow", "naca:2412", "--points", 40, "--mach", 0.4)
        for name in ("mesh.vtkhdf", "mesh.su2"):
            mesh = self.figures("flow", name, "--mach", 0.4)
            self.assertAlmostEqual(mesh["cl"], shape["cl"], delta=1e-9)

    def test_the_angle_for_a_lift(self):
        figures = self.figures("flow", "naca:2412", "--points", 40, "--mach", 0.4, "--cl", 0.6)
        self.assertAlmostEqual(figures["cl"], 0.6, delta=1e-8)
        again = self.figures("flow", "naca:2412", "--points", 40, "--mach", 0.4, "--alpha", figures["alpha_deg"])
        self.assertAlmostEqual(again["cl"], 0.6, delta=1e-7)

    def test_fields_are_written_beside_the_mesh(self):
        self.succeed("flow", "naca:0012", "--points", 40, "--mach", 0.4, "-o", "flow.vtu", "-o", "flow.vtkhdf")
        text = self.path("flow.vtu").read_text(errors="replace")
        for name in ("density", "velocity", "pressure", "mach", "cp", "entropy"):
            self.assertIn(f'Name="{name}"', text)
        self.succeed("convert", "flow.vtkhdf", "-o", "again.vtu")
        self.assertIn('Name="mach"', self.path("again.vtu").read_text(errors="replace"))

    def test_a_flow_that_is_not_found_says_so(self):
        outcome = self.succeed("flow", "naca:0012", "--points", 40, "--mach", 0.6, "--max-steps", 2, "--json", status=3)
        figures = outcome.json()
        self.assertFalse(figures["converged"])
        self.assertEqual(figures["status"], "step-limit")
        self.assertIn("no flow was found", outcome.stderr)

    def test_nothing_is_written_without_a_flow(self):
        self.succeed("flow", "naca:0012", "--points", 40, "--mach", 0.6, "--max-steps", 2, "-o", "flow.vtu", status=3)
        self.assertEqual(self.files(), {})


class Series(ProgramTest):
    def designs(self):
        designs = []
        base = self.figures("fit", "naca:0012")
        for i in range(4):
            designs.append({"degree": base["degree"],
                            "upper": [c + 1e-3 * i for c in base["upper"]],
                            "lower": [c - 5e-4 * i for c in base["lower"]]})
        return designs

    def test_each_design_has_its_flow(self):
        designs = self.designs()
        self.write("designs.json", json.dumps(designs))
        series = self.figures("flow", "naca:0012", "--points", 60, "--mach", 0.5, "--series", "designs.json",
                              "--compare", "rival")
        self.assertEqual(len(series["designs"]), len(designs))
        for entry in series["designs"]:
            self.assertKeys(entry, KEYS + " full_adjustment rival_seconds")
            self.assertTrue(entry["converged"])
            self.assertAlmostEqual(entry["cl"], entry["rival_cl"], delta=5e-3)
        self.assertEqual(series["designs"][0]["warm"], "cold")
        self.assertEqual(series["designs"][1]["warm"], "carried")

    def test_refusals(self):
        self.refused("flow", "naca:0012", "--mach", 0.5, "--series", self.write("a.json", "{"), names="a.json")
        self.refused("flow", "naca:0012", "--mach", 0.5, "--series", self.write("b.json", "{}"), names="b.json")
        self.refused("flow", "naca:0012", "--mach", 0.5, "--series", self.write("c.json", "[]"), names="c.json")
        self.refused("flow", "naca:0012", "--mach", 0.5, "--series", self.write("d.json", "[{\"upper\": 1}]"),
                     names="d.json, airfoil 1")


class Refusals(ProgramTest):
    def test_conditions(self):
        self.refused("flow", "naca:0012", names="--mach")
        self.refused("flow", "naca:0012", "--mach", 0, names="--mach")
        self.refused("flow", "naca:0012", "--mach", 5, names="--mach")
        self.refused("flow", "naca:0012", "--mach", 0.5, "--alpha", 100, names="--alpha")
        self.refused("flow", "naca:0012", "--mach", 1.2, "--cl", 0.3, names="mach")
        self.refused("flow", "naca:0012", "--mach", 0.5, "--reference", "1", names="--reference")
        self.refused("flow", "naca:0012", "--mach", 0.5, "--compare", "cold", names="--compare")

    def test_a_mesh_without_a_far_field(self):
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "mesh.su2")
        self.refused("flow", "mesh.su2", "--mach", 0.5, "--farfield", "outer", names="mesh.su2")
        self.refused("flow", "mesh.su2", "naca:0012", "--mach", 0.5, names="mesh.su2")
