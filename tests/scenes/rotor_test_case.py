"""Shared by the tests of rotor scenes: the scene with other parameters, and comparison with the spectra of other models."""

import re
import tomllib

import h5py
import numpy as np

from scene_test_case import CLOSE, SceneTest


def value(entry):
    """The number of a parameter, in SI; units that the scenes use."""
    if not isinstance(entry, dict):
        return entry
    return entry["value"] * {"deg": np.pi / 180.0, "rpm": np.pi / 30.0, "mm": 1e-3, "GPa": 1e9}.get(entry.get("unit"), 1.0)


def companion(M, C, K):
    """Eigenvalues of M s^2 + C s + K, without lower members of pairs."""
    n = len(M)
    return upper(np.linalg.eigvals(np.block([[np.zeros((n, n)), np.eye(n)],
                                             [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])))


def upper(s):
    """Without the lower members of pairs."""
    s = np.asarray(s, dtype=complex)
    scale = np.max(np.abs(s))
    real = np.abs(s.imag) <= 1e-12 * scale
    return np.concatenate([s[real].real, s[~real & (s.imag > 0.0)]])


class RotorTest(SceneTest):
    def parameters(self, **changes):
        """The scene's parameters that are numbers, in SI."""
        given = tomllib.loads(self.scene_text())["parameters"]
        return {name: value(entry) for name, entry in given.items() if not isinstance(entry, str)} | changes

    def changed(self, **values):
        """The scene's text with other values of its parameters, in the scene's units."""
        text = self.scene_text()
        for name, number in values.items():
            text, count = re.subn(rf"(?m)^({name} *= *(?:{{ *value *= *)?)[-+.\de]+", rf"\g<1>{number!r}", text)
            self.assertEqual(count, 1, name)
        return text

    def spectra(self, file, places):
        """A list of eigenvalues for each place."""
        found = {}
        for place, _, s in self.eval_rows(file, places):
            found.setdefault(place, []).append(s)
        return [np.array([s for s in found[float(place)] if not np.isnan(s)]) for place in places]

    def assert_same_spectrum(self, actual, expected, tolerance=CLOSE, reference=0.0, message=""):
        """As sets: every expected eigenvalue takes the nearest one that is left."""
        self.assertEqual(len(actual), len(expected), f"{message}: {actual} and {expected}")
        left = list(actual)
        for s in expected:
            nearest = min(range(len(left)), key=lambda i: abs(left[i] - s))
            error = abs(left.pop(nearest) - s) / max(abs(s), reference)
            self.assertLess(error, tolerance, f"{message}: {s} is missing in {actual}")

    def assert_follows(self, file, expected, parameter, places, tolerance=CLOSE, reference=0.0):
        """Nodes, and dense output at `places`, have the spectrum expected(value of the parameter in the scene's unit)."""
        with h5py.File(file) as loci:
            nodes, at_nodes = loci[parameter][:], loci["eigenvalue"][:]
        for p, s in zip(nodes, at_nodes):
            self.assert_same_spectrum(s[~np.isnan(s)], expected(p), tolerance, reference, f"node {parameter} = {p}")
        for p, s in zip(places, self.spectra(file, places)):
            self.assert_same_spectrum(s, expected(p), tolerance, reference, f"{parameter} = {p}")

    def assert_multipliers(self, rotor, s, tolerance=1e-9):
        """The Floquet multipliers of a PeriodicRotor are those of the eigenvalues with Im s >= 0."""
        s = np.concatenate([s, s[s.imag != 0].conj()])
        self.assert_same_spectrum(rotor.multipliers(), np.exp(s * 2 * np.pi / rotor.speed), tolerance, 1.0)

    def special_points(self, file, kind):
        """Parameter and eigenvalue of the events of a kind."""
        with h5py.File(file) as loci:
            kinds = [text.decode().split(",")[0] for text in loci["events"][:]]
            return [(p, s) for k, p, s in zip(kinds, loci["event_parameter"][:], loci["event_eigenvalue"][:]) if k == kind]

    def equilibrium(self, file, name):
        """Coordinates of a point or body at all nodes: node x 3."""
        with h5py.File(file) as loci:
            names = [text.decode() for text in loci["coordinate"][:]]
            columns = [names.index(f"{name}.{axis}") for axis in "xyz"]
            return loci["equilibrium"][:][:, columns]
