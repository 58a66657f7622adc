"""Effects of a rotor that are left out, and free motions in words."""

import re
import unittest

from program import ProgramTest

ROTOR = """\
parameters = { speed = { value = 3000, unit = "rpm" }, film = 1, iron = 7850 }
trace = { parameter = "speed", from = 100, to = 6000, modes = 4 }
disc = [ { node = 2, outer = 0.4, inner = 0.05, width = 0.06, density = "iron" } ]
bearing = [ { node = [1, 5], kxx = "film*2e7", kyy = "film*3e7", kxy = "film*4e6", kyx = "-film*4e6", cxx = "film*2e4" } ]

[[shaft]]
stations = { length = 1.2, outer = 0.08 }
elements = 4
E = 2.1e11
nu = 0.3
density = 7850
speed = "speed"
"""


class RotorEffects(ProgramTest):
    def spectrum(self, scene, *options):
        """Eigenvalues at 3000 rpm."""
        self.write("rotor.toml", scene)
        run = self.run_program("spectrum", "rotor.toml", "--at", "3000", "--csv", *options)
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = [line.split(",") for line in run.stdout.splitlines()]
        columns = [rows[0].index(name) for name in ("real", "imag")]
        return [complex(*(float(row[at]) for at in columns)) for row in rows[1:]]

    def test_an_effect_that_is_left_out(self):
        """Without discs and gyroscopic moments: as without the tables of discs, at rest."""
        plain = re.sub(r"disc = .*\n", "", ROTOR).replace('speed = "speed"', "speed = 0").replace("iron = 7850", 'unused = "speed"')
        for left, right in zip(self.spectrum(ROTOR, "--without", "disc,gyroscopic"), self.spectrum(plain)):
            self.assertLess(abs(left - right), 1e-9 * abs(right))

    def test_free_motions_are_named_and_held(self):
        free = ROTOR.replace("[[shaft]]", "[[shaft]]\naxial = true\ntorsion = true")
        self.write("rotor.toml", free)
        text = self.run_program("explain", "rotor.toml").stdout
        self.assertIn("free to move along its axis and to turn about its axis", text)
        table = re.search(r'(\[\[support\]\]) (node = 1), (holds = \["z", "rz"\])', text)
        self.assertIsNotNone(table)
        note = self.run_program("trace", "rotor.toml", "-o", "free.h5").stdout
        self.assertIn("the shaft moves along its axis, the shaft turns about its axis", note)
        self.write("rotor.toml", free + "\n" + "\n".join(table.groups()) + "\n")
        self.assertNotIn("free to", self.run_program("explain", "rotor.toml").stdout)
        self.assertNotIn("zero for every", self.run_program("trace", "rotor.toml", "-o", "held.h5").stdout)

    def test_zeros_are_exact_for_any_mesh(self):
        """Inertia of a disc that depends on a parameter does not hide that nothing holds the shaft."""
        for elements in (1, 2, 3, 6, 20):
            free = ROTOR.replace("[[shaft]]", "[[shaft]]\naxial = true\ntorsion = true")
            free = free.replace("elements = 4", f"elements = {elements}").replace("[1, 5]", f"[1, {elements + 1}]")
            self.write("rotor.toml", free)
            text = self.run_program("trace", "rotor.toml", "-o", "free.h5", "--force").stdout
            self.assertIn("4 eigenvalues are zero for every speed", text)
            self.assertIn("certified on every step", text)

    def test_a_shaft_without_bearings_floats(self):
        self.write("rotor.toml", re.sub(r"bearing = .*\n", "", ROTOR).replace("film = 1", 'film = "speed"'))
        self.assertIn("The shaft is free to move along x, to tilt along x, to move along y and to tilt along y", self.run_program("explain", "rotor.toml").stdout)


if __name__ == "__main__":
    unittest.main()
