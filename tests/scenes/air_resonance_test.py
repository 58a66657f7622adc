"""Air resonance in hover: without air the same rotor in multiblade coordinates, the trim in closed form, and the same with a trim
of multiblade coordinates on a fuselage."""

import csv
import io
import re
import unittest

import h5py
import numpy as np

from held_air import tables, with_air_held
from program import EXIT_BAD_INPUT, SCENES, edited
from rotor_test_case import RotorTest

DENSITY, RADIUS, THRUST = 1.225, 5.0, 15000.0


def assert_same_in_both_frames(test, standing, turning, omega, tolerance):
    """In the turning frame waves have their frequencies less or plus the speed of the rotor."""
    test.assertEqual(len(standing), len(turning))
    every = np.concatenate([turning, turning.conj()])
    for s in standing:
        seen = min(np.min(abs(every - (s + shift * 1j * omega))) for shift in (-1, 0, 1))
        test.assertLess(seen, tolerance * abs(s), s)
    # A wave is not seen at its own frequency: the comparison tells the frames apart.
    test.assertGreater(max(np.min(abs(every - s)) for s in standing), 1.0)


class AirResonance(RotorTest):
    scene = "air_resonance"

    def spectrum_at(self, text, omega):
        text = re.sub(r"(?m)^from +=.*", f"from = {omega}", text, count=1)
        self.write("scene.toml", re.sub(r"(?m)^to +=.*", f"to = {omega - 0.1}", text, count=1))
        run = self.run_program("trace", "scene.toml", "-o", "loci.h5", "--force")
        self.assertEqual(run.returncode, 0, run.stderr)
        return self.spectra("loci.h5", [omega])[0]

    def test_without_air_it_is_the_rotor_in_multiblade_coordinates(self):
        omega = 30.0
        parts = [part for part in tables(self.scene_text())
                 if not re.match(r"\[\[(inflow|trim|strips)\]\]", part)]
        turning = self.spectrum_at("".join(parts), omega)
        one = [part for part in parts if not re.search(r'"(blade|root) [234]"', part)]
        standing = self.spectrum_at("".join(one) + '\n[rotor]\nblades = 4\nhub = "fuselage"\n', omega)
        assert_same_in_both_frames(self, standing, turning, omega, 1e-6)

    def test_inflow_and_pitch_follow_the_thrust(self):
        file = self.trace_scene("--no-certify", tolerance=1e-4)
        inflow = np.sqrt(THRUST / (2 * DENSITY * np.pi * RADIUS**2))
        with h5py.File(file) as loci:
            names = [name.decode() for name in loci["coordinate"][:]]
            np.testing.assert_allclose(loci["equilibrium"][:, names.index("disc.mean")], inflow, rtol=1e-10)
            self.assertTrue(np.all(np.diff(loci["pitch"][:]) < 0))
            self.assertTrue(np.all(np.diff(loci["omega"][:]) > 0))

    def test_regressing_lag_grows_where_it_meets_the_body(self):
        (event,) = self.special_points(self.trace_scene("--no-certify", tolerance=1e-4), "flutter")
        self.assertAlmostEqual(event[0], 41.224, delta=0.01)
        lag, body = 28.4, 13.0  # in the turning frame and in the frame that stands, about
        self.assertLess(abs(event[0] - event[1].imag - body), 1.0)
        self.assertLess(abs(event[1].imag - lag), 0.5)


def turning(text):
    """air_resonance.toml with the inflow and the trim of air_resonance_fuselage.toml, its loads those of one blade."""
    parts = [part for part in tables(text) if not re.match(r"\[\[(inflow|trim)\]\]", part)]
    text = "".join(parts).replace('inflow    = "disc"', 'wind = [0, 0, "-inflow"]\ndensity = 1.225')
    text = edited(text, "[parameters]\n", '[parameters]\ninflow = { value = 8.0, unit = "m/s" }\n')
    for unknown, target in (("pitch", "thrust / 4"), ("inflow", "2 * 1.225 [kg/m^3] * pi * radius^2 * inflow^2 / 4")):
        text += f'\n[[trim]]\nunknown = "{unknown}"\ncondition = "force(air 1, z) = {target}"\n'
    return text.replace("1.225 [kg/m^3]", "rho").replace("[parameters]\n", '[parameters]\nrho = { value = 1.225, unit = "kg/m^3" }\n')


def with_inflow(text, model, axis=1):
    """air_resonance_fuselage.toml with another model, whose axis is that of the rotor, 1, or opposite to it, -1."""
    text = edited(text, 'model   = "pitt_peters"', f'model   = "{model}"\naxis = [0, 0, {axis}]\nguess = {axis * 8}')
    return edited(text, '"thrust(disc) = weight"', f'"thrust(disc) = {axis} * weight"')


def without_torque(text):
    """A moment about the axis, trimmed so that the pivot has none, whose two axes make it differ along and across them."""
    text = text.replace("[parameters]\n", '[parameters]\ncounter = { value = 0.0, unit = "N m" }\n')
    return text + ('\n[[moment]]\nbody = "fuselage"\nalong = [0, 0, 1]\nmagnitude = "counter"\n'
                   '[[trim]]\nunknown = "counter"\ncondition = "moment(pivot, z) = 0"\n')


class AirResonanceOnAFuselage(RotorTest):
    scene = "air_resonance_fuselage"

    def test_inflow_and_pitch_follow_the_weight(self):
        file = self.trace_scene("--no-certify", tolerance=1e-4)
        inflow = np.sqrt(THRUST / (2 * DENSITY * np.pi * RADIUS**2))
        with h5py.File(file) as loci:
            names = [name.decode() for name in loci["coordinate"][:]]
            np.testing.assert_allclose(loci["equilibrium"][:, names.index("disc.mean")], inflow, rtol=1e-10)
            self.assertIn("thrust(disc) = weight", loci["pitch"].attrs["long_name"])
            self.assertTrue(np.all(np.diff(loci["pitch"][:]) < 0))

    def test_with_a_body_alike_in_both_directions_it_is_the_rotor_seen_from_the_turning_frame(self):
        alike = without_torque(with_air_held(self.changed(roll=1500.0, pitching=1500.0)))
        whole = without_torque(turning((SCENES / "air_resonance.toml").read_text(encoding="utf-8")))
        for omega in (25.0, 41.0):
            self.assert_same_as_turning(alike, whole, omega, "pitch", "inflow", "counter")

    def test_inflow_is_that_seen_from_the_turning_frame(self):
        """The gradients of the inflow of Pitt and Peters stand with [rotor] and turn without it; the mean is the same."""
        for model, axis in (("pitt_peters", 1), ("pitt_peters", -1), ("uniform", 1)):
            alike = without_torque(with_inflow(self.changed(roll=1500.0, pitching=1500.0), model, axis))
            whole = edited((SCENES / "air_resonance.toml").read_text(encoding="utf-8"), "[[inflow]]\n", f'[[inflow]]\nmodel = "{model}"\n')
            for omega in (25.0, 41.0):
                self.assert_same_as_turning(alike, without_torque(whole), omega, "pitch", "counter")

    def assert_same_as_turning(self, alike, whole, omega, *unknowns):
        short = ("--from", repr(omega), "--to", repr(omega - 0.1), "--no-certify")
        (standing,) = self.spectra(self.trace_text(alike, *short, tolerance=1e-8), [omega])
        trim = [self.trimmed("loci.h5", omega, *unknowns)]
        (seen,) = self.spectra(self.trace_text(whole, *short, tolerance=1e-8), [omega])
        trim.append(self.trimmed("loci.h5", omega, *unknowns))
        np.testing.assert_allclose(trim[0], trim[1], rtol=1e-9)
        assert_same_in_both_frames(self, standing, seen, omega, 1e-7)

    def test_annuli_carry_the_weight(self):
        """Each by momentum theory; the blade of the scene stands for all."""
        text = edited(with_inflow(self.scene_text(), "annular"), 'inflow     = "disc"', 'inflow     = "disc"\nstrips     = 6')
        file = self.trace_text(text, "--no-certify", tolerance=1e-4)
        offset = 0.25
        at, weight = np.polynomial.legendre.leggauss(6)
        r, width = offset + (RADIUS - offset) * (1.0 + at) / 2.0, weight * (RADIUS - offset) / 2.0
        with h5py.File(file) as loci:
            names = [name.decode() for name in loci["coordinate"][:]]
            mean = np.array([loci["equilibrium"][:, names.index(f"disc, annulus {i + 1}.mean")] for i in range(6)])
            np.testing.assert_allclose(2.0 * DENSITY * (2.0 * np.pi * r * width) @ mean**2, THRUST, rtol=1e-9)
            self.assertGreater(np.min(np.ptp(mean, axis=0)), 1.0)

    def test_mistakes_are_named(self):
        for old, new, options, message in (
                ('inflow     = "disc"', 'inflow = "disk"', (), "did you mean 'disc'?"),
                ("thrust(disc)", "thrust(disk)", (), "no strips or inflow is called 'disk'; did you mean 'disc'?"),
                ('model   = "pitt_peters"', "blades = 4", (), "with [rotor] their number is stated there"),
                ("", "", ("--without", "inflow"), "the inflow 'disc' is left out; leave out the condition, too")):
            with self.subTest(message):
                self.write("scene.toml", edited(self.scene_text(), old, new) if old else self.scene_text())
                run = self.run_program("explain", "scene.toml", *options)
                self.assertEqual(run.returncode, EXIT_BAD_INPUT, run.stderr)
                self.assertIn(message, run.stderr)

    def trimmed(self, file, omega, *names):
        """Unknowns there."""
        rows = csv.DictReader(io.StringIO(self.run_well("eval", file, "--csv", "--at", repr(omega))))
        row = next(iter(rows))
        return [float(row[name]) for name in names]

    def test_lag_grows_beside_both_motions_of_the_body_and_with_air_held_beside_one(self):
        events = [place for place, _ in self.special_points(self.trace_scene("--no-certify"), "flutter")]
        np.testing.assert_allclose(events, [39.089, 41.050, 45.766], atol=2e-3)
        held = self.trace_text(with_air_held(self.scene_text()), "--no-certify", tolerance=1e-6)
        np.testing.assert_allclose([place for place, _ in self.special_points(held, "flutter")], [45.0908], atol=1e-3)

    def test_limits_move_with_the_weight_as_their_sensitivities_say(self):
        limits = []
        for weight in (14900.0, 15000.0, 15100.0):
            file = self.trace_scene("--no-certify", "--from", "38", "--to", "46", "--set", f"weight={weight}", tolerance=1e-10)
            limits.append([place for place, _ in self.special_points(file, "flutter")])
            if weight == 15000.0:
                with h5py.File(file) as loci:
                    rows = [i for i, kind in enumerate(loci["events"][:]) if kind.decode().startswith("flutter")]
                    names = [name.decode() for name in loci["scene_parameter"][:]]
                    moves = loci["event_shift"][rows, names.index("weight")]
        np.testing.assert_allclose((np.array(limits[2]) - limits[0]) / 200.0, moves, rtol=1e-3)


if __name__ == "__main__":
    unittest.main()
