"""The Campbell diagram in a browser: units, rays and critical speeds, whirl, separation margins, and labels and tables that can be read."""

import re
import unittest

import h5py
import numpy as np
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

import browser
from page_test_case import CUT, PageTest
from program import SCENES, edited
from rotor_files import WING, add_whirl, rotor

DISC = (SCENES / "overhung_disc.toml").read_text(encoding="utf-8")
ROTOR_EVENTS = "[events]\nharmonics = [1, 2]\noperating_range = [5000, 7000]\n"
AGREEMENT = 1e-6  # of the page's curves with those of the file, relative

# The boxes of all texts that a figure has on its marks and lines: [text, left, right, top, bottom].
TEXTS = """
return [...document.querySelectorAll(arguments[0] + ' .textpoint text')].filter((node) => node.textContent.trim()).map((node) => {
  const box = node.getBoundingClientRect();
  return [node.textContent.trim(), box.left, box.right, box.top, box.bottom];
});
"""
LAYOUT = "const layout = document.querySelector(arguments[0])._fullLayout; return "
# Font boxes are taller than what is drawn: lines 13 px apart have boxes of 14 px.
FONT_SLACK = 2.0


def overlaps(boxes):
    """Pairs of texts whose boxes have a point in common."""
    return [(a[0], b[0]) for i, a in enumerate(boxes) for b in boxes[i + 1:]
            if min(a[2], b[2]) - max(a[1], b[1]) > 0.5 and min(a[4], b[4]) - max(a[3], b[3]) > FONT_SLACK]


def kinds(file):
    """The kinds of the events of an open loci file."""
    return np.array([text.split(",")[0] for text in file["events"].asstr()[()]])


class Campbell(PageTest):
    def layout(self, expression, figure=".campbell"):
        return self.driver.execute_script(LAYOUT + expression, figure)

    def control(self, label):
        return self.driver.find_element(By.XPATH, f"//div[@class='controls']//label[contains(., '{label}')]//*[self::input or self::select]")

    def type(self, label, text):
        self.control(label).send_keys(Keys.CONTROL, "a", Keys.NULL, text, Keys.TAB)

    def rows(self, table):
        return self.driver.execute_script(f"""return [...document.querySelectorAll("[aria-label='{table}'] tbody tr")]
            .map((row) => [...row.querySelectorAll("td")].map((cell) => cell.innerText))""")

    def disc(self):
        self.trace(edited(DISC, 'excitation = "omega"', ""))
        self.show("loci.h5")

    def assert_readable(self, picture, *files):
        """On a desktop and a phone: texts apart, no table cut, nothing wider than the page."""
        self.run_well("report", *files, "-o", "page.html", "--force", "--quiet")
        for size, name in ((browser.DESKTOP, "desktop"), (browser.PHONE, "phone")):
            with self.subTest(picture, size=name):
                self.open_page(size=size, picture=f"{picture}_{name}")
                for figure in (".campbell", ".locus"):
                    self.assertEqual(overlaps(self.driver.execute_script(TEXTS, figure)), [])
                self.assertEqual(self.driver.execute_script(CUT), [])
                self.assertEqual(self.driver.execute_script("return document.documentElement.scrollWidth"), size[0])
                self.assertEqual(re.findall(r"\d(?:\.\d+)?e-1\d\b", self.driver.execute_script("return document.querySelector('main').innerText")), [])

    def test_opens_in_the_unit_of_the_speed(self):
        self.trace(DISC.replace('value = 300.0, unit = "rad/s"', 'value = 3000, unit = "rpm"').replace("to = 2000.0", "to = 18000"))
        self.show("loci.h5")
        self.assertEqual(self.layout("layout.yaxis.title.text"), "damped frequency Im s, rpm")
        self.assertEqual(self.layout("layout.yaxis.title.text", ".locus"), "Im s, rpm")
        once = "const ray = document.querySelector('.campbell').data.find((t) => t.meta && t.meta.harmonic === 1); return [ray.x, ray.y]"
        np.testing.assert_allclose(*self.driver.execute_script(once), rtol=1e-12, atol=1e-9)

    def test_the_root_locus_follows_the_unit(self):
        self.disc()
        height = "return Math.max(...document.querySelector('.locus').data.flatMap((t) => t.y).filter((y) => y !== null))"
        before = self.driver.execute_script(height)
        Select(self.control("in")).select_by_value("Hz")
        self.assertAlmostEqual(self.driver.execute_script(height) * 2.0 * np.pi / before, 1.0, 12)

    def test_frequencies_end_at_the_highest_ray(self):
        self.disc()
        for harmonics, highest in (("1", 2000.0), ("0.5, 0.25", 1000.0)):
            self.type("Harmonics", harmonics)
            self.assertAlmostEqual(self.layout("layout.yaxis.range")[1], 1.06 * highest)
        self.type("Harmonics", "none")
        with h5py.File(self.folder / "loci.h5") as file:
            self.assertAlmostEqual(self.layout("layout.yaxis.range")[1] / (1.06 * np.max(file["eigenvalue"][()].imag)), 1.0, 6)
        self.type("up to", "1500")
        self.assertEqual(self.layout("layout.yaxis.range")[1], 1500.0)

    def test_rays_that_nobody_asked_for_hide_no_low_modes(self):
        """Modes at 10, 20, ... 50 rad/s, all above 4x at the highest speed: the lowest three remain in sight."""
        stiffness = [[float((10 * (i + 1))**2 * (i == j)) for j in range(5)] for i in range(5)]
        unit = [[float(i == j) for j in range(5)] for i in range(5)]
        self.trace(f"""
            [parameters]
            omega = {{ value = 1, unit = "rad/s" }}
            [trace]
            parameter = "omega"
            from = 0
            to = 2
            [matrix_family]
            M = [{unit}]
            K = [{stiffness}, {unit}]
            """, output="fan.h5")
        self.show("fan.h5")
        third, fastest = np.sqrt(902.0), 2.0
        self.assertAlmostEqual(self.layout("layout.yaxis.range")[1] / (1.06 * third), 1.0, 6)
        self.type("Harmonics", "1, 2")
        self.assertAlmostEqual(self.layout("layout.yaxis.range")[1] / (1.06 * 2.0 * fastest), 1.0, 6)

    def test_logarithmic_frequencies(self):
        self.disc()
        before = self.lines(3)
        self.control("log").click()
        after = self.lines(3)
        expected = np.interp(after[:, 0], before[:, 0], before[:, 1])
        np.testing.assert_allclose(10.0 ** after[:, 1], expected, rtol=1e-3)
        ticks, texts = self.layout("[layout.yaxis.tickvals, layout.yaxis.ticktext]")
        np.testing.assert_allclose(10.0 ** np.array(ticks), list(map(float, texts)), rtol=1e-3)
        self.assertGreater(len(texts), 3)
        x, y = self.driver.execute_script("const ray = document.querySelector('.campbell').data.find((t) => t.meta && t.meta.harmonic === 2); return [ray.x, ray.y]")
        np.testing.assert_allclose(10.0 ** np.array(y[1:]), 2.0 * np.array(x[1:]), rtol=1e-9)
        place = 3.0  # rad/s, where the ray has come to the picture's bottom
        self.assertAlmostEqual(np.interp(place, x, y), np.log10(2.0 * place), 2)

    def test_damping_is_that_of_oscillations_unless_real_roots_are_asked_for(self):
        self.trace(WING, output="wing.h5")
        self.show("wing.h5")
        modes = "return [...new Set(document.querySelector('.campbell').data.filter((t) => t.meta && 'mode' in t.meta && t.yaxis === 'y2').map((t) => t.meta.mode))]"
        with h5py.File(self.folder / "wing.h5") as file:
            s = file["eigenvalue"][()]
        # Where two real roots meet, a step ends on the double root, which is known to the root of rounding.
        oscillating = np.flatnonzero(np.any(np.abs(s.imag) > 1e-4 * np.abs(s), axis=0))
        self.assertEqual(sorted(self.driver.execute_script(modes)), list(oscillating))
        self.assertLess(len(oscillating), s.shape[1])
        self.control("real roots").click()
        self.assertEqual(sorted(self.driver.execute_script(modes)), list(range(s.shape[1])))

    def test_rays_that_are_typed_cross_where_a_trace_finds_resonances(self):
        self.trace(edited(DISC, "harmonics = [1, 2]", "harmonics = [0.5, 3]"), output="asked.h5")
        self.disc()
        self.type("Harmonics", "0.5, 3")
        with h5py.File(self.folder / "asked.h5") as file:
            found = sorted((value, place, s.imag) for kind, value, place, s in
                           zip(kinds(file), file["event_value"][()], file["event_parameter"][()], file["event_eigenvalue"][()]) if kind == "resonance")
        rows = self.rows("Critical speeds")
        self.assertEqual([row[1] for row in rows], [f"{value:g}×" for value, _, _ in found])
        np.testing.assert_allclose([float(row[2]) for row in rows], [place for _, place, _ in found], rtol=AGREEMENT)
        np.testing.assert_allclose([float(row[3]) for row in rows], [frequency for _, _, frequency in found], rtol=1e-5)
        marks = self.driver.execute_script("return document.querySelector('.campbell').data.find((t) => t.meta && t.meta.crossings).x")
        np.testing.assert_allclose(marks, [place for _, place, _ in found], rtol=AGREEMENT)

    def test_critical_speeds_of_an_excitation_that_is_no_straight_line(self):
        self.trace(edited(DISC, 'excitation = "omega"', 'excitation = "omega * (1 + (omega/bend)^3)"').replace("harmonics = [1, 2]", "harmonics = 1")
                   .replace("[parameters]", '[parameters]\nbend = { value = 1500, unit = "rad/s" }'))
        self.show("loci.h5")
        with h5py.File(self.folder / "loci.h5") as file:
            places = file["event_parameter"][kinds(file) == "resonance"]
        np.testing.assert_allclose(sorted(float(row[2]) for row in self.rows("Critical speeds")), sorted(places), rtol=AGREEMENT)

    def test_critical_speeds_too_close_to_an_operating_range_are_marked_as_in_the_summary(self):
        self.write("scene.toml", edited(DISC, 'excitation = "omega"', "operating_range = [400, 520]"))
        summary = self.run_well("trace", "scene.toml", "-o", "loci.h5")
        self.show("loci.h5", picture="separation")
        close = self.driver.find_elements(By.CSS_SELECTOR, "[aria-label='Critical speeds'] tr.close")
        self.assertEqual([row.text.split(" ")[1] for row in close], ["2×"])
        distance, wanted = re.search(r"557\.174: ([\d.]+) % .* ([\d.]+) % wanted", summary).groups()
        self.assertIn(f"{distance} %, {wanted} % wanted", close[0].text)
        self.assertIn("1 too close to an operating range", self.driver.page_source)
        strips = self.layout("layout.shapes.filter((s) => s.fillcolor.startsWith('rgba(196')).map((s) => [s.x0, s.x1])")
        np.testing.assert_allclose(strips, [[400 * (1 - 0.16), 400], [520, 520 * 1.26]])

    def test_backward_whirl_is_dashed_and_told_apart_from_what_is_not_certified(self):
        self.trace(DISC, "--no-certify")
        add_whirl(self.folder / "loci.h5")
        self.show("loci.h5", picture="whirl")
        data = self.driver.execute_script("return document.querySelector('.campbell').data.filter((t) => t.meta && 'mode' in t.meta && t.yaxis === 'y')"
                                          ".map((t) => [t.meta.mode, t.meta.backward, t.line.dash])")
        self.assertEqual({(mode, dash) for mode, backward, dash in data if backward}, {(1, "7px,4px"), (3, "7px,4px")})
        self.assertEqual({dash for _, backward, dash in data if not backward}, {"solid"})
        bands = self.driver.execute_script("return document.querySelector('.campbell').data.filter((t) => t.meta && t.meta.doubtful).map((t) => t.line.dash || 'solid')")
        self.assertEqual(set(bands), {"solid"})
        key = self.driver.find_element(By.CSS_SELECTOR, ".key").text
        for entry in ("backward whirl", "forward whirl", "identity of the mode not certified"):
            self.assertIn(entry, key)

    def test_sixty_modes_are_distinguishable(self):
        self.trace(rotor(30, ROTOR_EVENTS))
        self.assert_readable("rotor", "loci.h5")
        looks = self.driver.execute_script("const view = report.loci[0]; return view.files[0].data.modes.map((_, i) => { const s = view.style(view.files[0], i);"
                                           " return [s.colour, s.symbol, s.dash].join(); })")
        self.assertEqual(len(set(looks)), 60)
        self.assertEqual(self.layout("layout.yaxis.title.text"), "damped frequency Im s, rpm")

    def test_pointing_at_a_line_highlights_it_and_its_row(self):
        self.disc()
        self.pointer_to(1500.0, self.eval_at("loci.h5", [1500.0])[0][2].imag).perform()
        self.assertEqual(len(self.driver.find_elements(By.CSS_SELECTOR, ".campbell .overlay-line")), 1)
        self.assertIn("mode 3", self.driver.find_element(By.CSS_SELECTOR, "tr.pointed").text)
        ActionChains(self.driver).move_to_element(self.driver.find_element(By.TAG_NAME, "h1")).perform()
        self.assertEqual(self.driver.find_elements(By.CSS_SELECTOR, ".overlay-line, tr.pointed"), [])

    def test_rotor_blade_and_wing_can_be_read(self):
        self.trace(edited(DISC, "harmonics = [1, 2]", "harmonics = [1, 2]\noperating_range = [400, 520]"))
        self.assert_readable("disc", "loci.h5")
        self.trace((SCENES / "rotating_mass.toml").read_text(encoding="utf-8"), output="blade.h5")
        self.assert_readable("blade", "blade.h5")
        self.trace(WING, output="wing.h5")
        self.assert_readable("wing", "wing.h5")

    def test_map_boundary_and_study_are_drawn_and_can_be_read(self):
        window = ("--second", "drag", "--second-from", "0.5", "--second-to", "320", "--from", "16", "--quiet")
        self.run_well("map", SCENES / "rotating_mass.toml", *window, "--grid", "10x20", "-o", "map.h5")
        self.run_well("boundary", SCENES / "rotating_mass.toml", *window, "-o", "boundary.h5")
        self.run_well("accuracy", SCENES / "rotating_mass.toml", "--tolerances", "1e-4,1e-6", "--orders", "2,3", "--grids", "25,50", "--repeat", "1",
                      "--samples", "20", "-o", "study.h5", "--quiet")
        self.assert_readable("study", "map.h5", "boundary.h5", "study.h5")
        kinds = self.driver.execute_script("return [...document.querySelectorAll('.chart')].map((chart) => chart.data.map((trace) => trace.type))")
        self.assertIn("heatmap", kinds[0])
        self.assertGreater(len(kinds[1]), 3)


class Scripts(PageTest):
    """Margins and the placing of labels by themselves, in the scripts of any page: that of the first test stays open."""

    random = np.random.default_rng(3)

    def setUp(self):
        super().setUp()
        if not self.driver.execute_script("return Boolean(window.report)"):
            self.trace(DISC)
            self.show("loci.h5")

    def test_margins_are_those_of_the_standard(self):
        margins = self.driver.execute_script("return [2.4, 2.5, 5, 1e9].map((factor) => [apiMargin(factor, true), apiMargin(factor, false)])")
        np.testing.assert_allclose(margins, [[0.0, 0.0], [0.0, 0.10], [0.17 * (1 - 1 / 3.5), 0.10 + 0.17 * (1 - 1 / 3.5)], [0.16, 0.26]], atol=1e-12)

    def test_margins_hold_in_both_senses_of_rotation(self):
        script = """const file = { operating: { ranges: [[400, 520]], margin: null } }, at = (parameter) => ({ file, parameter, s: [0, 1000] });
            return [separationText(at(arguments[0])), marginStrips([file], [at(arguments[0])])];"""
        for speed, words in ((557.2, "7.15 %, 26 % wanted"), (380.0, "5 %, 16 % wanted"), (450.0, "in the operating range")):
            one, other = (self.driver.execute_script(script, value) for value in (speed, -speed))
            self.assertEqual(one[0], words)
            self.assertEqual(one, other)

    def test_labels_beside_marks_lie_apart(self):
        for n in (1, 5, 30, 200):
            points = (self.random.random((n, 2)) * [400, 300]).tolist()
            boxes, marks = self.driver.execute_script("""
                const area = { left: 0, right: 400, top: 0, bottom: 300 }, marks = arguments[0].map(([x, y]) => boxAbout(x, y, 12, 12));
                const labels = arguments[0].map(([x, y], i) => ({ texts: [`resonance E${i + 1}`, `E${i + 1}`], middles: (width) => besideMark(x, y, width) }));
                const placed = placeLabels(labels, [...marks], area);
                const list = (boxes) => boxes.map((b) => ["", b.left, b.right, b.top, b.bottom]);
                return [list(placed.map((label) => label.box)), list(marks)];""", points)
            hits = [1 for i, a in enumerate(boxes) for b in boxes[i + 1:] + marks if a[1] < b[2] and a[2] > b[1] and a[3] < b[4] and a[4] > b[3]]
            self.assertEqual(hits, [])
            self.assertGreaterEqual(len(boxes), min(n, 20))

    def test_labels_keep_off_lines_where_they_can(self):
        place = """const area = { left: 0, right: 200, top: 0, bottom: 200 };
            const [label] = placeLabels([{ texts: ["E1"], middles: (width) => besideMark(100, 100, width) }], [], area, arguments[0]);
            return arguments[0].some((line) => line.some((point, i) => i > 0 && lineMeetsBox(line[i - 1], point, label.box)));"""
        self.assertFalse(self.driver.execute_script(place, [[[0, 88], [200, 88]]]))
        everywhere = [[[0, y], [200, y]] for y in range(0, 200, 8)]
        self.assertTrue(self.driver.execute_script(place, everywhere), "a label on a line is better than none")

    def test_column_of_labels_is_spread_with_least_moves(self):
        def spread(wanted, bottom=100.0):
            return self.driver.execute_script("return spreadLabels(arguments[0], 10, 0, arguments[1])", wanted, bottom)

        self.assertEqual(spread([50, 20, 80]), [50, 20, 80])
        self.assertEqual(spread([50, 50]), [45, 55])
        self.assertEqual(spread([1, 2, 99]), [0, 10, 99])
        self.assertEqual(spread([-40, 140]), [0, 100])
        wanted = self.random.random(8) * 100
        placed = np.array(spread(wanted.tolist()))
        self.assertGreaterEqual(np.min(np.diff(np.sort(placed))), 10 - 1e-9)
        np.testing.assert_array_equal(np.argsort(placed), np.argsort(wanted))

    def test_column_without_room_leaves_out_those_with_near_neighbours(self):
        placed = self.driver.execute_script("return spreadLabels([0, 50, 51, 52, 100], 40, 0, 100)")
        self.assertEqual(sum(y is not None for y in placed), 3)
        self.assertEqual([placed[0], placed[4]], [0, 100])


if __name__ == "__main__":
    unittest.main()
