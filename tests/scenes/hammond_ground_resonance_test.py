"""Four equal blades on a support that differs along x and y: Coleman's equations, Hammond's limits, and Floquet multipliers
of the periodic equations blade by blade."""

import math
import re
import unittest

import h5py
import numpy as np

from periodic_rotor import PeriodicRotor, on_a_line
from program import each_case, edited
from rotor_test_case import RotorTest, companion, upper
from scene_test_case import CLOSE, SCENES

RPM = math.pi / 30.0


def coleman(p, blades=4):
    """M, C, K for x, y and the first harmonics of lag, lag_k = c cos psi_k + s sin psi_k (Coleman & Feingold, NACA Report
    1351, 1958). A blade obeys I lag'' + c lag' + e S omega^2 lag + S (y'' cos psi - x'' sin psi) = 0."""
    W, S, I, half = p["omega"], p["first"], p["second"], 0.5 * blades
    M = np.diag([p["hub_mass_x"] + blades * p["blade_mass"], p["hub_mass_y"] + blades * p["blade_mass"], I, I])
    M[0, 3], M[1, 2], M[2, 1], M[3, 0] = -half * S, half * S, S, -S
    C = np.diag([p["damper_x"], p["damper_y"], p["lag_damper"], p["lag_damper"]])
    C[2, 3], C[3, 2] = 2 * W * I, -2 * W * I
    hinge = p["offset"] * S * W**2 - W**2 * I
    K = np.diag([p["gear"], p["gear"], hinge, hinge])
    K[2, 3], K[3, 2] = W * p["lag_damper"], -W * p["lag_damper"]
    return M, C, K


def spectrum(p, blades=4):
    """With the collective lag mode and the others that leave the hub at rest."""
    alone = upper(np.roots([p["second"], p["lag_damper"], p["offset"] * p["first"] * p["omega"]**2]))
    return np.concatenate([companion(*coleman(p, blades)), *(blades - 2) * [alone]])


def growth(p):
    return np.max(companion(*coleman(p)).real)


def limit(function, below, above):
    """Zero of a function between two places, by bisection."""
    sign = np.sign(function(below))
    for _ in range(60):
        middle = 0.5 * (below + above)
        below, above = (middle, above) if np.sign(function(middle)) == sign else (below, middle)
    return 0.5 * (below + above)


class HammondGroundResonance(RotorTest):
    scene = "hammond_ground_resonance"

    def at(self, rpm, **changes):
        return self.parameters(omega=rpm * RPM, **changes)

    def test_spectrum_against_speed(self):
        self.assert_follows(self.trace_scene(), lambda rpm: spectrum(self.at(rpm)), "omega", np.linspace(100, 400, 40))

    def test_spectrum_against_dampers(self):
        for parameter, begin, end in (("lag_damper", 500.0, 5000.0), ("damper_y", 0.0, 6e4)):
            with self.subTest(parameter):
                file = self.trace_scene("--parameter", parameter, "--from", repr(begin), "--to", repr(end))
                self.assert_follows(file, lambda q: spectrum(self.parameters(**{parameter: q})), parameter,
                                    np.linspace(begin, end, 20))

    def test_unstable_speeds_are_hammonds(self):
        for damper, known in ((2000.0, (212.948, 309.638)), (1000.0, (170.325, 408.125))):
            with self.subTest(damper):
                file = self.trace_text(self.changed(lag_damper=damper), "--to", "450", tolerance=1e-9)
                found = sorted(rpm for rpm, _ in self.special_points(file, "flutter"))
                of_speed = lambda rpm: growth(self.at(rpm, lag_damper=damper))
                expected = [limit(of_speed, 100.0, 260.0), limit(of_speed, 260.0, 450.0)]
                np.testing.assert_allclose(found, expected, atol=1e-6)
                np.testing.assert_allclose(found, known, atol=5e-4)  # as printed

    def test_full_dampers_keep_it_stable(self):
        file = self.trace_scene("--set", "lag_damper=4067.5")
        self.assertEqual(self.special_points(file, "flutter"), [])
        self.assertLess(max(growth(self.at(rpm, lag_damper=4067.5)) for rpm in np.linspace(100, 400, 301)), 0.0)

    def test_floquet_multipliers_of_the_periodic_equations(self):
        file = self.trace_scene()
        for rpm in (260.0, 350.0):
            p = self.at(rpm)
            blade = on_a_line(p["blade_mass"], p["first"], p["second"])
            rotor = PeriodicRotor(4, p["omega"], p["offset"], 0.0, blade, [0, 1, 5, 7, 9, 11])
            rotor.M[0, 0], rotor.M[1, 1] = p["hub_mass_x"], p["hub_mass_y"]
            rotor.C[0, 0], rotor.C[1, 1] = p["damper_x"], p["damper_y"]
            rotor.K[0, 0] = rotor.K[1, 1] = p["gear"]
            for lag in (5, 7, 9, 11):
                rotor.C[lag, lag] = p["lag_damper"]
            self.assert_multipliers(rotor, self.spectra(file, [rpm])[0])

    def test_on_an_isotropic_support_it_is_the_rotor_in_one_turning_frame(self):
        """The scene ground_resonance describes all four blades in the turning frame. Whirls shift by the speed there."""
        same = self.changed(hub_mass_x=8026.6, hub_mass_y=8026.6, damper_x=51079.0, damper_y=51079.0, gear=1.2405e6,
                            lag_damper=1000.0)
        places = [120.0, 200.0, 310.0]
        fixed = self.spectra(self.trace_text(same, output="fixed.h5"), places)
        self.run_well("trace", SCENES / "ground_resonance.toml", "-o", "turning.h5", "--quiet", "--tolerance", "1e-11")
        turning = self.spectra(self.folder / "turning.h5", places)
        for rpm, here, there in zip(places, fixed, turning):
            alone = upper(np.roots([1084.7, 1000.0, 0.3048 * 289.1 * (rpm * RPM)**2]))[0]
            shifted, whirls = (self.without(alone, spectrum) for spectrum in (there, here))
            self.assertEqual((len(shifted), len(whirls), len(here)), (4, 4, 6))
            turn = 1j * rpm * RPM
            candidates = np.concatenate([shifted + turn, shifted - turn, shifted.conj() + turn])
            for s in whirls:
                self.assertLess(np.min(abs(candidates - s)), CLOSE * abs(s))

    def test_on_an_isotropic_support_blades_in_air_are_those_in_one_turning_frame(self):
        """Drag gives the blades a steady lag angle, and damps."""
        air = '''
[[strips]]
on = "{}"
root = [0.5, 0, 0]
tip = [6, 0, 0]
chord = 0.4
drag = 0.02
incidence = 0.1
'''
        fixed = self.changed(hub_mass_x=8026.6, hub_mass_y=8026.6, damper_x=51079.0, damper_y=51079.0, gear=1.2405e6,
                             lag_damper=1000.0) + air.format("blade")
        turning = (SCENES / "ground_resonance.toml").read_text(encoding="utf-8")
        turning += "".join(air.format(f"blade {k}") for k in (1, 2, 3, 4))
        places = [150.0, 310.0]
        here = self.spectra(self.trace_text(fixed, output="fixed.h5"), places)
        there = self.spectra(self.trace_text(turning, output="turning.h5"), places)
        for rpm, whirls, seen in zip(places, here, there):
            turn = 1j * rpm * RPM
            candidates = np.concatenate([seen, seen + turn, seen - turn, seen.conj() + turn])
            self.assertEqual(len(whirls), 6)
            for s in whirls:
                self.assertLess(np.min(abs(candidates - s)), CLOSE * abs(s))

    def test_strips_of_the_support_do_not_turn(self):
        """A wing on the hub that stands, along the wind: as strips, and as blade elements, which know the support."""
        wing = "root = [0, -1, 0]\ntip = [0, 1, 0]\nleading = [0, 0, 1]\nlift = [1, 0, 0]\nchord = 0.5\n"
        spectra = []
        for kind, on, wind in (("strips", "on", "wind"), ("blade_element", "body", "inflow")):
            text = self.scene_text() + f'\n[[{kind}]]\n{on} = "hub"\n{wing}{wind} = [0, 0, -20]\n'
            spectra.append(self.spectra(self.trace_text(text, output=f"{kind}.h5"), [250.0])[0])
        self.assert_same_spectrum(*spectra, CLOSE)

    @staticmethod
    def without(s, spectrum):
        return spectrum[abs(spectrum - s) > 1e-6 * abs(s)]

    def test_three_blades_with_the_same_total_whirl_alike(self):
        third = self.scene_text().replace("blades  = 4", "blades  = 3")
        for name, value in (("blade_mass", 94.9), ("first", 289.1), ("second", 1084.7), ("lag_damper", 2000.0)):
            third = third.replace(f"value = {value!r}", f"value = {value * 4 / 3!r}")
        places = [150.0, 260.0, 390.0]
        three = self.spectra(self.trace_text(third, output="three.h5"), places)
        four = self.spectra(self.trace_scene(), places)
        for rpm, few, many in zip(places, three, four):
            alone = spectrum(self.at(rpm))[-1]
            self.assertEqual((len(few), len(many)), (5, 6))
            self.assert_same_spectrum(self.without(alone, few), self.without(alone, many), CLOSE)

    def test_modes_are_named_as_waves(self):
        with h5py.File(self.trace_scene()) as file:
            names = [name.decode() for name in file["mode_name"][:]]
            coordinates = [name.decode() for name in file["coordinate"][:]]
            long_name = file["mode_shape"].attrs["long_name"]
        self.assertEqual({re.sub(r" \d$", "", name) for name in names if "blade" in name},
                         {"blade lag collective", "blade lag differential", "blade lag progressive",
                          "blade lag slow progressive"})
        for name in ("hub.x", "blade.y collective", "blade.x_axis.y cosine", "blade.x_axis.y sine", "blade.y differential"):
            self.assertIn(name, coordinates)
        self.assertIn("multiblade", long_name)

    def test_verify(self):
        self.assertIn("worst discrepancy", self.run_well("verify", self.trace_scene()))


def replaced(old, new):
    return lambda text: edited(text, old, new)


def with_more(addition):
    return lambda text: f"{text}\n{addition}\n"


ELEMENT = """[[blade_element]]
body = "blade"
root = [0, 0, 0]
tip = [6, 0, 0]
leading = [0, 1, 0]
lift = [0, 0, 1]
chord = 0.4
inflow = [10, 0, 0]"""
INFLOW = '[[inflow]]\nname = "disc"\nradius = 6\n'

# What would leave coefficients that change with the azimuth, or names that mean nothing.
REFUSED = [
    ("gravity across the axis", with_more("[gravity]\nacceleration = [0, -9.81, 0]"),
     "[gravity] acceleration: must be parallel to [frame] angular_velocity"),
    ("a hub beside the axis", replaced('mass = "hub_mass_y"\nposition = [0, 0, 0]', 'mass = "hub_mass_y"\nposition = [0.1, 0, 0]'),
     "'hub' must be at [0, 0, z]"),
    ("a hub that a load moves away", with_more('[[force]]\npoint = "hub"\ncomponents = [1000, 0, 0]'),
     "the hub 'hub' leaves the axis of rotation under a steady load"),
    ("a blade on the turning frame", replaced('from = "hub.hinge"', 'from = ["offset", 0, 0]'),
     "[[revolute]] 'lag': joins the blade of [rotor] with the turning frame"),
    ("a blade on the support", replaced('from = "hub.hinge"', 'from = "slide"'),
     "joins the blade of [rotor] with its support beside the hub"),
    ("a part of the support that is not named", replaced('support = ["slide"]', "support = []"),
     "name in [rotor] support what belongs to the support"),
    ("air that moves across the axis", with_more(ELEMENT), "along the axis of the [rotor]"),
    ("inflow beside the axis", with_more(INFLOW + "centre = [1, 0, 0]"), "on the axis of rotation"),
    ("inflow along another axis", with_more(INFLOW + "axis = [1, 0, 1]"), "must be parallel to it"),
    ("inflow along an axis that changes its sense", with_more(INFLOW + 'axis = [0, 0, "omega - 20"]'), "must not change its sense"),
    ("inflow of other blades", with_more(INFLOW + 'model = "uniform"\nblades = 4'), "with [rotor] their number is stated there"),
    ("another axis", replaced('angular_velocity = [0, 0, "omega"]', 'angular_velocity = ["omega", 0, 0]'),
     "[rotor] turns about the z axis"),
    ("a misspelt hub", replaced('hub     = "hub"', 'hub     = "hob"'), "no body is called 'hob'"),
    ("a misspelt support", replaced('support = ["slide"]', 'support = ["slid"]'), "did you mean"),
    ("two blades", replaced("blades  = 4", "blades  = 2"), "at least 3, found 2", "turning frame, without [rotor]", "scene.toml:29:"),
]


@each_case([(name, edit, fragments) for name, edit, *fragments in REFUSED])
class Refused(RotorTest):
    scene = "hammond_ground_resonance"

    def check(self, edit, fragments):
        self.write("scene.toml", edit(self.scene_text()))
        self.assert_refused(self.run_program("trace", "scene.toml", "-o", "x.h5"), fragments)


if __name__ == "__main__":
    unittest.main()
