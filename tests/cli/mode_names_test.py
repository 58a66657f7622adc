"""Names that a scene gives to modes."""

import unittest

import h5py

from program import BLADE, EXIT_BAD_INPUT, FAMILY, ProgramTest

NAMED = FAMILY.replace("[matrix_family]", "[modes]\nnames = { %s }\n[matrix_family]")


class ModeNames(ProgramTest):
    def names(self, scene, *options):
        (self.folder / "scene.toml").write_text(scene)
        self.run_well("trace", "scene.toml", "-o", "out.h5", "--force", *options)
        with h5py.File(self.folder / "out.h5") as file:
            return [name.decode() for name in file["mode_name"]]

    def test_by_frequency(self):
        """The frequencies at the start are 1 and sqrt(2) rad/s."""
        self.assertEqual(self.names(NAMED % 'bounce = "1.5 rad/s", slow = 0.9'), ["slow", "bounce"])
        self.assertEqual(self.names(NAMED % 'bounce = "0.2 Hz"'), ["", "bounce"])

    def test_each_name_gets_a_mode_of_its_own_the_nearest_first(self):
        self.assertEqual(self.names(NAMED % 'a = 1.01, b = 1.02'), ["a", "b"])
        self.assertEqual(self.names(NAMED % 'a = 1.02, b = 1.01'), ["b", "a"])

    def test_by_shape(self):
        self.assertEqual(self.names(NAMED % 'left = { x1 = 1 }, right = { x2 = -2 }'), ["left", "right"])
        turned = NAMED.replace("K = [[[1, 0], [0, 2]], [[0, 1], [1, 0]]]", "K = [[[2, -1], [-1, 2]], [[1, 0], [0, 1]]]")
        self.assertEqual(self.names(turned % 'apart = { x1 = 1, x2 = -1 }, together = { x1 = 1, x2 = 1 }'), ["together", "apart"])

    def test_by_what_moves(self):
        self.assertEqual(self.names(BLADE + '[modes]\nnames = { edgewise = "lag" }\n'), ["edgewise", "flap"])

    def test_the_summary_and_resumed_traces_have_them(self):
        (self.folder / "scene.toml").write_text(NAMED % 'bounce = "1.4 rad/s"')
        printed = self.run_well("trace", "scene.toml", "-o", "out.h5")
        self.assertIn("bounce", printed)
        self.assertIn("bounce", self.run_well("info", "out.h5"))

    def test_mistakes(self):
        for names, text in (('a = "lug"', "the name of no mode holds"), ("a = 1, b = 2, c = 3", "no mode is left for it"),
                            ("a = { y = 1 }", "no coordinate is called 'y'"), ("a = { x1 = 0 }", "all are zero"),
                            ('a = "-2 Hz"', "at least 0"), ("a = true", "a")):
            with self.subTest(names):
                (self.folder / "scene.toml").write_text(NAMED % names)
                run = self.run_program("trace", "scene.toml", "-o", "bad.h5")
                self.assertEqual(run.returncode, EXIT_BAD_INPUT)
                self.assertIn("[modes]", run.stderr)
                self.assertIn(text, run.stderr)
                self.assertFalse((self.folder / "bad.h5").exists())
        (self.folder / "scene.toml").write_text(FAMILY + "[modes]\nname = 3\n")
        self.assertIn("did you mean 'names'", self.run_program("trace", "scene.toml", "-o", "bad.h5").stderr)


if __name__ == "__main__":
    unittest.main()
