"""`remodel update MESH SHAPE --reference REFERENCE`: the mesh of a design is the morph of one reference, whatever
mesh the fields are on."""

from harness import ProgramTest
from transfer_test import binary_restart, gas, read_binary, su2_points


class References(ProgramTest):
    def setUp(self):
        super().setUp()
        self.succeed("mesh", "naca:0012", "--points", 60, "--refine-angle", 32, "-o", "r.vtkhdf", "-o", "r.su2")

    def update(self, old, shape, new, *options):
        return self.figures("update", old, shape, "--reference", "r.vtkhdf", "-o", new, *options)

    def test_the_mesh_is_the_same_whatever_was_before(self):
        self.succeed("update", "r.vtkhdf", "rae2822", "-o", "far.vtkhdf")
        self.succeed("update", "far.vtkhdf", "naca:2412", "-o", "farther.vtkhdf")
        self.succeed("mesh", "naca:4415", "--points", 40, "-o", "other.vtkhdf", "-o", "other.su2")
        olds = ("r.vtkhdf", "far.vtkhdf", "farther.vtkhdf", "other.vtkhdf", "other.su2")
        # A morph of the reference, and a design that is too far from it for that.
        for shape, held in (("naca:0013", True), ("naca:6424", False)):
            meshes = set()
            for old in olds:
                figures = self.update(old, shape, "new.vtkhdf")
                self.assertEqual((figures["held"], figures["strategy"]), (held, "reference"))
                meshes.add(self.path("new.vtkhdf").read_bytes())
                self.assertEqual(figures["triangles_before"], self.figures("check", old)["triangles"])
                self.assertEqual(figures["born"], figures["triangles"] - figures["connected"])
            self.assertEqual(len(meshes), 1)
            self.assertTrue(self.figures("check", "new.vtkhdf")["valid"])

    def test_a_design_that_returns_has_its_mesh_again(self):
        self.update("r.vtkhdf", "naca:0013", "a.vtkhdf")
        self.assertEqual(self.update("a.vtkhdf", "naca:6424", "b.vtkhdf")["held"], False)
        self.update("b.vtkhdf", "naca:0014", "c.vtkhdf")
        figures = self.update("c.vtkhdf", "naca:0013", "d.vtkhdf")
        self.assertEqual(self.path("a.vtkhdf").read_bytes(), self.path("d.vtkhdf").read_bytes())
        # Two morphs of the reference have all its triangles.
        self.assertEqual(figures["connectivity_percent"], 100)
        self.assertLess(figures["preserved"], figures["triangles"])
        self.assertEqual((figures["inserted"], figures["removed"], figures["born"], figures["gone"]), (0, 0, 0, 0))
        figures = self.update("a.vtkhdf", "naca:0013", "e.vtkhdf")
        self.assertEqual((figures["preserved_percent"], figures["moved"]), (100, 0))

    def test_what_is_of_another_history_has_nothing_in_common_but_places(self):
        self.succeed("mesh", "naca:4415", "--points", 40, "-o", "other.vtkhdf")
        figures = self.update("other.vtkhdf", "naca:0013", "new.vtkhdf")
        self.assertEqual(figures["connected"], figures["preserved"])

    def test_fields_are_those_of_the_mesh_that_is_left(self):
        self.succeed("update", "r.vtkhdf", "naca:0014", "-o", "old.vtkhdf", "-o", "old.su2")
        rows = [gas(*point) for point in su2_points(self.path("old.su2").read_text())]
        self.write("old.dat", binary_restart(rows))
        states = ("--state", "old.dat", "--state-out", "new.dat")
        figures = self.update("old.vtkhdf", "naca:0013", "new.vtkhdf", "-o", "new.su2", *states)
        points = su2_points(self.path("new.su2").read_text())
        self.assertEqual(figures["carried"] + figures["interpolated"], len(points))
        _, found = read_binary(self.path("new.dat").read_bytes())
        self.assertEqual([tuple(row[:2]) for row in found], points)
        self.assertLess(max(abs(row[2] - gas(*row[:2])[2]) for row in found), 0.02)
        # As `transfer` does between the two.
        self.succeed("transfer", "old.vtkhdf", "new.vtkhdf", "--state", "old.dat", "--state-out", "same.dat")
        self.assertEqual(self.path("same.dat").read_bytes(), self.path("new.dat").read_bytes())

    def test_what_makes_no_sense_is_refused(self):
        update = ("update", "r.vtkhdf", "naca:0013", "--reference", "r.vtkhdf")
        self.refused(*update, "--strategy", "renew", "-o", "new.vtkhdf", names="--strategy")
        self.refused(*update, "--points", 80, "-o", "new.vtkhdf", names="--points")
        self.refused(*update, "-o", "./r.vtkhdf", names="which is the reference")
        self.refused(*update[:-1], "none.vtkhdf", "-o", "new.vtkhdf", names="none.vtkhdf")
        self.refused(*update[:-1], "r.su2", "-o", "new.vtkhdf", names="--boundary")
        self.succeed(*update, "--strategy", "reference", "-o", "new.vtkhdf")
