"""A rigid blade on hinges: flap, lag and pitch frequencies against speed, offset, precone and stiffness of the control."""

import math
import unittest

import numpy as np

from rotor_test_case import RotorTest, companion
from scene_test_case import CLOSE


def blade(p):
    """Flap, lag and pitch of a thin uniform plate (Johnson, Helicopter Theory, 1980)."""
    e = p["offset"] * math.cos(p["precone"])
    S, flap, pitch = p["mass"] * p["span"] / 2, p["mass"] * p["span"]**2 / 3, p["mass"] * p["chord"]**2 / 12
    return 1j * np.array([p["omega"] * math.sqrt(1 + e * S / flap), p["omega"] * math.sqrt(e * S / (flap + pitch)),
                          math.sqrt(p["control"] / pitch + p["omega"]**2)])


class HingedBlade(RotorTest):
    scene = "hinged_blade"

    def check(self, parameter, begin, end, unit=1.0):
        file = self.trace_scene("--parameter", parameter, "--from", repr(begin), "--to", repr(end))
        self.assert_follows(file, lambda q: blade(self.parameters(**{parameter: q * unit})), parameter,
                            np.linspace(begin, end, 20))
        return file

    def test_frequencies_against_speed(self):
        self.check("omega", 2.0, 50.0)

    def test_frequencies_against_offset_of_the_hinges(self):
        self.check("offset", 0.05, 1.0)

    def test_frequencies_against_stiffness_of_the_control(self):
        self.check("control", 5.0, 2000.0)

    def test_blade_stays_level_whatever_the_precone(self):
        file = self.check("precone", -5.0, 20.0, math.pi / 180.0)
        np.testing.assert_allclose(self.equilibrium(file, "blade.x_axis")[:, 2], 0.0, atol=1e-12)

    def test_flap_and_pitch_cross_where_the_offset_says(self):
        p = self.parameters()
        crossings = self.special_points(self.trace_scene(), "crossing")
        self.assertEqual(len(crossings), 1)
        e = p["offset"] * math.cos(p["precone"])
        expected = math.sqrt(12 * p["control"] / (p["mass"] * p["chord"]**2) / (1.5 * e / p["span"]))
        self.assertAlmostEqual(crossings[0][0], expected, delta=CLOSE * expected)

    def test_a_thick_blade_couples_flap_and_pitch(self):
        """G_zz = integral of z^2: flap and pitch are coupled by the Coriolis force 2 omega G_zz, flap loses stiffness."""
        p = self.parameters()
        thickness = 0.2
        text = self.scene_text().replace('["mass*chord^2/12", "mass*span^2/12", "mass*(span^2 + chord^2)/12"]',
                                   f'["mass*(chord^2 + {thickness}^2)/12", "mass*(span^2 + {thickness}^2)/12", '
                                   '"mass*(span^2 + chord^2)/12"]')
        self.assertNotEqual(text, self.scene_text())
        Gxx, Gyy, Gzz = (p["mass"] * a for a in (p["span"]**2 / 3, p["chord"]**2 / 12, thickness**2 / 12))
        S, e = p["mass"] * p["span"] / 2, p["offset"] * math.cos(p["precone"])

        def coupled(omega):
            # Flap up, pitch nose up (towards the leading edge y): their vertical motions are x flap + y pitch.
            M = np.diag([Gxx + Gzz, Gyy + Gzz, Gxx + Gyy])
            C = 2 * omega * Gzz * np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 0]])
            K = np.diag([omega**2 * (Gxx - Gzz + e * S), omega**2 * (Gyy - Gzz) + p["control"], omega**2 * e * S])
            return companion(M, C, K)

        self.assert_follows(self.trace_text(text), coupled, "omega", np.linspace(2.0, 50.0, 20))


if __name__ == "__main__":
    unittest.main()
