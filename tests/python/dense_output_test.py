"""What `sel` returns is what `eigentrail eval` prints, on every scene and where modes are hard to distinguish."""

import csv
import io
import shutil
import unittest

import eigentrail
import numpy as np
import xarray

from families import (THROUGH_INFINITY_ONCE, THROUGH_INFINITY_TWICE, coalescing, oscillators, random_family)
from program import BIRTH, CROSSING, CROSSING_WITHIN, PUSHED_PENDULUM, SCENES, ProgramTest, each_case, edited

# Sizes of blocks, and the charts, that the case must have: else it would test less than its name says.
HARD = [("modes are born", BIRTH, {1, 2}, {0}),
        ("two independent ones cross", CROSSING, {1}, {0}),
        ("two cross", CROSSING_WITHIN, {1, 2}, {0}),
        ("three coalesce", coalescing(3), {1, 3}, {0}),
        ("four damped ones coalesce", coalescing(4, damping=0.1), {1, 4}, {0}),
        ("six coalesce", coalescing(6), {1, 6}, {0}),
        ("eight coalesce", coalescing(8), {1, 8}, {0}),
        ("three independent ones cross at once", oscillators([1, 1, 1], [0.5, -0.5, 0]), {1}, {0}),
        ("three cross at once", oscillators([1, 1, 1], [0.5, -0.5, 0], curvature=0.1), {1, 3}, {0}),
        ("three veer by 1e-5", oscillators([1, 1, 1], [0.5, -0.5, 0], 1e-5), {1, 3}, {0}),
        ("two veer by 1e-8", oscillators([1, 1], [0.5, -0.5], 1e-8), {1, 2}, {0}),
        ("two coincide all along", oscillators([1, 1, 2], [0.5, 0.5, 0.1]), {1}, {0}),
        ("a mode passes through infinity", THROUGH_INFINITY_ONCE, {1, 2}, {0, 1}),
        ("two modes pass through infinity", THROUGH_INFINITY_TWICE, {1, 2}, {0, 1}),
        ("the path turns back", PUSHED_PENDULUM, {1, 2}, {0}),
        ("the path turns back closely followed", edited(PUSHED_PENDULUM, "1e-2", "1e-10"), {1, 2}, {0}),
        ("random matrices of four", random_family(4, 3), {1, 2}, {0}),
        ("random matrices of six", random_family(6, 1), {1, 2}, {0})]


class AgainstEval(ProgramTest):
    def compare(self, scene, places=200):
        self.write("scene.toml", scene)
        self.run_well("trace", "scene.toml", "-o", "loci.h5", "--quiet")
        loci = eigentrail.open(self.folder / "loci.h5")
        parameter = loci.eigentrail.parameter
        path = loci[parameter].values
        values = np.concatenate([np.random.default_rng(1).uniform(path.min(), path.max(), places), path])
        found = loci.eigentrail.sel(**{parameter: values})
        printed = list(csv.DictReader(io.StringIO(
            self.run_well("eval", "loci.h5", "--csv", "--at", *map(repr, map(float, values))))))
        for name, columns in (("eigenvalue", ("real", "imag")), ("natural_frequency", ("natural_frequency",)),
                              ("damped_frequency", ("damped_frequency",))):
            ours = self.rows(found[name], parameter)
            theirs = [(float(row["parameter"]), row["mode"], complex(*(float(row[column]) for column in columns))) for row in printed]
            self.assertEqual(len(ours), len(theirs))
            self.assertEqual([pair for pair in zip(ours, theirs) if pair[0] != pair[1]], [])
        return loci

    @staticmethod
    def rows(found, parameter):
        """Value, mode and what is found there, in the order in which `eval` prints them."""
        if "passage" in found.dims:
            found = found.transpose(parameter, "passage", "mode")
        flat = found.values.reshape(found.sizes[parameter], -1)
        modes = np.tile(found.mode.values, flat.shape[1] // found.sizes["mode"])
        return [(value, mode, s) for value, row in zip(found[parameter].values, flat)
                for mode, s in zip(modes, row) if not np.isnan(s)]


@each_case([(path.stem, path) for path in sorted(SCENES.glob("*.toml"))])
class Scenes(AgainstEval):
    def check(self, path):
        for table in path.parent.glob("*.csv"):  # that scenes name
            shutil.copy(table, self.folder)
        self.compare(path.read_text(encoding="utf-8"))


@each_case(HARD)
class HardOnes(AgainstEval):
    def check(self, scene, sizes, charts):
        loci = self.compare(scene)
        functions = {int(count) for row in loci.dense_block.values
                     for count in np.unique(row[row >= 0], return_counts=True)[1]}
        self.assertEqual({count if count < 3 else round(count**0.5) for count in functions}, sizes)
        self.assertEqual(set(loci.dense_chart.values.ravel().tolist()) - {-1}, charts)


class InMemory(AgainstEval):
    """Datasets that were opened or changed without the package."""

    def setUp(self):
        super().setUp()
        self.loci = self.compare(coalescing(3), places=1)
        self.values = np.linspace(*self.loci.p.values[[0, -1]], 50)
        self.found = self.loci.eigentrail.sel(p=self.values)

    def test_what_xarray_opens_is_evaluated(self):
        plain = xarray.load_dataset(self.folder / "loci.h5", engine="h5netcdf")
        changed = plain.assign(eigenvalue=plain.eigenvalue.astype("complex256"), certified=plain.certified.astype(float),
                               natural_frequency=plain.frequency)
        for name in ("eigenvalue", "certified"):
            np.testing.assert_array_equal(changed.eigentrail.sel(p=self.values)[name], self.found[name])

    def test_some_of_the_modes_of_a_block(self):
        some = self.loci.isel(mode=[2, 0]).eigentrail.sel(p=self.values)
        np.testing.assert_array_equal(some.eigenvalue, self.found.eigenvalue[:, [2, 0]])

    def test_what_does_not_fit_is_named(self):
        for name, change in (("dense_output", {"node": slice(0, 3)}), ("step_length", {})):
            loci = self.loci.isel(change)
            if not change:
                loci["step_length"] = loci.step_length * np.nan
            with self.assertRaisesRegex(eigentrail.SceneError, f"the Dataset: {name} "):
                loci.eigentrail.sel(p=self.values)


class TurningBack(AgainstEval):
    """sin(angle) = p: hanging on the way to p = 1, standing on the way back."""

    def setUp(self):
        super().setUp()
        self.loci = self.compare(edited(PUSHED_PENDULUM, "1e-2", "1e-8"), places=10)

    def test_both_passages_are_there_in_the_order_of_the_path(self):
        s = self.loci.eigentrail.sel(p=[0.3, 0.6, 0.9]).eigenvalue.transpose("passage", "p", "mode")
        self.assertEqual(s.shape, (2, 3, 2))
        # Times abs(s)^2 / g: cos(angle), of the hanging one as a pair, of the standing one as two real eigenvalues.
        cosine = np.sqrt(1.0 - s.p.values**2)
        np.testing.assert_allclose(s.isel(passage=0, mode=0), 1j * np.sqrt(9.81 * cosine), rtol=1e-6)
        standing = np.sort(s.isel(passage=1).real.values)
        np.testing.assert_allclose(standing, np.sqrt(9.81 * cosine)[:, np.newaxis] * [-1, 1], rtol=1e-6)

    def test_the_fold_is_passed_once(self):
        at_fold = self.loci.eigentrail.sel(p=self.loci.event_parameter.values)
        self.assertEqual(at_fold.sizes["passage"], 1)


if __name__ == "__main__":
    unittest.main()
