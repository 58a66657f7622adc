"""Bodies that nothing holds: their zeros are exact, and have names."""

import unittest

import h5py
import numpy as np

from scene_test_case import SceneTest

HEAD = """
parameters = { k = { value = 1000.0, unit = "N/m" } }
trace = { parameter = "k", from = 500, to = 2000 }
"""

BODY = HEAD + """
[[body]]
name = "hull"
mass = 5
inertia = [1, 2, 3]
position = [0, 0, 0]
CENTRE
[[spring]]
from = [0, 0, -1]
to = "hull"
stiffness = "k"
free_length = 1
"""

MASSES = HEAD + """
[[point]]
name = "a"
mass = 2
position = [0, 0, 0]
[[point]]
name = "b"
mass = 3
position = [1, 0, 0]
[[spring]]
from = "a"
to = "b"
stiffness = "k"
free_length = 1
"""

SKEW = """
x_axis = [1, 0.2, 0.1]
y_axis = [0, 1, 0.3]
"""

# Of a body on a hinge with a torsional spring, and of one that nothing holds.
HINGED = HEAD.replace("N/m", "N m/rad") + """
[[body]]
name = "door"
mass = 1
inertia = [0.1, 0.15, 0.2]
position = [0, 0, 0]
[[body]]
name = "hull"
mass = 1
inertia = [0.1, 0.15, 0.2]
position = [2, 0, 0]
AXES
[[revolute]]
name = "hinge"
from = [-0.6, 0.3, 0.6]
to = { body = "door", at = [-0.6, 0.3, 0.6] }
axis = [0, 0, 1]
[[torsional_spring]]
joint = "hinge"
stiffness = "k"
"""

# A body on a ball joint and one spring, and a point on a spring that is constant.
PIVOTED = HEAD + """
[[point]]
name = "ball"
mass = 0.3
position = [0, 1, 0]
[[body]]
name = "arm"
mass = 1
inertia = [0.1, 0.15, 0.2]
position = [0, 0, 0]
AXES
[[spring]]
from = [0, 0, 1]
to = { body = "arm", at = [0.4, 0, 0] }
stiffness = "k"
free_length = 1
[[spring]]
from = "ball"
to = "arm"
stiffness = 50
free_length = 1
[[ball]]
from = [0, 0, 0]
to = "arm"
"""


def spectrum(file):
    """Eigenvalues at all nodes, and what moves in the modes."""
    with h5py.File(file) as loci:
        return loci["k"][:], loci["eigenvalue"][:], [name.decode() for name in loci["mode_name"][:]]


class FreeBodies(SceneTest):
    def test_a_body_on_one_spring(self):
        """It moves freely but along the spring: five double zeros."""
        k, s, names = spectrum(self.trace_text(BODY.replace("CENTRE", ""), tolerance=1e-8))
        zeros = np.all(s == 0.0, axis=0)
        self.assertEqual(np.count_nonzero(zeros), 10)
        self.assertEqual({name.rsplit(" ", 1)[0] for name, zero in zip(names, zeros) if zero},
                         {"along x", "along y", "about x", "about y", "about z"})
        np.testing.assert_allclose(s[:, ~zeros].ravel(), 1j * np.sqrt(k / 5.0), rtol=1e-8)

    def test_a_body_whose_centre_is_elsewhere(self):
        """Displacement and rotation are coupled by the mass; zeros remain exact."""
        k, s, _ = spectrum(self.trace_text(BODY.replace("CENTRE", "centre = [0.3, 0.2, 0]"), tolerance=1e-8))
        self.assertEqual(np.count_nonzero(np.all(s == 0.0, axis=0)), 10)

    def test_two_masses_and_a_spring(self):
        k, s, names = spectrum(self.trace_text(MASSES, tolerance=1e-8))
        zeros = np.all(s == 0.0, axis=0)
        self.assertEqual(np.count_nonzero(zeros), 10)
        np.testing.assert_allclose(s[:, ~zeros].ravel(), 1j * np.sqrt(k * (1 / 2 + 1 / 3)), rtol=1e-8)
        text = self.run_well("trace", self.folder / "scene.toml", "-o", "again.h5")
        self.assertIn("identity of modes certified on every step", text)
        self.assertIn("zero throughout", text)

    def test_beside_a_body_on_a_hinge(self):
        """Reactions have the rounding of the largest one; the stiffness that this causes holds no body."""
        inertia = 0.2 + 0.6**2 + 0.3**2
        for axes in ("", SKEW):
            k, s, _ = spectrum(self.trace_text(HINGED.replace("AXES", axes), tolerance=1e-8))
            zeros = np.all(s == 0.0, axis=0)
            self.assertEqual(np.count_nonzero(zeros), 12)
            np.testing.assert_allclose(s[:, ~zeros].ravel(), 1j * np.sqrt(k / inertia), rtol=1e-8)
            listed = self.run_well("spectrum", self.folder / "scene.toml", "--modes", "all", "--csv").splitlines()[1:]
            self.assertEqual(sum(",0,0," in line for line in listed), 12)

    def test_beside_a_body_on_a_ball_joint(self):
        for axes in ("", SKEW):
            _, s, _ = spectrum(self.trace_text(PIVOTED.replace("AXES", axes), tolerance=1e-8))
            self.assertEqual(s.shape[1], 10)
            self.assertEqual(np.count_nonzero(np.all(s == 0.0, axis=0)), 8)
            self.run_well("verify", self.folder / "loci.h5")

    def test_explain_names_what_is_free(self):
        (self.folder / "hull.toml").write_text(BODY.replace("CENTRE", ""))
        text = self.run_well("explain", "hull.toml")
        self.assertIn("Free to move, with eigenvalues zero throughout: along x, along y, ", text)
        self.assertIn("a spring, a joint or another constraint holds them", text)

    def test_a_held_body_is_not_free(self):
        (self.folder / "held.toml").write_text(MASSES + "".join(f"""
[[spring]]
from = [{x}, {y}, {z}]
to = "{to}"
stiffness = 100
free_length = 1
""" for to, at in (("a", 0), ("b", 1)) for x, y, z in ((at, 1, 0), (at, 0, 1), (2 * at - 1 + at, 0, 0))))
        self.assertNotIn("Free to move", self.run_well("explain", "held.toml"))


if __name__ == "__main__":
    unittest.main()
