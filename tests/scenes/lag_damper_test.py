"""A lag hinge with an elastomeric damper: the cubic of a blade with a spring and a dashpot in series, its largest damping,
its limits, and the same damper between two points."""

import math
import re
import unittest

import h5py
import numpy as np

from program import SCENES
from rotor_test_case import RotorTest, upper
from scene_test_case import CLOSE


def cubic(p):
    """Roots of (I s^2 + omega^2 e S + spring)(k + c s) + k c s."""
    S, I = p["mass"] * p["span"] / 2, p["mass"] * p["span"]**2 / 3
    stiffness = p["omega"]**2 * p["offset"] * S + p["spring"]
    return upper(np.roots([I * p["c"], I * p["k"], p["c"] * (stiffness + p["k"]), stiffness * p["k"]]))


def lag(s):
    """Of the cubic's roots: the pair."""
    return s[np.argmax(s.imag)]


class LagDamper(RotorTest):
    scene = "lag_damper"

    def check(self, parameter, begin, end):
        file = self.trace_scene("--parameter", parameter, "--from", repr(begin), "--to", repr(end))
        self.assert_follows(file, lambda q: cubic(self.parameters(**{parameter: q})), parameter, np.linspace(begin, end, 40))

    def test_roots_against_dashpot_spring_speed_and_offset(self):
        for parameter, begin, end in (("c", 50.0, 20000.0), ("k", 1.0, 1e6), ("omega", 0.0, 60.0), ("offset", 0.05, 1.0)):
            with self.subTest(parameter):
                self.check(parameter, begin, end)

    def test_largest_damping_is_where_the_cubic_has_it(self):
        ratio = lambda c: -lag(cubic(self.parameters(c=c))).real / abs(lag(cubic(self.parameters(c=c))))
        low, high = 200.0, 5000.0  # golden section
        for _ in range(100):
            a, b = high - (high - low) / 1.618033988749895, low + (high - low) / 1.618033988749895
            low, high = (low, b) if ratio(a) > ratio(b) else (a, high)
        (c, s), = self.special_points(self.trace_scene(), "extremum")
        self.assertAlmostEqual(c, low, delta=1e-6 * low)  # a maximum is found to half the digits by its values
        self.assertAlmostEqual(-s.real / abs(s), ratio(low), delta=CLOSE)

    def replaced(self, text, element, unused):
        """The scene with another element in place of the damper, without the parameter that it does not need."""
        start = text.index("[[torsional_maxwell_damper]]")
        return re.sub(rf"(?m)^{unused} .*\n", "", text[:start] + element)

    def check_limit(self, series, limit, parameter, begin, end):
        options = ("--parameter", parameter, "--from", repr(begin), "--to", repr(end))
        places = np.linspace(begin, end, 5)
        of_series = self.spectra(self.trace_text(series, *options, output="series.h5"), places)
        of_limit = self.spectra(self.trace_text(limit, *options, output="limit.h5"), places)
        for in_series, alone in zip(of_series, of_limit):
            for s in alone:  # the series has one more, of the dashpot
                self.assertLess(min(abs(in_series - s)) / abs(s), 1e-6)

    def test_a_hard_dashpot_leaves_the_spring(self):
        limit = self.replaced(self.scene_text(), '[[torsional_spring]]\njoint = "lag"\nstiffness = "k"\n', "c")
        self.check_limit(self.changed(c=1e12), limit.replace('parameter = "c"', 'parameter = "omega"'), "omega", 10.0, 60.0)

    def test_a_stiff_spring_leaves_the_damper(self):
        limit = self.replaced(self.scene_text(), '[[torsional_damper]]\njoint = "lag"\ncoefficient = "c"\n', "k")
        self.check_limit(self.changed(k=1e12), limit, "c", 50.0, 4000.0)

    def test_it_rests_without_force(self):
        """The blade rests where it would without the damper, also turned by the spring."""
        file = self.trace_text(self.scene_text().replace('[[torsional_spring]]\njoint = "lag"',
                                                         '[[torsional_spring]]\njoint = "lag"\nfree_angle = 0.7'))
        angle = np.arctan2(self.equilibrium(file, "blade.x_axis")[:, 1], self.equilibrium(file, "blade.x_axis")[:, 0])
        np.testing.assert_allclose(self.coordinate(file, "elastomer.dashpot"), angle, rtol=CLOSE)
        self.assertGreater(angle[0], 0.1)

    def test_curve_of_a_damping_ratio_over_dashpot_and_speed(self):
        self.run_well("boundary", SCENES / "lag_damper.toml", "--second", "omega", "--second-from", "5", "--second-to", "60",
                      "--damping-ratio", "0.1", "--tolerance", "1e-10", "-o", "ratio.h5", "--quiet")
        with h5py.File(self.folder / "ratio.h5") as curves:
            places = list(zip(curves["c"][:], curves["omega"][:]))
        self.assertGreater(len(places), 10)
        for c, omega in places:
            s = lag(cubic(self.parameters(c=c, omega=omega)))
            self.assertAlmostEqual(-s.real / abs(s), 0.1, delta=1e-9)

    def test_left_out_it_leaves_the_undamped_blade(self):
        p = self.parameters()
        file = self.trace_scene("--without", "torsional_maxwell_damper", "--parameter", "omega", "--from", "1", "--to", "60")
        S, I = p["mass"] * p["span"] / 2, p["mass"] * p["span"]**2 / 3
        self.assert_follows(file, lambda w: np.array([1j * math.sqrt((w**2 * p["offset"] * S + p["spring"]) / I)]), "omega",
                            np.linspace(1, 60, 20))

    def test_explain_lists_its_state(self):
        explained = self.run_well("explain", self.write("scene.toml", self.scene_text()))
        self.assertIn("1 coordinate is a state of an element, of first order", explained)
        self.assertRegex(explained, r"elastomer\.dashpot +rad +angle of the dashpot")


if __name__ == "__main__":
    unittest.main()
