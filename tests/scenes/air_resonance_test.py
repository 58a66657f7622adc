"""Air resonance in hover: without air the same rotor in multiblade coordinates, and the trim in closed form."""

import re
import unittest

import h5py
import numpy as np

from rotor_test_case import RotorTest

DENSITY, RADIUS, THRUST = 1.225, 5.0, 15000.0


def tables(text):
    """The text in parts, each of which begins with a table."""
    return re.split(r"(?m)^(?=\[)", text)


class AirResonance(RotorTest):
    scene = "air_resonance"

    def spectrum_at(self, text, omega):
        text = re.sub(r"(?m)^from +=.*", f"from = {omega}", text, count=1)
        self.write("scene.toml", re.sub(r"(?m)^to +=.*", f"to = {omega - 0.1}", text, count=1))
        run = self.run_program("trace", "scene.toml", "-o", "loci.h5", "--force")
        self.assertEqual(run.returncode, 0, run.stderr)
        return self.spectra("loci.h5", [omega])[0]

    def test_without_air_it_is_the_rotor_in_multiblade_coordinates(self):
        """In the turning frame waves have their frequencies less or plus the speed of the rotor."""
        omega = 30.0
        parts = [part for part in tables(self.scene_text())
                 if not re.match(r"\[\[(inflow|trim|strips)\]\]", part)]
        turning = self.spectrum_at("".join(parts), omega)
        one = [part for part in parts if not re.search(r'"(blade|root) [234]"', part)]
        standing = self.spectrum_at("".join(one) + '\n[rotor]\nblades = 4\nhub = "fuselage"\n', omega)
        self.assertEqual(len(standing), len(turning))
        every = np.concatenate([turning, turning.conj()])
        for s in standing:
            seen = min(np.min(abs(every - (s + shift * 1j * omega))) for shift in (-1, 0, 1))
            self.assertLess(seen, 1e-6 * abs(s), s)
        # A wave is not seen at its own frequency: the comparison tells the frames apart.
        self.assertGreater(max(np.min(abs(every - s)) for s in standing), 1.0)

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


if __name__ == "__main__":
    unittest.main()
