"""What the program says about models whose stability is known in closed form: stable ranges of the whole model, onsets of
instability, what is zero, and names."""

import csv
import io
import json
import math
import pathlib
import unittest

import h5py
import numpy as np

from command_test_case import CommandTest
from program import SCENES, edited

MODELS = pathlib.Path(__file__).parent / "models"


class VerdictTest(CommandTest):
    def trace_model(self, name, *options, output="loci.h5"):
        self.run_well("trace", MODELS / f"{name}.toml", "-o", output, "--quiet", "--force", *options)
        return self.folder / output

    def trace_and_read(self, scene, *options):
        """The summary of a trace."""
        self.write("scene.toml", scene)
        return self.run_well("trace", "scene.toml", "-o", "loci.h5", "--force", *options)

    def info(self, file):
        return json.loads(self.run_well("info", file, "--json"))

    def ranges(self, file):
        """Per stable range: kind, where it begins and ends."""
        return [(entry["kind"], entry["from"]["parameter"], entry["to"]["parameter"]) for entry in self.info(file)["stable_ranges"]]

    def events(self, file, *kinds):
        rows = list(csv.DictReader(io.StringIO(self.run_well("events", file, "--csv"))))
        return [row for row in rows if not kinds or row["kind"] in kinds]

    def places(self, file, *kinds):
        return sorted(float(row["parameter"]) for row in self.events(file, *kinds))


class WholeModel(VerdictTest):
    def test_a_blade_diverges_in_a_mode_that_is_not_followed(self):
        # V = pi/(2 L) sqrt(GJ / (rho/2 2 pi c e)): a uniform wing held at its root, lift at the quarter chord. Eight elements
        # are 2e-6 too stiff.
        length, GJ, density, chord, offset = 0.55, 7.20, 1.225, 0.1, 0.01914
        divergence = math.pi / (2 * length) * math.sqrt(GJ / (0.5 * density * 2 * math.pi * chord * offset))
        file = self.trace_model("divergent_blade", "--from", 80, "--to", 95)
        (kind, begin, end), = self.ranges(file)
        self.assertEqual((kind, begin), ("stable", 80.0))
        self.assertAlmostEqual(end / divergence, 1.0, delta=1e-5)
        self.assertTrue(self.info(file)["stable_ranges"][0]["whole_model"])
        growing = [s for _, _, s in self.eval_rows(file, [94.0]) if s.real > 0]
        self.assertTrue(any(s.imag == 0 for s in growing), "the motion that diverges is followed from its zero on")

    def test_a_wing_with_lag_states_and_damping_diverges_where_the_closed_form_says(self):
        # Blocks of its sensitive modes with the real ones of the wake would hide them behind rounding.
        length, GJ, density, chord, offset = 16.0, 1e4, 0.0889, 1.0, 0.25
        divergence = math.pi / (2 * length) * math.sqrt(GJ / (0.5 * density * 2 * math.pi * chord * offset))
        file = self.trace_model("divergent_wing")
        (kind, begin, end), = self.ranges(file)
        self.assertEqual((kind, begin), ("stable", 10.0))
        self.assertAlmostEqual(end / divergence, 1.0, delta=1e-5)
        with self.open(file) as loci:
            self.assertLess(loci["V"].size, 40)
            certified, exists = loci["certified"][()] != 0, loci["mode_block"][()] >= 0
            self.assertGreater(certified[exists].mean(), 0.95)

    def test_the_slowest_modes_of_a_graded_family_tell_what_others_do(self):
        # Two followed modes of three freedoms; the third one, far stiffer, flutters: s^2 - 2 (p - 1) s + 1e8 = 0.
        scene = """
[trace]
parameter = "p"
from = 0
to = 3
modes = 2
[matrix_family]
M = [[[1, 0, 0], [0, 1, 0], [0, 0, 1]]]
C = [[[0.1, 0, 0], [0, 0.2, 0], [0, 0, "-2*(p-1)"]]]
K = [[[1, 0, 0], [0, 4, 0], [0, 0, 1e8]]]
"""
        file = self.trace(scene)
        (kind, begin, end), = self.ranges(file)
        self.assertEqual((kind, begin), ("stable", 0.0))
        self.assertAlmostEqual(end, 1.0, delta=1e-9)
        flutter, = self.events(file, "flutter")
        self.assertAlmostEqual(float(flutter["imag"]), 1e4, delta=1e-6)

    def test_a_growing_mode_is_followed_from_the_start(self):
        scene = """
[trace]
parameter = "p"
from = 0
to = 1
modes = 1
[matrix_family]
M = [[[1, 0], [0, 1]]]
C = [[[0.1, 0], [0, "0.2*(p - 0.5)"]]]
K = [[[1, 0], [0, 9]]]
"""
        file = self.trace(scene)
        (kind, begin, end), = self.ranges(file)
        self.assertEqual((kind, end), ("stable", 1.0))
        self.assertAlmostEqual(begin, 0.5, delta=1e-9)


class Zeros(VerdictTest):
    def test_a_slow_divergence_beside_a_stiff_mode(self):
        # s^2 + c s + 1e-6 (p - 0.5) = 0 beside a mode of 1e5 rad/s.
        file = self.trace_model("slow_beside_stiff")
        (kind, begin, end), = self.ranges(file)
        self.assertEqual((kind, end), ("stable", 1.0))
        self.assertAlmostEqual(begin, 0.5, delta=1e-9)
        self.assertEqual(self.places(file, "divergence"), [begin])
        for p in (0.0, 0.3, 0.9):
            exact = np.roots([1.0, 1e-3, 1e-6 * (p - 0.5)])
            found = np.array([s for _, _, s in self.eval_rows(file, [p]) if abs(s) < 1.0])
            for s in found:
                self.assertLess(np.abs(exact - s).min(), 1e-9)

    def test_its_map(self):
        self.run_well("map", MODELS / "slow_beside_stiff_map.toml", "--second", "c", "--second-from", 1e-4, "--second-to", 1e-3, "--grid", "2x21",
                      "-o", "map.h5", "--quiet")
        file = self.open("map.h5")
        p, growing = file["p"][:], file["unstable"][:]
        np.testing.assert_array_equal(growing > 0, np.broadcast_to(p < 0.5, growing.shape))

    def test_a_shaft_without_mass_has_the_modes_of_its_disc(self):
        file = self.trace_model("massless_shaft")
        rpm = 2 * math.pi / 60
        oscillating = [np.sort([s.imag / rpm for _, _, s in self.eval_rows(file, [speed]) if s.imag > 0]) for speed in (0.0, 23600.0)]
        np.testing.assert_allclose(oscillating[0], [1489.695, 1489.695, 5769.56, 5769.56], rtol=1e-5)
        np.testing.assert_allclose(oscillating[1], [1489.695, 1489.695, 2352.14, 14152.1], rtol=1e-5)
        resonances = self.places(file, "resonance")
        np.testing.assert_allclose(resonances, [1489.695, 1489.695, 4710.829, 8159.3955], rtol=1e-6)
        names = [name for name in self.info(file)["mode_names"] if "overdamped" not in name]
        self.assertEqual(sorted(names), ["backward conical", "backward cylindrical", "forward conical", "forward cylindrical"])

    def test_yaw_of_a_rolling_disc_is_zero_twice(self):
        file = self.trace_model("rolling_disc", "--tolerance", 1e-8)
        spin, = {round(place, 9) for place in self.places(file, "divergence", "collision")}
        self.assertAlmostEqual(spin, math.sqrt(9.81 / 0.9), delta=1e-8)
        r, g = 0.3, 9.81
        lean = math.sqrt(abs(g * r - 3 * r * r * 49.0) / (1.25 * r * r))
        found = sorted((abs(s) for _, _, s in self.eval_rows(file, [7.0])))
        self.assertAlmostEqual(found[-1], lean, delta=1e-7)
        self.assertLess(max(found[:-1]), 1e-12)
        self.run_well("verify", file)  # also beside the collision, where yaw is zero at both ends of the step

    def test_a_divergence_through_a_rigid_body_zero_is_one(self):
        # A mass with the damping p slides freely: s = 0 and -p. Two masses, of which nothing holds the first one: its damping
        # 0.5 + 4 p is lost at -1/8, the stiffness 1 + 4 p of the second one at -1/4. The zero itself stays.
        one = 'M = [[[1]]]\nC = [[[0]], [[1]]]\nK = [[[0]]]\n'
        two = """M = [[[3, -3], [-3, 6]]]
C = [[[0.5, -0.4], [-0.4, 0.5]], [[4, -4], [-4, 4]]]
K = [[[0, 0], [0, 1]], [[0, 0], [0, 4]]]
"""
        for matrices, expected in ((one, [0.0]), (two, [-0.25, -0.125])):
            for tolerance in (1e-6, 1e-9):
                for ends in ((-1, 2), (2, -1)):
                    with self.subTest(expected=expected, tolerance=tolerance, ends=ends):
                        scene = f'[trace]\nparameter = "p"\nfrom = {ends[0]}\nto = {ends[1]}\n[matrix_family]\n{matrices}'
                        file = self.trace(scene, "--force", "--tolerance", tolerance)
                        for place, p in zip(self.places(file, "divergence"), expected, strict=True):
                            self.assertAlmostEqual(place, p, delta=1e-9)
                        self.assertEqual(self.run_well("events", file).count("unstable below"), len(expected))
                        self.assertEqual([sorted(ends) for _, *ends in self.ranges(file)], [[expected[-1], 2.0]])
                        self.run_well("verify", file)

    def test_the_accuracy_of_zeros_at_the_start_does_not_follow_from_their_rounding(self):
        # Four of six eigenvalues are zero at the start, two of them throughout: nothing oscillates there.
        file = self.trace("""[trace]
parameter = "p"
from = 0
to = 3
[matrix_family]
M = [[[2, -1, -2], [-1, 7, 0], [-2, 0, 6]]]
C = [[[1, 1, 1], [1, 1, 1], [1, 1, 1]]]
K = [[[1, 0, 1], [0, 0, 0], [1, 0, 1]], [[2, -1, 3], [-1, 1, -2], [3, -2, 5]]]
""")
        with self.open(file) as loci:
            self.assertLess(loci["p"].size, 60)
        self.run_well("verify", file)

    def test_special_points_at_the_start_name_modes_of_the_file(self):
        # Twice zero at the start, then a pair: of the two real ones that meet there one is gone behind it.
        file = self.trace("""[trace]
parameter = "p"
from = 0
to = 3
[matrix_family]
M = [[[7, -2, -5, 4], [-2, 5, 2, 4], [-5, 2, 7, -4], [4, 4, -4, 17]]]
K = [[[8, 6, -2, 6], [6, 6, 0, 4], [-2, 0, 5, -1], [6, 4, -1, 5]], [[6, -5, -2, -4], [1, 4, 0, -2], [-6, 4, 6, 2], [-2, -6, 0, 9]]]
""")
        with self.open(file) as loci:
            modes = loci["mode"].size
        named = {int(mode) for row in self.events(file) for mode in row["modes"].split(";")}
        self.assertLessEqual(max(named), modes)
        self.run_well("verify", file)


class Undamped(VerdictTest):
    def test_a_conservative_column_does_not_flutter(self):
        file = self.trace_model("undamped_column")
        self.assertEqual(self.events(file, "flutter", "divergence", "collision"), [])
        self.assertEqual([kind for kind, _, _ in self.ranges(file)], ["marginal"])

    def test_two_frequencies_that_meet_are_an_onset_of_flutter(self):
        # The closed form of Beck is 20.0509; ten elements are 4e-4 too stiff.
        file = self.trace_model("follower_force_column")
        onset, = self.places(file, "collision")
        self.assertAlmostEqual(onset, 20.0582493727, delta=1e-6)
        self.assertEqual(self.events(file, "flutter", "divergence"), [])
        self.assertEqual([kind for kind, _, _ in self.ranges(file)], ["marginal"])
        self.assertEqual(self.ranges(file)[0][2], onset)
        text = self.run_well("events", file)
        self.assertIn("unstable above", text)

    def test_rounding_of_a_stiff_column_is_neither_a_veering_nor_a_change_of_sign(self):
        # EA L^2 / EI = 1e6, four elements, whose onset is 20.3346074; at 18.448 the two planes cross. They have nothing to do
        # with each other, but rounding of the stiff axis joins them: the crossing is listed or not certified.
        model = (MODELS / "follower_force_column.toml").read_text().replace("elements = 10", "elements = 4")
        for tolerance in (1e-6, 1e-8, 1e-9, 1e-10):
            with self.subTest(tolerance=tolerance):
                file = self.trace(model, "--from", "18", "--modes", "4", "--tolerance", tolerance, "--force")
                with self.open(file) as loci:
                    all_certified = bool((loci["certified"][:] != 0).all())
                self.assertTrue(self.events(file, "crossing") or not all_certified)
                if tolerance > 1e-8:
                    continue
                onset, = self.places(file, "collision")
                self.assertAlmostEqual(onset, 20.3346074, delta=1e-7)
                self.assertEqual(self.events(file, "veering"), [])
                self.assertEqual(self.ranges(file), [("marginal", 18.0, onset)])

    def test_no_divergence_beside_a_collision_of_opposite_signs_of_energy(self):
        file = self.trace_model("indefinite_mass")
        self.assertEqual(self.events(file, "divergence", "flutter"), [])
        self.assertEqual(len(self.events(file, "collision")), 3)
        self.run_well("verify", self.trace_model("indefinite_mass", "--tolerance", 1e-9, output="fine.h5"))

    def test_a_damper_that_is_idle_at_one_place_begins_no_instability(self):
        # Two equal masses on springs k and 10, a damper between them: at k = 10 they move in step, and Re s touches zero from below.
        summary = self.trace_and_read("""[trace]
parameter = "k"
from = 5
to = 17
[matrix_family]
M = [[[1, 0], [0, 1]]]
C = [[[0.5, -0.5], [-0.5, 0.5]]]
K = [[[0, 0], [0, 10]], [[1, 0], [0, 0]]]
""")
        self.assertNotIn("onset of instability", summary)
        self.assertRegex(summary, r"flutter  k = 10 .* touches the imaginary axis")
        self.assertEqual([kind for kind, _, _ in self.ranges("loci.h5")], ["stable"])

    def test_springs_that_are_lost_at_once_do_not_destabilize_what_lies_before(self):
        # A point on three springs, 20, k and 0.8 k: no stored point lies between the crossings at 25 and 20.
        self.trace_and_read("""[parameters]
k = 40
[trace]
parameter = "k"
from = 60
to = -10
[[point]]
name = "point"
mass = 1
position = [0, 0, 0]
""" + "".join(f"""[[guided_spring]]
point = "point"
direction = {direction}
stiffness = {stiffness}
""" for direction, stiffness in (([1, 0, 0], 20), ([0, 1, 0], '"k"'), ([0, 0, 1], '"0.8*k"'))))
        (kind, begin, end), = self.ranges("loci.h5")
        self.assertEqual((kind, begin), ("marginal", 60.0))
        self.assertAlmostEqual(end, 0.0, delta=1e-9)

    def test_equal_modes_do_not_cross(self):
        self.assertEqual(self.events(self.trace_model("trifilar")), [])


class Constraints(VerdictTest):
    def test_a_stiffness_that_reactions_do_not_determine_is_refused(self):
        result = self.run_program("trace", MODELS / "two_rods.toml", "-o", "loci.h5")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("the reactions of short and long are not unique", result.stderr)
        self.assertIn('reactions = "least squares"', result.stderr)
        self.assertFalse((self.folder / "loci.h5").exists())

    def test_a_scene_may_share_them_by_least_squares(self):
        # Half of the weight on each rod: s^2 = -g (1/2 + 1/4). The rods also with lengths that change with g.
        text = (MODELS / "two_rods.toml").read_text()
        for lengths in ((1.0, 2.0), ('"1 + 0.01*g"', '"2 + 0.01*g"')):
            changed = text.replace("length = 1", f"length = {lengths[0]}").replace("length = 2", f"length = {lengths[1]}")
            (self.folder / "shared.toml").write_text('reactions = "least squares"\n' + changed)
            self.run_well("trace", "shared.toml", "-o", "loci.h5", "--quiet", "--force")
            for g in (5.0, 11.0, 20.0):
                extension = 0.0 if lengths[0] == 1.0 else 0.01 * g
                exact = math.sqrt(0.5 * g * (1 / (1 + extension) + 1 / (2 + extension)))
                for _, _, s in self.eval_rows(self.folder / "loci.h5", [g]):
                    self.assertAlmostEqual(abs(s), exact, delta=2e-8 * exact)

    def test_shares_that_change_along_the_path(self):
        file = self.trace_model("three_rods")
        for a in (0.5, 0.77, 1.3, 2.0):
            c2 = 1 / (1 + a * a)
            (_, _, s), = self.eval_rows(file, [a])
            self.assertAlmostEqual(abs(s), math.sqrt(9.81 * (2 * c2 + 0.5) / (2 * c2 + 1)), delta=5e-8)

    def test_other_words_for_sharing_are_refused(self):
        (self.folder / "shared.toml").write_text('reactions = "equal"\n' + (MODELS / "two_rods.toml").read_text())
        result = self.run_program("trace", "shared.toml", "-o", "loci.h5")
        self.assertIn('shared.toml:1:', result.stderr)
        self.assertIn('expected "least squares", found "equal"', result.stderr)

    def test_a_mechanism_whose_constraints_are_dependent_on_its_path_finds_its_rest(self):
        # Reference: an independent program (Exudyn), 1.2412987 rad/s at g = 9.81; gravity alone, so it goes with sqrt(g).
        file = self.trace_model("bricard")
        for g in (9.81, 20.0):
            (_, _, s), = self.eval_rows(file, [g])
            self.assertAlmostEqual(abs(s) / math.sqrt(g / 9.81), 1.2412987, delta=1e-7)


class OtherPaths(VerdictTest):
    def test_a_buckled_column_is_followed_at_every_tolerance_and_order(self):
        # The tip of the buckled path at P = 130 by four elements, from its own continuation at 1e-10.
        for options in (("--tolerance", 1e-6), ("--tolerance", 1e-8), ("--order", 2), ("--tolerance", 1e-7, "--order", 3),
                        ("--first-step", 0.7)):
            for branch in (2, 3) if "--first-step" in options or options[1] == 1e-6 else (2,):   # one is the other's mirror image
                with self.subTest(options=options, branch=branch):
                    file = self.trace_model("pinned_column", "--branch", branch, "--from", 50, "--to", 130, *options)
                    with self.open(file) as loci:
                        names = [name.decode() for name in loci["coordinate"][:]]
                        self.assertEqual(loci["P"][-1], 130.0)
                        self.assertAlmostEqual(loci["equilibrium"][-1, names.index("col.tip.x")], 0.4901288566, delta=1e-8)
                    self.assertEqual(len(self.events(file, "branch_point")), 1)

    def test_rounding_of_a_stiff_axis_does_not_divide_steps(self):
        # It leaves the load at the branch point known to fewer digits on the path that begins there.
        found = {}
        for tolerance in (1e-5, 1e-6, 1e-8, 1e-10):
            file = self.trace_model("slender_column", "--branch", 2, "--tolerance", tolerance)
            found[tolerance] = self.eval_at(file, [99.2, 101.0, 105.0, 110.0])
            with self.open(file) as loci:
                self.assertLess(len(loci["P"]), 150)
                # Beside the branch point rounding of the equilibrium leaves less than is asked for, which is said.
                if tolerance < 1e-5:
                    self.assertEqual("rounding leaves" in str(loci.attrs["notes"]), tolerance < 1e-6)
        self.run_well("verify", file, "--samples", 20)
        self.assert_within(found[1e-5][:2], found[1e-6][:2], 1e-5)
        for tolerance in (1e-8, 1e-10):
            self.assert_within(found[1e-6][1:], found[tolerance][1:], 2e-6)
        # Beyond the buckling load a small load from the side changes the buckled column little.
        text = (MODELS / "slender_column.toml").read_text(encoding="utf-8")
        self.write("imperfect.toml", text + "[gravity]\nacceleration = [0, 1e-6, 0]\n")
        self.run_well("trace", "imperfect.toml", "-o", "imperfect.h5", "--quiet")
        with self.open("imperfect.h5") as loci:
            self.assertLess(len(loci["P"]), 150)
        self.assert_within(self.eval_at("imperfect.h5", [110.0])[0], found[1e-8][3], 1e-4)


SNAP_THROUGH = """
parameters = { F = { value = 0, unit = "N" }, k = { value = 0.25, unit = "N/m" } }
trace = { parameter = "F", from = -0.77, to = 0.6 }
point = [{ name = "m", mass = 1.0, position = [0, 0, -0.5] }]
fixed = [
  { point = "m", coordinate = "x" },
  { point = "m", coordinate = "y" },
]
spring = [{ from = [1, 0, 0], to = "m", stiffness = 1.0, free_length = 1.25 }]
guided_spring = [{ point = "m", direction = [0, 0, 1], stiffness = "k" }]
force = [{ point = "m", components = [0, 0, "F"] }]
"""


class LimitPoints(VerdictTest):
    """A shallow spring of stiffness 1, free length 1.25 over the span 1, that a spring k holds: F = (1 + k - 1.25 / l) z with
    l^2 = 1 + z^2. Its two folds fall together at z = F = 0 where k = 1.25 - 1."""

    def trace_with(self, *options):
        self.write("snap.toml", SNAP_THROUGH)
        self.run_well("trace", "snap.toml", "-o", "snap.h5", "--force", "--quiet", *options)
        return "snap.h5"

    def test_a_cusp_is_a_cusp(self):
        for ends in (("--from=-0.77", "--to=0.6"), ("--from=1", "--to=-0.7")):
            for tolerance in (1e-6, 1e-7, 1e-8):
                with self.subTest(ends=ends, tolerance=tolerance):
                    file = self.trace_with(*ends, "--tolerance", tolerance)
                    (cusp,) = self.places(file, "cusp")
                    self.assertLess(abs(cusp), 1e-9)
                    self.assertEqual(self.places(file, "fold"), [])
                    with h5py.File(self.folder / file) as loci:
                        self.assertTrue(np.isnan(loci["event_shift"][:]).all())   # it becomes two folds, or none
                    self.run_well("verify", file)

    def test_folds_beside_a_cusp_are_folds(self):
        for k in (0.24, 0.249999):
            with self.subTest(k=k):
                file = self.trace_with("--set", f"k={k}", "--tolerance", 1e-8)
                z = math.sqrt((1.25 / (1 + k)) ** (2 / 3) - 1)   # F' = 1 + k - 1.25 / l^3 = 0
                load = (1 + k - 1.25 / math.hypot(1, z)) * z
                found = self.places(file, "fold")
                self.assertEqual(len(found), 2)
                for one, expected in zip(found, (-abs(load), abs(load))):
                    self.assertLess(abs(one - expected), 1e-12 + 1e-8 * abs(load))
                self.assertEqual(self.places(file, "cusp"), [])

    def test_a_stiffer_spring_has_neither(self):
        file = self.trace_with("--set", "k=0.2501")
        self.assertEqual(self.places(file, "fold", "cusp"), [])


class UndampedBoundaries(VerdictTest):
    def boundary(self, scene, *options):
        self.run_well("boundary", scene, "-o", "boundary.h5", "--force", "--quiet", *options)
        return self.open("boundary.h5")

    def test_flutter_without_damping_is_followed(self):
        # Squares of frequencies of K = [[1 + q / 5, p], [-p, 3]] meet where p is half the difference of its diagonal.
        self.write("pair.toml", """
            parameters = { p = 0, q = 0 }
            trace = { parameter = "p", from = 0, to = 3, tolerance = 1e-8 }
            [matrix_family]
            M = [[[1, 0], [0, 1]]]
            K = [[["1 + q / 5", 0], [0, 3]], [[0, 1], [-1, 0]]]
            """)
        with self.boundary("pair.toml", "--second", "q", "--second-from", 0, "--second-to", 2) as found:
            self.assertEqual(len(found["curve_points"]), 1)
            self.assertEqual(found.attrs["status"], "completed")
            for p, q, s in zip(found["p"][:], found["q"][:], found["eigenvalue"][:]):
                self.assertLess(abs(p - (1 - q / 10)), 1e-8)
                self.assertLess(abs(s ** 2 + (4 + q / 5) / 2), 1e-6)

    def test_a_stiffness_that_is_lost_without_damping_is_followed(self):
        # det K = (2 + q - 3/2 p) (4 - q - p) - 0.09 = 0; a pendulum that is turned about the vertical leaves it at sqrt(g / length).
        self.write("column.toml", """
            parameters = { p = 2, q = 0 }
            trace = { parameter = "p", from = 2, to = 0, tolerance = 1e-8 }
            [matrix_family]
            M = [[[1, 0], [0, 1]]]
            K = [[["2 + q", 0.3], [0.3, "4 - q"]], [[-1.5, 0], [0, -1]]]
            """)
        pendulum = (SCENES / "whirling_pendulum.toml").read_text(encoding="utf-8")
        self.write("pendulum.toml", edited(pendulum, "branch = 2", "branch = 1"))
        determinant = lambda p, q: (2 + q - 1.5 * p) * (4 - q - p) - 0.09
        for scene, p, q, begin, end, residual in (
                ("column.toml", "p", "q", -0.5, 0.5, determinant),
                ("pendulum.toml", "omega", "length", 0.3, 1, lambda omega, length: omega**2 * length / 9.81 - 1)):
            with self.subTest(scene), self.boundary(scene, "--second", q, "--second-from", begin, "--second-to", end) as found:
                self.assertEqual(found["curve_kind"][:].tolist(), [b"divergence"])
                self.assertEqual(found["other_unstable"][:].tolist(), [0] * len(found[p]))
                self.assertEqual((min(found[q][:]), max(found[q][:])), (begin, end))
                for place in zip(found[p][:], found[q][:]):
                    self.assertLess(abs(residual(*place)), 1e-7)

    def test_beside_a_coalescence_no_flutter_is_looked_for(self):
        # Ziegler's column with springs k, without damping: the load is (7/2 - sqrt(2)) k.
        self.write("links.toml", """
            parameters = { load = 0, k = 1, c = 0 }
            trace = { parameter = "load", from = 0, to = 5, tolerance = 1e-8 }
            [matrix_family]
            M = [[[3, 1], [1, 1]]]
            C = [[["2 * c", "-c"], ["-c", "c"]]]
            K = [[["2 * k - load", "load - k"], ["-k", "k"]]]
            """)
        with self.boundary("links.toml", "--second", "k", "--second-from", 0.5, "--second-to", 2) as found:
            self.assertEqual(found.attrs["status"], "completed")
            self.assertEqual(len(found["curve_points"]), 1)
            np.testing.assert_allclose(found["load"][:], (3.5 - 2**0.5) * found["k"][:], rtol=1e-8)

    def test_gyroscopic_stabilization_is_followed(self):
        # x'' - 2 W y' - x = 0, y'' + 2 W x' - b y = 0 is stable above W = (1 + sqrt(b)) / 2, where s^4 = b.
        self.write("gyroscopic.toml", """
            parameters = { W = 1, b = 1 }
            trace = { parameter = "W", from = 0.5, to = 3, tolerance = 1e-8 }
            [matrix_family]
            M = [[[1, 0], [0, 1]]]
            C = [[[0, 0], [0, 0]], [[0, -2], [2, 0]]]
            K = [[[-1, 0], [0, "-b"]]]
            """)
        with self.boundary("gyroscopic.toml", "--second", "b", "--second-from", 1.5, "--second-to", 4) as found:
            self.assertEqual(len(found["curve_points"]), 1)
            for W, b, s in zip(found["W"][:], found["b"][:], found["eigenvalue"][:]):
                self.assertLess(abs(W - (1 + math.sqrt(b)) / 2), 1e-8)
                self.assertLess(abs(s ** 4 - b), 1e-6)

    def test_the_undamped_limit_is_another_one(self):
        # Ziegler's column: with damping it flutters above 41 / 28, however small the damping is; without it above that.
        with self.boundary(SCENES / "ziegler_column.toml", "--second", "damping", "--second-from", 0, "--second-to", 1) as found:
            self.assertEqual(len(found["curve_points"]), 1)
            self.assertAlmostEqual(min(found["load"][:]), 41 / 28, delta=1e-6)
            self.assertIn("onset of flutter without damping", str(found.attrs["notes"]))


class Names(VerdictTest):
    def test_modes_keep_their_names_where_a_column_buckles(self):
        file = self.trace_model("slender_column")
        names = self.info(file)["mode_names"]
        self.assertEqual(names[:2], ["1st lag", "2nd lag"])
        self.assertEqual(len(names), 3, "the motion back from the straight column begins there")

    def test_without_torsion_nothing_is_called_so(self):
        names = self.info(self.trace_model("pinned_shaft"))["mode_names"]
        self.assertTrue(all("torsion" not in name and "bending" in name for name in names), names)


if __name__ == "__main__":
    unittest.main()
