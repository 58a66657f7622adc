"""The report in a real browser: it draws the eigenvalues of `eval` and reacts to mouse and keyboard."""

import time
import unittest

import h5py
import numpy as np
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

import browser
from command_test import HOSTILE
from large_file import enlarge
from page_test_case import CUT, SCREENSHOTS, PageTest
from program import BIRTH, BLADE, SCENES

ON_THE_LINE = 1e-6  # of the axis' range
HERTZ = 2.0 * np.pi  # rad/s: the unit in which frequencies are shown if the parameter is no speed


class Page(PageTest):
    def test_errors_of_samples_are_drawn_with_a_key(self):
        p = np.linspace(0.0, 1.0, 8)
        with h5py.File(self.folder / "samples.h5", "w") as file:
            file["parameter"] = p
            file["A"] = [[[0.05 * (x - 0.4), 1, 0], [-1, 0.05 * (x - 0.4), 0], [0, 0, -3]] for x in p]
            file["A_error"] = np.broadcast_to(np.diag([0.002, 0.002, 0.0]), (8, 3, 3))
            file["state_names"] = ["swing", "rate", "filter"]
        self.trace('[sampled_family]\nfile = "samples.h5"\n[trace]\nparameter = "p"\nfrom = 0\nto = 1\n')
        self.show("loci.h5", picture="errors_of_samples")
        with h5py.File(self.folder / "loci.h5") as file:
            low, high = file["event_interval"][0]
            error = (file["interpolation_error"][0, 0] + file["digits_error"][0, 0])
        drawn = """const data = document.querySelector('.campbell').data, axis = arguments[0];
            const bars = data.find((t) => t.meta && t.meta.intervals && t.yaxis === axis);
            const band = data.find((t) => t.meta && t.meta.band === 0 && t.yaxis === axis);
            return [bars.x.slice(0, 2), Math.max(...band.y), Math.min(...band.y)];"""
        bar, top, bottom = self.driver.execute_script(drawn, "y")
        np.testing.assert_allclose(bar, [low, high])
        self.assertAlmostEqual(HERTZ * top - 1.0, error, 3)
        self.assertAlmostEqual(1.0 - HERTZ * bottom, error, 3)
        key = self.driver.find_element(By.CSS_SELECTOR, ".key").text
        self.assertIn("undecided: the errors of the data leave it open", key)
        self.assertIn("bands and bars: errors of the data", key)
        self.assertIn("mode 1, swing", self.driver.page_source)

    def test_lines_are_where_eval_says(self):
        self.same_blade()
        for mode in range(2):
            frequency, damping = self.lines(mode), self.lines(mode, "y2")
            for points, value in ((frequency, lambda s: s.imag), (damping, lambda s: -s.real / np.abs(s))):
                expected = value(self.eval_at("loci.h5", points[:, 0])[:, mode])
                self.assertGreater(len(points), 20)
                self.assertLess(np.max(np.abs(points[:, 1] - expected)), ON_THE_LINE * max(np.ptp(expected), 1e-9))

    def test_chords_follow_the_curve_where_stored_points_do_not(self):
        self.trace((SCENES / "hinged_blade.toml").read_text(encoding="utf-8"))
        self.show("loci.h5")
        torsion = 2
        pixels = self.driver.execute_script("const { yaxis } = document.querySelector('.campbell')._fullLayout;"
                                            "return yaxis._length / (yaxis.range[1] - yaxis.range[0])")

        def corner(points):
            middle = 0.5 * (points[1:] + points[:-1])
            return np.max(np.abs(middle[:, 1] - self.eval_at("loci.h5", middle[:, 0])[:, torsion].imag)) * pixels

        self.assertLess(corner(self.lines(torsion)), 0.5)
        with h5py.File(self.folder / "loci.h5") as file:
            stored = np.column_stack([file["omega"], file["eigenvalue"][:, torsion].imag])
        self.assertGreater(corner(stored), 0.5)

    def test_lines_are_drawn_anew_for_a_smaller_window(self):
        self.blade()
        self.driver.execute_script("return Plotly.relayout(document.querySelector('.campbell'), { 'xaxis.range': [5, 8], 'yaxis.range': [1, 6] })")
        points = self.lines(0)
        inside = points[(points[:, 0] > 5) & (points[:, 0] < 8)]
        self.assertGreater(len(inside), 20)
        expected = self.eval_at("loci.h5", inside[:, 0])[:, 0].imag
        self.assertLess(np.max(np.abs(inside[:, 1] - expected)), ON_THE_LINE * 100.0)

    def test_pointer_on_a_line_shows_its_mode(self):
        self.same_blade()
        s = self.eval_at("loci.h5", [60.0])[0]
        self.pointer_to(60.0, s[1].imag).perform()
        tip = self.driver.find_element(By.CSS_SELECTOR, ".campbell .tip")
        self.assertTrue(tip.is_displayed())
        self.assertIn("mode 2", tip.text)
        self.assertIn("omega = ", tip.text)
        shown = float(tip.text.split("Im s = ")[1].split()[0])
        self.assertLess(abs(shown - s[1].imag), 0.5)  # half a pixel is 0.1 rad/s

    def test_click_on_a_line_isolates_it_and_releases_it(self):
        self.same_blade()
        lag = self.eval_at("loci.h5", [60.0])[0][0].imag
        self.assertEqual(self.isolated(), [0, 1])
        self.pointer_to(60.0, lag).click().perform()
        self.assertEqual(self.isolated(), [0])
        browser.screenshot(self.driver, SCREENSHOTS / "blade_isolated.png")
        self.pointer_to(60.0, lag).click().perform()
        self.assertEqual(self.isolated(), [0, 1])

    def test_keyboard_isolates_and_releases(self):
        self.same_blade()
        button = self.driver.find_elements(By.CSS_SELECTOR, "tbody button[aria-pressed]")[1]
        button.send_keys(Keys.ENTER)
        self.assertEqual((self.isolated(), button.get_attribute("aria-pressed")), ([1], "true"))
        button.send_keys(Keys.SPACE)
        self.assertEqual((self.isolated(), button.get_attribute("aria-pressed")), ([0, 1], "false"))

    def test_units_scale_frequencies(self):
        self.blade()
        before = self.lines(1)
        for unit, factor in (("Hz", 0.5 / np.pi), ("rpm", 30.0 / np.pi)):
            Select(self.driver.find_elements(By.CSS_SELECTOR, ".controls select")[1]).select_by_value(unit)
            after = self.lines(1)
            at = np.interp(after[:, 0][np.argsort(after[:, 0])], before[:, 0][np.argsort(before[:, 0])], before[:, 1][np.argsort(before[:, 0])])
            np.testing.assert_allclose(after[:, 1][np.argsort(after[:, 0])], factor * at, rtol=1e-2)
            title = self.driver.execute_script("return document.querySelector('.campbell').layout.yaxis.title.text")
            self.assertEqual(title, f"damped frequency Im s, {unit}")

    def test_harmonics_are_rays_of_the_excitation(self):
        self.blade()
        field = self.driver.find_element(By.CSS_SELECTOR, "input[aria-label^=harmonics]")
        field.send_keys(Keys.CONTROL, "a", Keys.NULL, "2.5", Keys.TAB)
        rays = self.driver.execute_script("return document.querySelector('.campbell').data.filter((t) => t.meta && t.meta.harmonic)"
                                          ".map((t) => [t.meta.harmonic, t.x[0], t.y[0]])")
        self.assertEqual(rays, [[2.5, 5.0, 12.5]])

    def test_typed_value_of_the_parameter_fills_the_table(self):
        self.same_blade()
        field = self.driver.find_element(By.CSS_SELECTOR, ".place input[type=text]")
        field.send_keys(Keys.CONTROL, "a", Keys.NULL, "33.3", Keys.ENTER)
        s = self.eval_at("loci.h5", [33.3])[0]
        rows = [row.text for row in self.driver.find_elements(By.CSS_SELECTOR, "[aria-label=Modes] tbody tr")]
        for row, value in zip(rows, s):
            self.assertIn(f"{value.imag:.6g}"[:6], row)

    def test_every_event_is_marked_and_in_the_table(self):
        self.same_blade()
        with h5py.File(self.folder / "loci.h5") as file:
            places = sorted(file["event_parameter"])
        marked = self.driver.execute_script("return document.querySelector('.campbell').data.filter((t) => t.legendgroup && t.yaxis === 'y').flatMap((t) => t.x)")
        self.assertEqual(sorted(marked), places)
        self.assertEqual(len(self.driver.find_elements(By.CSS_SELECTOR, "[aria-label=Events] tbody tr")), len(places))

    def test_stretch_that_is_not_certified_has_a_band(self):
        bands = "return document.querySelector('.campbell').data.filter((t) => t.meta && t.meta.doubtful).map((t) => [t.line.width, t.x[0], t.x[t.x.length - 1]])"
        for options, expected in (((), []), (("--no-certify",), [[9, 100.0, 5.0]] * 2)):
            self.trace(BLADE, *options)
            self.show("loci.h5")
            self.assertEqual(self.driver.execute_script(bands), expected)
            (self.folder / "loci.h5").unlink()

    def test_shape_is_painted_and_follows_the_mode(self):
        self.same_blade()
        canvas = "const c = document.querySelector('canvas'); return c.toDataURL()"
        Select(self.driver.find_element(By.CSS_SELECTOR, ".shape select")).select_by_value("0")
        first = self.driver.execute_script(canvas)
        Select(self.driver.find_element(By.CSS_SELECTOR, ".shape select")).select_by_value("1")
        self.assertNotEqual(self.driver.execute_script(canvas), first)

    def test_texts_of_a_file_stay_texts(self):
        self.trace(BLADE)
        with h5py.File(self.folder / "loci.h5", "r+") as file:
            file.attrs["title"] = file.attrs["scene"] = file.attrs["notes"] = HOSTILE
            for name in ("mode", "mode_name"):
                file[name][...] = [HOSTILE] * len(file[name])
        self.show("loci.h5")
        self.assertEqual(self.driver.find_element(By.TAG_NAME, "h1").text, HOSTILE)
        self.assertEqual(self.driver.find_elements(By.CSS_SELECTOR, "img, main script"), [])

    def test_two_traces_share_the_figures(self):
        self.trace(BLADE)
        self.trace(BLADE.replace("drag   = 2.0", "drag   = 400.0"), output="more_drag.h5")
        self.show("loci.h5", "more_drag.h5", picture="comparison")
        self.assertEqual(self.driver.execute_script(CUT), [])
        colours = self.driver.execute_script("return document.querySelector('.campbell').data.filter((t) => t.meta && 'mode' in t.meta).map((t) => [t.meta.file, t.line.color])")
        self.assertEqual(len({tuple(pair) for pair in colours}), 2)

    def test_large_file_opens(self):
        self.trace(BIRTH)
        enlarge(self.folder / "loci.h5")
        begin = time.perf_counter()
        self.show("loci.h5")
        print(f"2000 points x 100 modes: written and drawn in {time.perf_counter() - begin:.1f} s, page of "
              f"{(self.folder / 'page.html').stat().st_size / 1e6:.1f} MB, loaded in "
              f"{self.driver.execute_script('return performance.timing.loadEventEnd - performance.timing.navigationStart') / 1e3:.1f} s")
        browser.screenshot(self.driver, SCREENSHOTS / "large.png")
        drawn = "return [...new Set(document.querySelector('.campbell').data.filter((t) => t.meta && t.yaxis === 'y' && t.x.some((x) => x !== null)).map((t) => t.meta.mode))]"
        self.assertEqual(set(range(100)) - set(self.driver.execute_script(drawn)), set())


if __name__ == "__main__":
    unittest.main()
