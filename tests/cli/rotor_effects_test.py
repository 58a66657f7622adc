"""The effects of a rotor: left out, varied, and free motions in words."""

import re
import unittest

from program import EXIT_BAD_INPUT, ProgramTest

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
GROWTH = 1e-4  # of an effect, for central differences
DIGITS = 2e-3  # to which `explain` prints an influence, three digits


class RotorEffects(ProgramTest):
    def spectrum(self, scene, *options):
        """Eigenvalues at 3000 rpm."""
        self.write("rotor.toml", scene)
        run = self.run_program("spectrum", "rotor.toml", "--at", "3000", "--csv", *options)
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = [line.split(",") for line in run.stdout.splitlines()]
        columns = [rows[0].index(name) for name in ("real", "imag")]
        return [complex(*(float(row[at]) for at in columns)) for row in rows[1:]]

    def test_influences_are_the_derivatives(self):
        self.write("rotor.toml", ROTOR)
        text = self.run_program("explain", "rotor.toml", "--sensitivity", "--from", "3000").stdout
        found = {}
        for mode, block in enumerate(re.split(r"\n  mode \d+ ", text)[1:]):
            for name, real, imag in re.findall(r"(\w+) +\S+ +real (\S+) +imag (\S+)", block):
                found[mode, name] = complex(float(real), float(imag))
        grown = {"bearing": ("film = 1,", "film = {},"), "shaft": ("E = 2.1e11", "E = {}")}
        values = {"bearing": 1.0, "shaft": 2.1e11}
        here = self.spectrum(ROTOR)
        for name, (old, new) in grown.items():
            up, down = (self.spectrum(ROTOR.replace(old, new.format(values[name] * (1 + step))))
                        for step in (GROWTH, -GROWTH))
            for mode in range(4):
                expected = (up[mode] - down[mode]) / (2 * GROWTH) / abs(here[mode])
                self.assertLess(abs(found[mode, name] - expected), 2 * DIGITS * max(abs(expected), 1e-2), (mode, name))

    def test_an_effect_that_is_left_out(self):
        """Without discs and gyroscopic moments: as without the tables of discs, at rest."""
        plain = re.sub(r"disc = .*\n", "", ROTOR).replace('speed = "speed"', "speed = 0").replace("iron = 7850", 'unused = "speed"')
        for left, right in zip(self.spectrum(ROTOR, "--without", "disc,gyroscopic"), self.spectrum(plain)):
            self.assertLess(abs(left - right), 1e-9 * abs(right))

    def test_effects_that_cannot_be_left_out(self):
        self.write("rotor.toml", ROTOR)
        for name, words in (("shaft", "without its elastic forces there is no rotor"), ("seal", "is no effect of this rotor"),
                            ("bearings", "did you mean 'bearing'?")):
            run = self.run_program("explain", "rotor.toml", "--without", name)
            self.assertEqual(run.returncode, EXIT_BAD_INPUT)
            self.assertIn(words, run.stderr)

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
        self.assertIn("The shaft is free to move along x and to move along y", self.run_program("explain", "rotor.toml").stdout)

    def test_operating_ranges_with_units(self):
        self.write("rotor.toml", ROTOR + '\n[events]\nharmonics = 1\noperating_range = ["2000 rpm", "50 Hz"]\n')
        with_units = self.run_program("trace", "rotor.toml", "-o", "a.h5").stdout
        self.write("rotor.toml", ROTOR + "\n[events]\nharmonics = 1\noperating_range = [2000, 3000]\n")
        self.assertEqual(re.findall("margin .*", with_units),
                         re.findall("margin .*", self.run_program("trace", "rotor.toml", "-o", "b.h5").stdout))
        self.assertRegex(with_units, "operating range 2000 to 3000,")
        self.write("rotor.toml", ROTOR + '\n[events]\nharmonics = 1\noperating_range = [2000, "3 kg"]\n')
        run = self.run_program("trace", "rotor.toml", "-o", "c.h5")
        self.assertEqual(run.returncode, EXIT_BAD_INPUT)
        self.assertIn("operating_range: 3 kg does not fit speed, which is in rpm", run.stderr)


if __name__ == "__main__":
    unittest.main()
