"""Shared by the tests of the commands: tracing a scene that is given as text, and reading the output of `eval`."""

import csv
import io
import math

import h5py
import numpy as np

from program import ProgramTest, datasets

DEFAULT_TOLERANCE = 1e-6


def blade_eigenvalues(omega):
    """Lag and flap of BLADE: s^2 + (drag/mass) s + omega^2 {e, 1 + e} = 0 with e = offset/length = 1/5."""
    decay = 0.5 * 2.0 / 50.0
    return np.array([complex(-decay, math.sqrt(omega**2 * ratio - decay**2)) for ratio in (0.2, 1.2)])


class CommandTest(ProgramTest):
    def trace(self, scene, *options, output="loci.h5"):
        """Traces a scene given as text; returns the path of the loci file."""
        self.write("scene.toml", scene)
        self.run_well("trace", "scene.toml", "-o", output, "--quiet", *options)
        return self.folder / output

    def eval_rows(self, file, places):
        text = self.run_well("eval", file, "--csv", "--at", *map(repr, map(float, places)))
        return [(float(row["parameter"]), row["mode"], complex(float(row["real"]), float(row["imag"])))
                for row in csv.DictReader(io.StringIO(text))]

    def eval_at(self, file, places):
        """Eigenvalues, places x modes."""
        return np.array([s for _, _, s in self.eval_rows(file, places)]).reshape(len(places), -1)

    def open(self, name):
        file = h5py.File(self.folder / name)
        self.addCleanup(file.close)
        return file

    def assert_layout(self, file, layout):
        """`layout` has dimensions and units of every dataset by name."""
        self.assertEqual(set(datasets(file)), set(layout))
        for name, (dimensions, units) in layout.items():
            with self.subTest(name):
                dataset = file[name]
                self.assertEqual(dataset.shape, tuple(len(file[d]) for d in dimensions))
                if name not in dimensions:
                    self.assertEqual([[scale.name for scale in dim.values()] for dim in dataset.dims],
                                     [["/" + d] for d in dimensions])
                self.assertEqual(dataset.attrs["units"], units)
                self.assertTrue(dataset.attrs["long_name"])

    def assert_within(self, actual, expected, tolerance, reference=0.0):
        bound = tolerance * np.maximum(np.abs(expected), reference)
        np.testing.assert_array_less(np.abs(actual - expected), bound)
