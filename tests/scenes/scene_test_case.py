"""Shared by the tests of the scenes: tracing a scene of data/scenes with a tight tolerance, its eigenvalues at and between
nodes, and its special points."""

import csv
import io
import re

import h5py
import numpy as np

from command_test_case import CommandTest
from program import SCENES

TIGHT = 1e-11  # tolerance of the traces
CLOSE = 1e-10  # relative difference from closed forms


class SceneTest(CommandTest):
    """Tests of one scene of data/scenes: `scene` is its name."""

    scene = ""

    def scene_text(self):
        return (SCENES / f"{self.scene}.toml").read_text(encoding="utf-8")

    def trace_scene(self, *options, output="loci.h5", tolerance=TIGHT):
        """Traces the scene of the library; returns the path of the loci file."""
        self.run_well("trace", SCENES / f"{self.scene}.toml", "-o", output, "--quiet", "--force", "--tolerance", tolerance,
                      *options)
        return self.folder / output

    def trace_text(self, text, *options, output="loci.h5", tolerance=TIGHT):
        """Traces a scene given as text."""
        return self.trace(text, "--force", "--tolerance", tolerance, *options, output=output)

    def nodes(self, path):
        """The traced parameter (nodes), eigenvalues (nodes x modes)."""
        with h5py.File(path) as file:
            return file[file.attrs["parameter"]][:], file["eigenvalue"][:]

    def coordinate(self, path, name):
        """One coordinate of the equilibrium at the nodes."""
        with h5py.File(path) as file:
            return file["equilibrium"][:, [c.decode() for c in file["coordinate"]].index(name)]

    def events(self, path, kind=None):
        rows = csv.DictReader(io.StringIO(self.run_well("events", path, "--csv")))
        return [row for row in rows if kind is None or row["kind"] == kind]

    def event_parameters(self, path, kind):
        return [float(row["parameter"]) for row in self.events(path, kind)]

    def check_frequencies(self, path, closed_form, places, relative=CLOSE):
        """`closed_form(p)` has the frequencies at p, as many as there are modes; s = j frequency at the nodes and
        at `places`, whatever the order of the modes."""
        p, s = self.nodes(path)
        pairs = [(p, s), (np.asarray(places, float), self.eval_at(path, places))]
        for at, found in pairs:
            expected = np.array([np.sort(closed_form(x)) for x in at])
            order = np.argsort(found.imag, axis=1)
            sorted_s = np.take_along_axis(found, order, axis=1)
            self.assertEqual(sorted_s.shape, expected.shape)
            self.assert_within(sorted_s, 1j * expected, relative)

    def redundant(self, text=None):
        """Coordinates, constraints, redundant ones and freedoms that `explain` reports."""
        self.write("sizes.toml", text or self.scene_text())
        explained = self.run_well("explain", "sizes.toml")
        found = re.search(r"(\d+) freedoms?: (\d+) coordinates?, (no|\d+) constraints?(?: \((\d+) more)?", explained)
        freedoms, coordinates, independent, redundant = (int(number) if number and number != "no" else 0
                                                         for number in found.groups())
        return coordinates, independent + redundant, redundant, freedoms
