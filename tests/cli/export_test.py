"""`eigentrail export`: tables that agree with h5py and with `eval`."""

import csv
import json
import math
import unittest

import numpy as np

from command_test_case import CommandTest
from program import BIRTH, BLADE, PUSHED_PENDULUM, SCENES, edited


class Export(CommandTest):
    def table(self, path):
        with open(self.folder / path, newline="") as file:
            return list(csv.DictReader(file))

    def column(self, rows, name):
        return np.array([float(row[name]) if row[name] else math.nan for row in rows])

    def exported(self, *options, output="tables"):
        self.run_well("export", "loci.h5", "-o", output, *options)
        return self.folder / output

    def test_loci_are_those_of_the_file(self):
        self.trace(BIRTH)
        self.exported("--csv")
        rows = self.table("tables/loci.csv")
        with self.open("loci.h5") as file:
            s, p = file["eigenvalue"][()], file["p"][()]
            certified = file["certified"][()]
        place, mode = self.column(rows, "place").astype(int), self.column(rows, "mode").astype(int) - 1
        self.assertEqual(len(rows), np.isfinite(s).sum())
        found = self.column(rows, "real") + 1j * self.column(rows, "imag")
        np.testing.assert_array_equal(found, s[place, mode])
        np.testing.assert_array_equal(self.column(rows, "p"), p[place])
        np.testing.assert_allclose(self.column(rows, "natural_frequency"), np.abs(found), rtol=1e-15)
        np.testing.assert_array_equal(self.column(rows, "damped_frequency"), np.abs(found.imag))
        np.testing.assert_allclose(self.column(rows, "damping_ratio"), -found.real / np.abs(found), rtol=1e-15)
        with np.errstate(divide="ignore"):
            decrement = np.where(found.imag != 0, -2 * np.pi * found.real / np.abs(found.imag), np.nan)
        np.testing.assert_allclose(self.column(rows, "log_decrement"), decrement, rtol=1e-14)
        step = np.maximum(place - 1, 0)
        behind = np.minimum(step + 1, len(certified) - 1)
        here = certified[step, mode]
        np.testing.assert_array_equal(self.column(rows, "certified"), np.where(here == -1, certified[behind, mode], here))

    def test_points_are_those_of_eval(self):
        self.trace(edited(PUSHED_PENDULUM, "1e-2", "1e-8"))
        self.exported("--points", "7", output="dense.csv")
        rows = self.table("dense.csv")
        values = np.unique(self.column(rows, "p"))
        self.assertEqual(len(values), 7)
        expected = self.eval_rows("loci.h5", values)  # both passages at the values before the fold
        self.assertEqual(len(rows), len(expected))
        for row, (p, mode, s) in zip(rows, expected):
            found = complex(float(row["real"]), float(row["imag"]))
            self.assertEqual((float(row["p"]), "mode " + row["mode"], found), (p, mode, s))
        self.assertGreater(len({row["place"] for row in rows}), 7)

    def test_events_have_all_columns(self):
        self.run_well("trace", SCENES / "rotating_mass.toml", "-o", "loci.h5", "--quiet")
        self.exported()
        (row,) = self.table("tables/events.csv")
        with self.open("loci.h5") as file:
            self.assertEqual(row["kind"], "flutter")
            self.assertEqual(float(row["omega"]), file["event_parameter"][0])
            self.assertEqual(complex(float(row["real"]), float(row["imag"])), file["event_eigenvalue"][0])
            self.assertEqual((row["modes"], int(row["direction"]), row["value"]), ("1", file["event_direction"][0], ""))
            for q, name in enumerate(file["scene_parameter"].asstr()):
                sensitivity = complex(float(row[f"sensitivity_{name}_real"]), float(row[f"sensitivity_{name}_imag"]))
                self.assertEqual(sensitivity, file["event_sensitivity"][0, q])
                shift = float(row[f"shift_{name}"]) if row[f"shift_{name}"] else math.nan
                np.testing.assert_equal(shift, file["event_shift"][0, q])

    def test_ranges_and_shapes(self):
        self.run_well("trace", SCENES / "rotating_mass.toml", "-o", "loci.h5", "--quiet")
        self.exported()
        (row,) = self.table("tables/stable_ranges.csv")
        shapes = self.table("tables/mode_shapes.csv")
        with self.open("loci.h5") as file:
            self.assertEqual((float(row["from"]), float(row["to"])), (file["stable_from"][0], file["stable_to"][0]))
            self.assertEqual((row["cause_from"], row["cause_to"], row["mode_to"]), ("start", "flutter", "1"))
            z = self.column(shapes, "real") + 1j * self.column(shapes, "imag")
            np.testing.assert_array_equal(z.reshape(file["mode_shape"].shape), file["mode_shape"][()])
            self.assertEqual([one["coordinate"] for one in shapes[:3]], list(file["coordinate"].asstr()))

    def test_sampled_families_have_their_errors(self):
        self.run_well("import", "numpy", SCENES.parent / "linearizations" / "iea15.npz", "-o", "floater", "--unit", "m/s",
                      "--digits", "4")
        self.run_well("trace", "floater/iea15.toml", "-o", "loci.h5", "--quiet", "--modes",
                      "band = ['0.005 Hz', '0.06 Hz'], damping_below = 0.2")
        self.exported("--no-shapes")
        self.assertFalse((self.folder / "tables" / "mode_shapes.csv").exists())
        rows = self.table("tables/loci.csv")
        with self.open("loci.h5") as file:
            step = np.maximum(self.column(rows, "place").astype(int) - 1, 0)
            mode = self.column(rows, "mode").astype(int) - 1
            for name in ("interpolation_error", "digits_error"):
                np.testing.assert_array_equal(self.column(rows, name), file[name][()][step, mode])
            events = self.table("tables/events.csv")
            intervals = np.column_stack([self.column(events, f"interval_{end}") for end in ("from", "to")])
            np.testing.assert_array_equal(intervals, file["event_interval"][()])

    def test_json_has_the_same_tables(self):
        self.trace(BLADE)
        self.exported()
        self.run_well("export", "loci.h5", "--json")
        data = json.loads((self.folder / "loci.json").read_text())
        self.assertEqual((data["format"], data["parameter"], data["unit"]), ("eigentrail-export", "omega", "rad/s"))
        for name in ("loci", "events", "stable_ranges", "mode_shapes"):
            rows = self.table(f"tables/{name}.csv")
            self.assertEqual(len(data[name]), len(rows))
            for one, row in zip(data[name], rows):
                self.assertEqual({key: "" if value is None else value if isinstance(value, str) else float(value)
                                  for key, value in one.items()},
                                 {key: value if isinstance(one[key], str) or not value else float(value)
                                  for key, value in row.items()})
        self.assertIsInstance(data["loci"][0]["mode"], int)

    def test_other_files_are_protected(self):
        self.trace(BLADE)
        self.exported()
        self.assert_refused(self.run_program("export", "loci.h5", "-o", "tables"), ["exists already", "--force"])
        self.exported("--force")
        self.write("notes.csv", "a,b\n1,2\n")
        self.assert_refused(self.run_program("export", "loci.h5", "-o", "notes.csv", "--force"), ["no readable export"])
        self.assert_refused(self.run_program("export", "loci.h5", "-o", "loci.h5", "--force"), ["loci.h5"])
        self.assert_refused(self.run_program("export", "loci.h5", "--points", "1"), ["--points 1", "two or more"])
        self.assert_refused(self.run_program("export", "loci.h5", "--json", "-o", "x.csv"), [".json"])
        self.assert_refused(self.run_program("export", "nothing.h5"), ["nothing.h5"])


if __name__ == "__main__":
    unittest.main()
