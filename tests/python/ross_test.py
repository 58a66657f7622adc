"""Rotors of ROSS: against numpy's eigenvalues at twenty speeds, and published values."""

import importlib.util
import unittest

import eigentrail as et
import numpy as np

import rotors


def pairs(A):
    """One eigenvalue and the upper half of its vector per oscillating pair, by frequency."""
    s, vectors = np.linalg.eig(A)
    oscillates = np.flatnonzero(s.imag > 1.0)
    order = oscillates[np.argsort(s.imag[oscillates])]
    return s[order], vectors[:len(A) // 2, order]


class Friswell(unittest.TestCase):
    SPEEDS = np.linspace(10, 460, 20)

    def assert_agree(self, rotor, span, **how):
        loci = et.trace(et.from_ross(rotor), speed=span, modes="all", tolerance=1e-10, **how)
        for speed in self.SPEEDS:
            expected, _ = pairs(rotor.A(speed))
            found = loci.eigentrail.sel(speed=speed)
            s = found.eigenvalue.values
            s = s[s.imag > 1.0]
            s = s[np.argsort(s.imag)][:12]
            np.testing.assert_allclose(s, expected[:12], rtol=1e-8, atol=1e-8 * 80)
            decrement = -2 * np.pi * s.real / s.imag
            np.testing.assert_allclose(decrement, -2 * np.pi * expected[:12].real / expected[:12].imag, rtol=1e-8, atol=1e-8)
        return loci

    def test_the_assembly_gives_the_published_values(self):
        """At 4000 rpm; ibid., and computed with ROSS (petrobras/ross at 631a249a)."""
        s, _ = pairs(rotors.isotropic().A(4000 * np.pi / 30))
        np.testing.assert_allclose(s.imag[:4], [85.389, 87.796, 251.785, 294.713], atol=5e-4)

    def test_isotropic_bearings(self):
        self.assert_agree(rotors.isotropic(), (0, 480))

    def test_anisotropic_bearings_with_damping(self):
        self.assert_agree(rotors.anisotropic(), (0, 480))

    def test_whirl_is_that_of_the_orbits(self):
        for rotor, kinds in ((rotors.isotropic(), {"forward", "backward", ""}),
                             (rotors.anisotropic(), {"forward", "backward", "mixed", ""})):
            loci = et.trace(et.from_ross(rotor), speed=(10, 460), modes=dict(count=10, damping_below=0.9), tolerance=1e-8)
            whirl = loci.eigentrail.whirl()
            self.assertLessEqual(set(whirl.direction.values.ravel()), kinds)
            for node in range(0, loci.sizes["node"], 5):
                speed = float(loci.speed[node])
                s, vectors = pairs(rotor.A(speed))
                for mode in range(loci.sizes["mode"]):
                    here = complex(loci.eigenvalue.values[node, mode])
                    if not here.imag > 1.0:
                        continue
                    at = np.argmin(np.abs(s - here))
                    ratio = self.orbit(vectors[:, at])
                    found = whirl.values[node, mode]
                    lateral = np.isfinite(found) & (np.abs(found) > 1e-4)
                    if np.abs(s[at] - np.delete(s, at)).min() > 1e-3:
                        np.testing.assert_allclose(found[lateral], ratio[lateral], atol=1e-4)

    @staticmethod
    def orbit(vector):
        """Ratio of the axes by the singular values of the map from (cos, -sin) to the place; x y' - y x' has its sign."""
        xy = vector.reshape(-1, 6)[:, :2]
        axes = np.linalg.svd(np.stack([xy.real, xy.imag], -1), compute_uv=False)
        turns = xy[:, 1].real * xy[:, 0].imag - xy[:, 0].real * xy[:, 1].imag
        return np.sign(turns) * axes[:, 1] / axes[:, 0]

    def test_isotropic_modes_are_circles(self):
        loci = et.trace(et.from_ross(rotors.isotropic()), speed=(50, 400), modes=dict(count=6, band=["5 Hz", "70 Hz"]), tolerance=1e-8)
        whirl = np.abs(loci.eigentrail.whirl().values)
        self.assertTrue(np.nanmin(whirl) > 1 - 1e-4)

    def test_tables_of_bearings_become_samples_with_an_error(self):
        rotor = rotors.speed_dependent()
        family = et.from_ross(rotor)
        self.assertIsInstance(family, et.Samples)
        loci = et.trace(family, speed=(0, 500), modes=dict(count=8, band=["5 Hz", "200 Hz"]), tolerance=1e-8)
        for speed in (75.0, 333.0):  # between the values of the tables, which are linear here
            expected, _ = pairs(rotor.A(speed))
            found = loci.eigentrail.sel(speed=speed)
            s, error = found.eigenvalue.values, found.interpolation_error.values
            for one, bound in zip(s[s.imag > 1.0], error[s.imag > 1.0]):
                self.assertLess(np.abs(expected - one).min(), bound + 1e-8 * abs(one))
        with self.assertRaisesRegex(et.SceneError, "outside the samples"):
            et.trace(family, speed=(0, 600), modes=4)

    def test_critical_speeds_are_located(self):
        """Where the frequency equals the speed: ibid., by ROSS 86.4078, 86.9042, 260.517 and 288.617 rad/s."""
        loci = et.trace(et.from_ross(rotors.isotropic()), speed=(0, 460), modes=dict(count=8, band=["5 Hz", "80 Hz"]),
                        tolerance=1e-9, events=dict(harmonics=1))
        critical = np.sort(loci.eigentrail.events.query("kind == 'resonance'").speed)
        np.testing.assert_allclose(critical, [86.4078, 86.9042, 260.517, 288.617], rtol=2e-6)

    def test_names_are_those_of_nodes_discs_and_bearings(self):
        names = et.from_ross(rotors.isotropic()).names
        self.assertEqual(names[:2] + names[6:8] + names[12:14], ["bearing 1 x", "bearing 1 y", "node 1 x", "node 1 y", "disc 1 x", "disc 1 y"])

    def test_probes_are_names_too(self):
        import types
        names = et.from_ross(rotors.isotropic(), probes=[types.SimpleNamespace(node=1, tag="probe 1")]).names
        self.assertEqual(names[6:8], ["probe 1 x", "probe 1 y"])

    def test_another_state_matrix_is_refused(self):
        rotor = rotors.isotropic()
        theirs = rotor.A
        rotor.A = lambda speed: theirs(1.1 * speed)
        with self.assertRaisesRegex(ValueError, "differs from that of rotor.A"):
            et.from_ross(rotor)

    @unittest.skipUnless(importlib.util.find_spec("ross"), "ROSS is not installed")
    def test_with_ross_itself(self):
        import ross

        rotor = ross.rotor_example()
        loci = et.trace(et.from_ross(rotor), speed=(0, 400), modes=dict(count=8, damping_below=0.9), tolerance=1e-9)
        modal = rotor.run_modal(200.0)
        found = np.sort(loci.eigentrail.sel(speed=200.0).damped_frequency.values)
        np.testing.assert_allclose(found[:4], np.sort(modal.wd)[:4], rtol=1e-8)


if __name__ == "__main__":
    unittest.main()
