"""Figures: what they show agrees with the dense output, and texts do not lie on each other. Both libraries draw the same."""

import contextlib
import io
import sys
import unittest
from unittest import mock

import eigentrail
import numpy as np
from eigentrail import plot
from eigentrail.figures import planes, separation, shapes, studies, style, trace_figures, with_matplotlib
from eigentrail.figures.labels import HEIGHT, text_width
from eigentrail.figures.picture import Area, Cells, Label, Line, Marks, Span

from families import family, oscillators
from program import BIRTH, PUSHED_PENDULUM, SCENES, ProgramTest, edited

DRAWN = 1e-3  # a curve lies nearer to its polygon than this share of the axis


class FigureTest(ProgramTest):
    def traced(self, scene, *options):
        """The Dataset of a scene: a path, or a text."""
        if isinstance(scene, str):
            self.write("scene.toml", scene)
            scene = self.folder / "scene.toml"
        self.run_well("trace", scene, "-o", "loci.h5", "--force", "--quiet", *options)
        return eigentrail.open(self.folder / "loci.h5")

    def lines(self, panel, beginning="mode "):
        return [item for item in panel.of(Line) if item.name.startswith(beginning)]

    def line(self, panel, name):
        """x, y of the only line with this name."""
        (found,) = [item for item in panel.of(Line) if item.name == name]
        return np.asarray(found.x), np.asarray(found.y)

    def texts(self, panel):
        return [item.text for item in panel.of(Label)]

    def boxes(self, panel):
        """Left, right, bottom, top of all texts, in points."""
        boxes = []
        for item in panel.of(Label):
            x, y = panel.place(item.x, item.y)
            width, height = text_width(item.text, item.size), HEIGHT * item.size
            left = x + item.dx - {"left": 0.0, "center": 0.5, "right": 1.0}[item.align] * width
            boxes.append((left, left + width, y + item.dy - height / 2, y + item.dy + height / 2))
        return np.array(boxes)

    def assert_apart(self, panel):
        boxes = self.boxes(panel)
        touch = 0.01  # points
        for i, (left, right, bottom, top) in enumerate(boxes):
            for j, (a, b, c, d) in enumerate(boxes[:i]):
                overlap = left < b - touch and right > a + touch and bottom < d - touch and top > c + touch
                self.assertFalse(overlap, (self.texts(panel)[i], self.texts(panel)[j]))

    def assert_between(self, panel, x, y, values):
        """The polygon x, y is close to the function `values` also halfway between its places."""
        middle = 0.5 * (x[1:] + x[:-1])
        wide = np.diff(x) != 0
        error = np.abs(0.5 * (y[1:] + y[:-1]) - values(middle))[wide]
        self.assertLess(np.nanmax(error), DRAWN * (panel.y.high - panel.y.low))


class Campbell(FigureTest):
    def setUp(self):
        super().setUp()
        self.loci = self.traced(SCENES / "rotating_mass.toml")
        self.picture = trace_figures.campbell_picture(self.loci)

    def test_lines_are_those_of_sel(self):
        above, below = self.picture.panels
        for i, name in enumerate(("lag", "flap")):
            def exact(omega, quantity):
                return self.loci.eigentrail.sel(omega=omega, mode=name)[quantity].values
            x, y = self.line(above, f"mode {i + 1}")
            np.testing.assert_allclose(y, exact(x, "damped_frequency"), rtol=1e-9)
            self.assert_between(above, x, y, lambda omega: exact(omega, "damped_frequency"))
            x, y = self.line(below, f"mode {i + 1}")
            np.testing.assert_allclose(y, 100 * exact(x, "damping_ratio"), atol=1e-6)
            self.assert_between(below, x, y, lambda omega: 100 * exact(omega, "damping_ratio"))
            self.assertEqual((x.min(), x.max()), (5.0, 100.0))

    def test_axes_have_units_and_lines_have_names(self):
        above, below = self.picture.panels
        self.assertEqual((above.y.title, below.y.title, below.x.title),
                         ("damped frequency, rad/s", "damping ratio, %", "omega, rad/s"))
        self.assertLessEqual({"1 lag", "2 flap", "flutter 12.44"}, set(self.texts(above)))
        self.assert_apart(above)

    def test_the_unit_of_frequency(self):
        hertz = trace_figures.campbell_picture(self.loci, unit="Hz").panels[0]
        np.testing.assert_allclose(self.line(hertz, "mode 1")[1], self.line(self.picture.panels[0], "mode 1")[1] / (2 * np.pi))
        self.assertIn("Hz", hertz.y.title)
        with self.assertRaisesRegex(ValueError, "unit='V'.*rad/s, Hz, kHz, rpm"):
            self.loci.eigentrail.campbell(unit="V")

    def test_events_and_stable_ranges(self):
        above = self.picture.panels[0]
        (flutter,) = [item for item in above.of(Marks) if item.name == "flutter"]
        np.testing.assert_allclose([flutter.x[0], flutter.y[0]], [12.439388223, 5.2538767], rtol=1e-7)
        (span,) = above.of(Span)
        np.testing.assert_allclose([span.low, span.high], [12.439388223, 100])

    def test_the_range_ends_at_the_highest_ray(self):
        panel = trace_figures.campbell_picture(self.loci, harmonics=[0.5, 0.8]).panels[0]
        self.assertLess(abs(panel.y.high - 80), 0.1 * 80)
        for n in (0.5, 0.8):
            x, y = self.line(panel, f"harmonic {n}")
            np.testing.assert_allclose(y, n * x, rtol=1e-12)
            self.assertIn(f"{n}×", self.texts(panel))
        self.assertIn("1 lag", self.texts(panel))
        self.assert_apart(panel)

    def test_logarithmic_frequency(self):
        axis = trace_figures.campbell_picture(self.loci, log=True).panels[0].y
        self.assertTrue(axis.log)
        self.assertGreater(axis.low, 0)

    def test_both_libraries_draw_the_same(self):
        drawn = self.loci.eigentrail.campbell(backend="matplotlib")
        shown = self.loci.eigentrail.campbell()
        self.assertIn("Figure", [one.__name__ for one in type(drawn).__mro__])
        axes = drawn.axes[0]
        by_name = {trace.name: trace for trace in shown.data if trace.yaxis == "y" and trace.mode == "lines"}
        for name in ("mode 1", "mode 2"):
            (line,) = [line for line in axes.lines if line.get_label() == name]
            np.testing.assert_array_equal(line.get_xdata(), by_name[name].x)
            np.testing.assert_array_equal(line.get_ydata(), by_name[name].y)
        texts = {text.get_text() for text in axes.texts}
        self.assertLessEqual({"1 lag", "flutter 12.44"}, texts)
        self.assertLessEqual(texts, {annotation.text for annotation in shown.layout.annotations})
        np.testing.assert_allclose(shown.layout.yaxis.range, axes.get_ylim())

    def test_both_libraries_have_the_marks_of_all_events(self):
        for kind, (mark, *_) in style.event_kinds().items():
            self.assertIn(mark.removesuffix("-open"), with_matplotlib.SYMBOLS, kind)

    def test_a_missing_library_is_named_with_the_remedy(self):
        for module, backend in (("matplotlib", "matplotlib"), ("plotly.graph_objects", "plotly")):
            with mock.patch.dict(sys.modules, {module: None}):
                with self.assertRaisesRegex(ImportError, f"apt install python3-{backend}"):
                    self.loci.eigentrail.campbell(backend=backend)
        with self.assertRaisesRegex(ValueError, "'plotly', 'matplotlib'"):
            self.loci.eigentrail.campbell(backend="gnuplot")

    def test_files_are_the_same_for_the_same_picture(self):
        for kind, beginning in (("svg", b"<?xml"), ("pdf", b"%PDF"), ("png", b"\x89PNG")):
            image = with_matplotlib.image(self.picture, kind)
            self.assertTrue(image.startswith(beginning))
            self.assertEqual(image, with_matplotlib.image(self.picture, kind))


class Paths(FigureTest):
    def test_modes_begin_and_end(self):
        loci = self.traced(BIRTH)
        panel = trace_figures.campbell_picture(loci).panels[0]
        x, y = self.line(panel, "mode 1")
        self.assertAlmostEqual(np.nanmax(x), 0.9975, places=6)
        self.assertLess(y[np.nanargmax(x)], 1e-6)
        self.assertEqual(len(self.lines(panel)), 1)  # damping and frequency of oscillatory modes only
        root_locus = trace_figures.root_locus_picture(loci).panels[0]
        self.assertEqual(len({line.name for line in self.lines(root_locus)}), 2)
        exact = -0.05 + np.sqrt(0.5025)
        self.assertAlmostEqual(max(np.nanmax(line.x) for line in self.lines(root_locus)), exact, places=6)

    def test_a_fold_is_passed(self):
        loci = self.traced(edited(PUSHED_PENDULUM, "1e-2", "1e-8"))
        panel = trace_figures.campbell_picture(loci).panels[0]
        x, y = self.line(panel, "mode 1")
        np.testing.assert_allclose(2 * np.pi * y, (9.81**2 * (1 - np.minimum(x, 1.0) ** 2)) ** 0.25, atol=0.02)
        self.assertIn("fold", [line.name for line in panel.of(Line)])
        locus = trace_figures.root_locus_picture(loci).panels[0]
        self.assertGreater(max(np.nanmax(line.x) for line in self.lines(locus)), 1.0)  # the standing one, behind the fold

    def test_zeros_are_zeros(self):
        below = trace_figures.campbell_picture(self.traced(SCENES / "overhung_disc.toml")).panels[1]
        for line in self.lines(below):
            self.assertEqual(np.abs(line.y).max(), 0.0)
        self.assertEqual((below.y.low, below.y.high), (-1.0, 1.0))

    def test_what_is_not_certified_is_dashed(self):
        picture = trace_figures.campbell_picture(self.traced(oscillators([1.0, 1.3], [0.5, -0.5], 0.01), "--no-certify"))
        self.assertEqual({line.dash for line in self.lines(picture.panels[0])}, {"dash"})
        self.assertIn("identity not certified", [entry.legend for entry in picture.legend])

    def test_backward_whirl_is_dotted(self):
        loci = self.traced(SCENES / "overhung_disc.toml")
        sense = np.tile([1.0, -1.0, 1.0, -1.0], (loci.sizes["node"], 1))
        loci["whirl"] = (("node", "mode"), sense)
        picture = trace_figures.campbell_picture(loci)
        self.assertEqual({line.name: line.dash for line in self.lines(picture.panels[0])},
                         {"mode 1": "solid", "mode 2": "dot", "mode 3": "solid", "mode 4": "dot"})
        self.assertIn("backward whirl", [entry.legend for entry in picture.legend])

    def test_a_rotor_has_whirl_and_a_bent_shaft(self):
        loci = self.traced(SCENES / "two_disc_rotor.toml")
        panel = trace_figures.campbell_picture(loci).panels[0]
        dots = {line.name for line in self.lines(panel) if line.dash == "dot"}
        backward = {f"mode {i + 1}" for i, name in enumerate(loci.mode_name.values) if "backward" in str(name)}
        self.assertEqual(dots, backward & {line.name for line in self.lines(panel)})
        self.assertIn("3 backward conical", self.texts(panel))
        (panel,) = shapes.shape_picture(loci, 4500, 4).panels  # circles: x is as large as y, a quarter period apart
        lines = {line.name: line for line in panel.of(Line) if line.name != "axis"}
        self.assertEqual(len(lines), 2)
        np.testing.assert_allclose(*(np.abs(line.y) for line in lines.values()), atol=1e-6)
        for line in lines.values():
            np.testing.assert_allclose(line.x, np.linspace(0, 1.5, 7), atol=1e-12)

    def test_sixty_modes_can_be_told_apart(self):
        rng = np.random.default_rng(7)
        loci = self.traced(oscillators(np.linspace(8, 60, 60) ** 2, rng.uniform(-5, 60, 60)), "--tolerance", "1e-5")
        panel = trace_figures.campbell_picture(loci).panels[0]
        self.assertEqual({text for text in self.texts(panel) if text.isdigit()}, {str(i + 1) for i in range(60)})
        self.assert_apart(panel)

    def test_short_lines_of_a_root_locus_have_their_numbers_too(self):
        i = np.arange(1.0, 21.0)
        loci = self.traced(family(0, 1, M=[np.eye(20)], C=[np.diag(i)], K=[np.diag(100 * i**2), np.diag(i)]))
        panel = trace_figures.root_locus_picture(loci).panels[0]
        self.assertEqual({text for text in self.texts(panel) if text.isdigit()}, {str(k + 1) for k in range(20)})
        self.assert_apart(panel)


class Harmonics(FigureTest):
    def setUp(self):
        super().setUp()
        self.loci = self.traced(SCENES / "overhung_disc.toml")

    def test_those_of_the_scene_by_default(self):
        panel = trace_figures.campbell_picture(self.loci).panels[0]
        self.assertEqual([line.name for line in self.lines(panel, "harmonic")], ["harmonic 1", "harmonic 2"])
        self.assertEqual(self.lines(trace_figures.campbell_picture(self.loci, harmonics=[]).panels[0], "harmonic"), [])

    def test_crossings_of_others_are_found(self):
        panel = trace_figures.campbell_picture(self.loci, harmonics=[3]).panels[0]
        (marks,) = [item for item in panel.of(Marks) if item.name == "resonance"]
        third = [(x, y) for x, y, text in zip(marks.x, marks.y, marks.texts) if text.startswith("3×")]
        self.assertGreaterEqual(len(third), 3)
        for x, y in third:
            self.assertAlmostEqual(y / (3 * x), 1.0, places=9)
            nearest = np.abs(self.loci.eigentrail.sel(omega=x).damped_frequency - 3 * x).min()
            self.assertLess(float(nearest), 1e-6)

    def test_a_parameter_without_frequency_is_refused(self):
        loci = self.traced(BIRTH)
        with self.assertRaisesRegex(ValueError, "harmonics need an angular velocity.*rpm.*parameter p has the unit '1'"):
            loci.eigentrail.campbell(harmonics=[1])
        with self.assertRaisesRegex(ValueError, "positive"):
            self.loci.eigentrail.campbell(harmonics=[0])

    def test_operating_ranges_and_their_margins(self):
        scene = edited((SCENES / "overhung_disc.toml").read_text(encoding="utf-8"), 'excitation = "omega"',
                       "operating_range = [400, 520]")
        picture = trace_figures.campbell_picture(self.traced(scene))
        for panel in picture.panels:
            spans = sorted((round(span.low, 9), round(span.high, 9)) for span in panel.of(Span))
            # No damping: 16 % of the lowest speed and 26 % of the highest one, by API RP 684.
            self.assertEqual(spans, [(0.0, 2000.0), (336.0, 400.0), (400.0, 520.0), (520.0, 655.2)])
        (close,) = [item for item in picture.panels[0].of(Marks) if item.name == "too_close"]
        np.testing.assert_allclose(close.x, [557.173763269], rtol=1e-9)
        self.assertIn("2\u00d7 557.2", self.texts(picture.panels[0]))
        self.assertLessEqual({"operating range", "separation margin", "resonance, too close"},
                             {entry.legend for entry in picture.legend})

    def test_the_margin_of_the_scene_and_that_of_the_standard(self):
        damped = complex(-0.2, 1.0)  # amplification factor 2.55
        standard = separation.Operation([(20.0, 30.0)], None)
        self.assertAlmostEqual(standard.wanted(damped, True), 0.17 * (1 - 1 / (0.5 / (0.2 / abs(damped)) - 1.5)))
        self.assertEqual(standard.wanted(complex(-0.3, 1.0), False), 0.0)
        self.assertEqual((standard.wanted(1j, True), standard.wanted(1j, False)), (0.16, 0.26))
        operation = separation.Operation([(20.0, 30.0), (50.0, 60.0)], 0.1)
        self.assertEqual([operation.is_too_close(p, damped) for p in (17.9, 18.1, 25, 32.9, 33.1, 45.1, 66.1)],
                         [False, True, True, True, False, True, False])
        np.testing.assert_allclose(operation.strips([]), [(18, 20), (30, 33), (45, 50), (60, 66)])
        for p in (15.0, 25.0, 35.0):
            self.assertEqual(standard.strips([(-p, damped)]), standard.strips([(p, damped)]))

    def test_without_the_engine_the_unit_says_it(self):
        with_engine = trace_figures.campbell_picture(self.loci, harmonics=[1]).panels[0]
        without = trace_figures.campbell_picture(_without_file(self.loci), harmonics=[1]).panels[0]
        for panel in (with_engine, without):
            x, y = self.line(panel, "harmonic 1")
            np.testing.assert_allclose(x, y, rtol=1e-12)


def _without_file(data):
    copy = data.copy()
    copy.encoding = {}
    return copy


class Sampled(FigureTest):
    def test_errors_are_bands_and_bars(self):
        self.run_well("import", "numpy", SCENES.parent / "linearizations" / "iea15.npz", "-o", "floater", "--unit", "m/s",
                      "--digits", "4")
        loci = self.traced(self.folder / "floater" / "iea15.toml", "--modes",
                           "band = ['0.005 Hz', '0.06 Hz'], damping_below = 0.2")
        picture = trace_figures.campbell_picture(loci)
        panel = picture.panels[0]
        bands = {item.name: item for item in panel.of(Area)}
        oscillates = np.nanmax(loci.damped_frequency.values, axis=0) > 0
        self.assertEqual(set(bands), {f"error of mode {i + 1}" for i in np.flatnonzero(oscillates)})
        band, n = bands["error of mode 1"], len(bands["error of mode 1"].x) // 2
        at = n // 2
        found = loci.eigentrail.sel(mode="mode 1", **{loci.eigentrail.parameter: band.x[at]})
        half = 0.5 * (band.y[at] - band.y[2 * n - 1 - at])
        self.assertAlmostEqual(half, float(found.interpolation_error + found.digits_error) / (2 * np.pi), places=9)
        self.assertEqual(len([line for line in panel.of(Line) if line.name == "interval of the event"]),
                         int(np.isfinite(loci.event_interval.values[:, 0]).sum()))
        self.assertIn("error of the data", [entry.legend for entry in picture.legend])


class Shapes(FigureTest):
    def test_a_point_on_a_rod(self):
        loci = self.traced(SCENES / "rotating_mass.toml")
        (panel,) = shapes.shape_picture(loci, 100, "lag", view="xy").panels
        rest = [item for item in panel.of(Marks) if item.name == "equilibrium"]
        np.testing.assert_allclose([rest[0].x[0], rest[0].y[0]], loci.equilibrium.values[0, :2], rtol=1e-12)
        rods = [item for item in panel.of(Line) if item.name == "rod"]
        self.assertEqual(len(rods), 2)  # at rest and displaced
        self.assertIn("blade", self.texts(panel))
        moved = [item for item in panel.of(Marks) if item.name == "displaced"][0]
        shift = np.array([moved.x[0] - rest[0].x[0], moved.y[0] - rest[0].y[0]])
        self.assertGreater(abs(shift[1]), 100 * abs(shift[0]))  # lag: along y

    def test_without_the_engine_there_are_no_links(self):
        (panel,) = shapes.shape_picture(_without_file(self.traced(SCENES / "rotating_mass.toml")), 100, 1).panels
        self.assertEqual([item for item in panel.of(Line) if item.name == "rod"], [])
        self.assertTrue([item for item in panel.of(Marks) if item.name == "displaced"])

    def test_nodes_on_a_line_are_a_bent_axis(self):
        loci = self.traced(SCENES / "beck_column.toml")
        (panel,) = shapes.shape_picture(loci, 0, 1).panels
        x, y = self.line(panel, "y")
        self.assertEqual({line.name for line in panel.of(Line)}, {"axis", "y"})  # the mode is real, in a plane
        moved = loci.mode_shape.values[0, 0][[i for i, name in enumerate(loci.coordinate.values) if str(name).endswith(".y")
                                              and "axis" not in str(name)]]
        np.testing.assert_allclose(y, (moved / moved[np.abs(moved).argmax()]).real * y[np.abs(y).argmax()], atol=1e-9)
        self.assertTrue(np.all(np.diff(x) > 0))

    def test_a_family_has_bars(self):
        loci = self.traced(oscillators([1.0, 1.3, 2.0], [0.5, -0.5, 0.1], 0.01))
        (panel,) = shapes.shape_picture(loci, -1, 2).panels
        shape = loci.mode_shape.values[0, 1]
        bars = [item for item in panel.of(Area) if item.name.startswith("real part")]
        largest = shape[np.abs(shape).argmax()]
        np.testing.assert_allclose([bar.x[1] for bar in bars], (shape / largest).real, atol=1e-12)
        self.assertEqual([text for _, text in panel.y.ticks], [str(name) for name in loci.coordinate.values])

    def test_modes_and_places_that_do_not_exist(self):
        loci = self.traced(BIRTH)
        with self.assertRaisesRegex(ValueError, "numbers 1 to 2"):
            loci.eigentrail.mode_shape(p=0, mode=3)
        with self.assertRaisesRegex(ValueError, "'mode 1', 'mode 2'"):
            loci.eigentrail.mode_shape(p=0, mode="flap")
        with self.assertRaisesRegex(ValueError, "does not exist"):
            loci.eigentrail.mode_shape(p=0, mode=2)
        with self.assertRaisesRegex(TypeError, "p=..."):
            loci.eigentrail.mode_shape(omega=0, mode=1)


class Planes(FigureTest):
    def setUp(self):
        super().setUp()
        scene = SCENES / "rotating_mass.toml"
        window = ("--second", "a_n", "--second-from", "200", "--second-to", "3000")
        self.run_well("boundary", scene, *window, "-o", "flutter.h5", "--quiet")
        self.run_well("map", scene, *window, "--grid", "6x8", "-o", "map.h5", "--quiet")
        self.map, self.boundary = (eigentrail.open(self.folder / name) for name in ("map.h5", "flutter.h5"))

    def test_cells_events_and_the_boundary(self):
        picture = planes.plane_picture(self.map, self.boundary)
        (panel,) = picture.panels
        (cells,) = panel.of(Cells)
        self.assertEqual(cells.kind.shape, (6, 8))
        self.assertEqual(int(np.sum(cells.kind == 3)), int((self.map.unstable == 1).sum()))
        self.assertTrue(np.all(np.diff(cells.x) > 0))
        column = int(np.argmin(np.abs(cells.x - 5.0)))
        self.assertEqual(cells.names[cells.kind[-1, column]], "1 growing mode")
        (line,) = [item for item in panel.of(Line) if item.name == "flutter 1"]
        curve = self.boundary.eigentrail.curve(0, points=len(line.x))
        np.testing.assert_allclose(line.x, curve.omega, rtol=1e-12)
        (dots,) = [item for item in panel.of(Marks) if item.name == "located events"]
        order = np.argsort(line.y)
        np.testing.assert_allclose(np.interp(dots.y, line.y[order], line.x[order]), dots.x, rtol=1e-3)
        self.assertEqual([entry.legend for entry in picture.legend],
                         ["stable", "1 growing mode", "located on the lines", "flutter"])

    def test_each_alone_in_both_libraries(self):
        for data in (self.map, self.boundary):
            self.assertTrue(data.eigentrail.plane().data)
            self.assertTrue(data.eigentrail.plane(backend="matplotlib").axes)

    def test_files_that_do_not_fit(self):
        with self.assertRaisesRegex(ValueError, "expected a boundary file"):
            self.map.eigentrail.plane(self.map)
        with self.assertRaisesRegex(ValueError, "only loci files"):
            self.map.eigentrail.campbell()
        self.boundary.attrs["second_parameter"] = "drag"
        with self.assertRaisesRegex(ValueError, "over omega and a_n, found omega and drag"):
            self.map.eigentrail.plane(self.boundary)


class PlotCommand(FigureTest):
    """What `eigentrail plot` runs."""

    def plot(self, *arguments):
        """Exit code and what is said on stderr."""
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            code = plot.main([str(argument) for argument in arguments])
        return code, said.getvalue()

    def test_every_kind_of_a_trace(self):
        self.traced(SCENES / "rotating_mass.toml")
        file = self.folder / "loci.h5"
        pictures = set()
        for i, kind in enumerate(("campbell", "root-locus", "damping", "shape")):
            self.assertEqual(self.plot(file, "-o", self.folder / f"{i}.svg", "--kind", kind), (0, ""))
            pictures.add((self.folder / f"{i}.svg").read_bytes())
        self.assertEqual(len(pictures), 4)

    def test_places_have_units(self):
        self.traced(SCENES / "rotating_mass.toml")
        images = []
        for name, at in (("a.svg", "10 Hz"), ("b.svg", "62.8 rad/s"), ("c.svg", "600 rpm"), ("d.svg", "20")):
            code = self.plot(self.folder / "loci.h5", "-o", self.folder / name, "--kind", "shape", "--at", at)
            self.assertEqual(code, (0, ""))
            images.append((self.folder / name).read_bytes())
        self.assertEqual([image == images[0] for image in images], [True, True, True, False])

    def test_what_is_refused(self):
        self.traced(SCENES / "rotating_mass.toml")
        file, output = self.folder / "loci.h5", self.folder / "x.svg"
        self.write("notes.txt", "no file of HDF5")
        for arguments, fragments in [
            ((file, "--kind", "plane"), ["needs a file of the kind map or boundary, found eigentrail-loci"]),
            ((file, "--kind", "accuracy"), ["needs a file of the kind accuracy"]),
            ((file, file), ["shows one file, found 2", "eigentrail report"]),
            ((file, "--mode", "1"), ["--mode: a picture of the kind campbell has no use for it"]),
            ((file, "--kind", "damping", "--unit", "Hz"), ["--unit"]),
            ((file, "--unit", "V"), ["unit='V'", "rpm"]),
            ((file, "--harmonics", "0"), ["positive"]),
            ((file, "--harmonics", "one"), ["--harmonics", "1,2"]),
            ((file, "--size", "9"), ["--size", "9x6"]),
            ((file, "--kind", "shape", "--mode", "7"), ["numbers 1 to 2"]),
            ((file, "--kind", "shape", "--mode", "torsion"), ["'lag', 'flap'"]),
            ((file, "--kind", "shape", "--view", "top"), ["'3D', 'xy'"]),
            ((file, "--kind", "shape", "--at", "400"), ["--at 400", "from 5 to 100"]),
            ((file, "--kind", "shape", "--at", "100 Hz"), ["--at 100 Hz", "from 5 to 100"]),
            ((file, "--kind", "shape", "--at", "fast"), ["--at: ", "a number", "fast"]),
            ((file, "--kind", "shape", "--at", "10 m"), ["--at: 10 m does not fit omega", "rad/s"]),
            ((self.folder / "nothing.h5",), ["nothing.h5: No such file"]),
            ((self.folder / "notes.txt",), ["notes.txt: cannot be read: HDF5 could not open it: it is no HDF5 file"]),
        ]:
            with self.subTest(arguments):
                code, said = self.plot(*arguments, "-o", output)
                self.assertEqual((code, said.count("\n"), said[:12]), (2, 1, "eigentrail: "), said)
                for fragment in fragments:
                    self.assertIn(fragment, said)
        self.assertEqual(self.plot(file, "-o", self.folder / "x.jpg")[0], 2)
        self.assertFalse(output.exists())


class Studies(FigureTest):
    def test_a_line_per_method_and_order(self):
        self.run_well("accuracy", SCENES / "rotating_mass.toml", "--tolerances", "1e-3,1e-5", "--orders", "2,3",
                      "--grids", "25", "--repeat", "1", "-o", "study.h5")
        study = eigentrail.open(self.folder / "study.h5")
        (panel,) = studies.work_precision_picture(study, "points").panels
        (line,) = [item for item in panel.of(Line) if item.name == "eigentrail, order 3"]
        runs = np.flatnonzero((study.method.values == "eigentrail") & (study.order.values == 3))
        self.assertEqual(sorted(line.x), sorted(study.points.values[runs]))
        self.assertEqual(sorted(line.y), sorted(study.error.values[runs]))
        self.assertEqual({trace.name for trace in study.eigentrail.work_precision().data if trace.showlegend},
                         {line.name for line in panel.of(Line)})
        legend = study.eigentrail.work_precision(backend="matplotlib").legends[0]
        self.assertIn("eigentrail, order 3", [text.get_text() for text in legend.get_texts()])
        with self.assertRaisesRegex(ValueError, "'wall_time', 'factorizations', 'points'"):
            study.eigentrail.work_precision("money")


if __name__ == "__main__":
    unittest.main()
