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


if __name__ == "__main__":
    unittest.main()
