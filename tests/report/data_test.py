"""The data in a report: they agree with `eval`, contain the steps that are not certified, and are limited in size."""

import unittest

import h5py
import numpy as np

from command_test_case import CommandTest
from large_file import enlarge
from program import BIRTH, BLADE, CROSSING, FAMILY, PUSHED_PENDULUM, edited
from rotor_files import add_whirl
from report_page import eigenvalue, numbers, page_data, parameter

# What the page promises, of the range of the real and the imaginary parts; `closeness` in it says more.
AGREEMENT = 1e-6
LARGEST_PAGE = 15e6


class ReportData(CommandTest):
    def report(self, *files, output="page.html"):
        self.run_well("report", *files, "-o", output, "--quiet")
        return page_data(self.folder / output)["files"]

    def check(self, scene, places, *options, turns_back=False):
        """The page and eval agree at all places of the path."""
        self.trace(scene, *options)
        file, = self.report("loci.h5")
        curves = file["curves"]
        length = numbers(curves["nodes"]["place"], "<f8")[-1]
        where = length * np.linspace(0.0, 1.0, places + 2)[1:-1]
        labels = [mode["label"] for mode in file["modes"]]
        there, found, expected = [parameter(curves, place) for place in where], [], []
        rows = self.eval_rows("loci.h5", there)
        self.assertEqual({p for p, _, _ in rows}, set(there))
        for place, p in zip(where, there):
            for mode, label in enumerate(labels):
                s = eigenvalue(curves, mode, place)
                candidates = [value for at, name, value in rows if (at, name) == (p, label)]
                # Where the path turns back eval tells all passages, the page the one at this place.
                self.assertTrue(candidates or s is None, (p, mode))
                self.assertTrue(s is not None or not candidates or turns_back, (p, mode))
                if s is not None:
                    found.append(s)
                    expected.append(min(candidates, key=lambda value, s=s: abs(value - s)))
        found, expected = np.array(found), np.array(expected)
        for part in (np.real, np.imag):
            size = max(np.ptp(part(expected)), 1e-12 * np.max(np.abs(expected)))
            self.assertLess(np.max(np.abs(part(found) - part(expected))), AGREEMENT * size)

    def test_single_modes_agree_with_eval(self):
        self.check(BLADE, 101, "--tolerance", "1e-8")

    def test_pair_that_becomes_two_real_modes_agrees_with_eval(self):
        self.check(BIRTH, 101)

    def test_modes_that_cross_agree_with_eval(self):
        self.check(CROSSING, 101)

    def test_path_that_turns_back_agrees_with_eval(self):
        self.check(edited(PUSHED_PENDULUM, "tolerance = 1e-2", "tolerance = 1e-8"), 101, turns_back=True)

    def test_mode_through_infinity_has_a_gap(self):
        scene = edited(FAMILY, "M = [[[1, 0], [0, 1]]]", "M = [[[1, 0], [0, -0.5]], [[0, 0], [0, 1]]]\nC = [[[0.1, 0], [0, 1]]]")
        self.trace(edited(scene, "K = [[[1, 0], [0, 2]], [[0, 1], [1, 0]]]", "K = [[[1, 0], [0, 2]]]"))
        file, = self.report("loci.h5")
        self.assertTrue(any(len(mode) > 1 for mode in file["curves"]["modes"]))

    def test_stretches_that_are_not_certified_are_told(self):
        self.trace(BLADE, "--no-certify")
        file, = self.report("loci.h5")
        n = len(numbers(file["curves"]["nodes"]["place"], "<f8"))
        self.assertEqual([mode["uncertified"] for mode in file["modes"]], [[[0, n - 1]]] * 2)
        self.assertEqual([mode["certified"] for mode in file["modes"]], [0.0, 0.0])

    def test_events_and_ranges_are_those_of_the_file(self):
        self.trace(BIRTH)
        file, = self.report("loci.h5")
        with h5py.File(self.folder / "loci.h5") as loci:
            self.assertEqual([event["parameter"] for event in file["events"]], list(loci["event_parameter"]))
            self.assertEqual([stable["to"]["parameter"] for stable in file["ranges"]], list(loci["stable_to"]))

    def test_rays_are_there_for_a_parameter_that_is_a_speed(self):
        self.trace(BLADE)
        with_speed, = self.report("loci.h5")
        self.assertEqual((with_speed["excitation"]["parameter"][0], with_speed["excitation"]["frequency"][0]), (5.0, 5.0))
        self.trace(BIRTH, output="birth.h5")
        without, = self.report("birth.h5", output="birth.html")
        self.assertIsNone(without["excitation"])

    def test_figure_connects_what_the_scene_connects(self):
        self.trace(BLADE)
        geometry = self.report("loci.h5")[0]["shapes"]["geometry"]
        self.assertEqual([carrier["name"] for carrier in geometry["carriers"]], ["blade"])
        line, = geometry["lines"]
        self.assertEqual((line["kind"], geometry["places"][line["from"]]["at"], geometry["places"][line["to"]]["carrier"]),
                         ("rod", [[1.0, 0.0, 0.0]], 0))

    ROTOR = """
[parameters]
speed = { value = 3000, unit = "rpm" }
[trace]
parameter = "speed"
from = 100
to = 9000
modes = 4
[[shaft]]
stations = { length = [0.4, 0.6], outer = 0.05 }
elements = ELEMENTS
position = 0.1
E = 2.1e11
nu = 0.3
density = 7850
speed = "speed"
[[bearing]]
node = 2
kxx = 1e7
cxx = 100
[[support]]
node = 1
"""

    def test_figure_of_a_rotor_is_its_shaft(self):
        """Nodes along z, joined by lines, with displacements x and y; the same of a rotor that was projected."""
        for elements in (2, 25):
            self.trace(self.ROTOR.replace("ELEMENTS", str(elements)), "--force")
            shapes = self.report("loci.h5", output=f"{elements}.html")[0]["shapes"]
            nodes = 2 * elements + 1
            geometry, n = shapes["geometry"], shapes["coordinates"]
            self.assertEqual(([carrier["name"] for carrier in geometry["carriers"]][-1], n), (f"node {nodes}", 3 * nodes))
            self.assertEqual([(line["from"], line["to"]) for line in geometry["lines"]], [(i, i + 1) for i in range(nodes - 1)])
            rest = numbers(shapes["equilibrium"], "<f4").reshape(-1, nodes, 3)
            np.testing.assert_allclose(rest[0, [0, elements, -1]], [[0, 0, 0.1], [0, 0, 0.5], [0, 0, 1.1]], rtol=1e-6)
            parts = numbers(shapes["shapes"], "<i2").reshape(len(rest), 4, nodes, 3, 2) / 32767.0
            np.testing.assert_array_equal(parts[:, :, 0], 0.0)  # the pin
            with h5py.File(self.folder / "loci.h5") as loci:
                shape = loci["mode_shape"][-1, 0]
                if "projection_basis" in loci:
                    shape = loci["projection_basis"][:] @ shape
                where = loci["shaft_coordinate"][:]
                moved = np.where(where < 0, 0.0, shape[where])
            np.testing.assert_allclose(parts[-1, 0, :, :2, 0] + 1j * parts[-1, 0, :, :2, 1], moved / np.abs(moved).max(), atol=1e-4)

    def test_page_of_a_large_file_is_small_and_exact(self):
        self.trace(BIRTH)
        enlarge(self.folder / "loci.h5")
        file, = self.report("loci.h5")
        self.assertLess((self.folder / "page.html").stat().st_size, LARGEST_PAGE)
        places = np.linspace(0.0, 1.0, 41)
        expected = self.eval_at("loci.h5", places)
        found = np.array([[eigenvalue(file["curves"], mode, p) for mode in range(0, 100, 9)] for p in places])
        np.testing.assert_allclose(found, expected[:, ::9], rtol=0.0, atol=6.0 * AGREEMENT)

    def test_frequencies_are_in_the_unit_of_the_speed(self):
        for old, unit, factor in (("", "rad/s", 1.0), ("rad/s", "rpm", np.pi / 30.0), ("rad/s", "Hz", 2.0 * np.pi)):
            self.trace(BLADE.replace('"rad/s"', f'"{unit}"') if old else BLADE)
            file, = self.report("loci.h5")
            self.assertEqual(file["frequency_unit"]["name"], unit)
            self.assertAlmostEqual(file["frequency_unit"]["factor"], factor)
            (self.folder / "loci.h5").unlink()
            (self.folder / "page.html").unlink()
        self.trace(FAMILY)
        file, = self.report("loci.h5")
        self.assertEqual(file["frequency_unit"]["name"], "Hz")

    def test_operating_ranges_and_whirl_are_in_the_page(self):
        self.trace(BLADE + "\n[events]\nharmonics = 1\noperating_range = [[20, 30], [50, 60]]\nseparation_margin = 0.1\n")
        with h5py.File(self.folder / "loci.h5") as file:
            self.assertEqual((file.attrs["operating_range"], file.attrs["separation_margin"]), ("20 to 30, 50 to 60", "0.1"))
        file, = self.report("loci.h5")
        self.assertEqual(file["excitation"]["operating"], {"ranges": [[20, 30], [50, 60]], "margin": 0.1})
        self.assertIsNone(file["whirl"])
        (self.folder / "page.html").unlink()
        add_whirl(self.folder / "loci.h5")
        file, = self.report("loci.h5")
        with h5py.File(self.folder / "loci.h5") as stored:
            np.testing.assert_allclose(numbers(file["whirl"]["measure"], "<f4"), stored["whirl"][()].ravel(), rtol=1e-7)


if __name__ == "__main__":
    unittest.main()
