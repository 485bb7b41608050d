"""What programs beside ours write and read: points that no cell uses, vectors, keys, names with blanks, a far field of several parts."""

import unittest

from harness import ProgramTest
from transfer_test import ascii_restart, gas, read_ascii, su2_points, vtu_array

class Vectors(ProgramTest):
    def test_velocities_have_three_components_and_come_back_as_they_were(self):
        self.succeed("flow", "naca:0012", "--points", 40, "--mach", 0.4, "-o", "a.vtu", "-o", "a.vtkhdf", "-o", "a.msh")
        text = self.path("a.vtu").read_text()
        self.assertRegex(text, 'Name="velocity" NumberOfComponents="3"')
        self.assertNotIn('NumberOfComponents="2"', text)
        velocity = vtu_array(self.path("a.vtu"), "velocity")
        self.assertEqual(set(velocity[2::3]), {0.0})
        self.assertGreater(len(set(velocity[1::3])), 10)
        for file in ("a.vtu", "a.vtkhdf", "a.msh"):
            self.succeed("convert", file, "-o", "again.vtu")
            self.assertEqual(vtu_array(self.path("again.vtu"), "velocity"), velocity, file)
            self.assertIn('remodel_components="2"', self.path("again.vtu").read_text(), file)

    def test_meshio_sees_vectors(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("needs python3-meshio, which is not installed")
        self.succeed("flow", "naca:0012", "--points", 40, "--mach", 0.4, "-o", "a.vtu", "-o", "a.msh")
        for name in ("a.vtu", "a.msh"):
            velocity = meshio.read(self.path(name)).point_data["velocity"]
            self.assertEqual(velocity.shape[1], 3)
            self.assertEqual(abs(velocity[:, 2]).max(), 0)


class Keys(ProgramTest):
    def test_layered_meshes_have_them_in_every_format_that_holds_them(self):
        layers = ("--layers", "--reynolds", 6e6, "--max-spacing", 0.05)
        for cells in ("quads", "triangles"):
            outputs = [word for end in ("msh", "vtu", "vtkhdf") for word in ("-o", f"a.{end}")]
            self.succeed("mesh", "naca:0012", *layers, "--layer-cells", cells, *outputs)
            self.succeed("mesh", "naca:0012", *layers, "--layer-cells", cells, "--msh-version", "2.2", "-o", "old.msh")
            keys = vtu_array(self.path("a.vtu"), "vertex_key", int)
            self.assertEqual(len(set(keys)), len(keys))
            self.assertGreater(max(keys), 2**63)
            self.assertIn('"vertex_key"', self.path("a.msh").read_text())
            for file in ("a.msh", "old.msh", "a.vtkhdf"):
                self.succeed("convert", file, "-o", "b.vtu")
                self.assertEqual(vtu_array(self.path("b.vtu"), "vertex_key", int), keys, file)


if __name__ == "__main__":
    unittest.main()
