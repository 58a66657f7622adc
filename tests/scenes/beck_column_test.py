"""Beck's column as a chain of rigid links: the spectrum of the chain, and its convergence to that of the column."""

import math
import unittest

import numpy as np

from rotor_test_case import RotorTest

LINKS = 8


def chain(n, load):
    """Mass and stiffness in the angles of n links against the column's axis; length, mass and EI are 1."""
    h = 1.0 / n
    M, K = np.zeros((n, n)), np.zeros((n, n))
    for i in range(n):
        centre = h * np.array([1.0] * i + [0.5] + [0.0] * (n - i - 1))
        M += h * np.outer(centre, centre)
        M[i, i] += h**3 / 12.0
        bend = np.zeros(n)
        bend[i] = 1.0
        if i:
            bend[i - 1] = -1.0
        K += (n if i else 2.0 * n) * np.outer(bend, bend)
    K -= load * h * np.eye(n)  # the load along the axis ...
    K[:, -1] += load * h       # ... and across it, with the slope of the last link
    return M, K


def spectrum(n, load):
    s = np.sqrt(-np.linalg.eigvals(np.linalg.solve(*chain(n, load))).astype(complex))
    return np.where(s.imag < 0.0, -s, s)


def beck():
    """Load where two roots w of Beck's equation meet: p^2 + 2 w^2 + p w sin a sinh b + 2 w^2 cos a cosh b (Beck 1952)."""
    def equation(p, w):
        root = np.sqrt(p * p / 4 + w * w)
        a, b = np.sqrt(root + p / 2), np.sqrt(root - p / 2)
        return p * p + 2 * w * w + p * w * np.sin(a) * np.sinh(b) + 2 * w * w * np.cos(a) * np.cosh(b)

    def slope(p, w):
        return equation(p, w + 1e-20j).imag / 1e-20

    x = np.array([20.0, 11.0])
    for _ in range(30):
        value = np.array([equation(*x), slope(*x)])
        step = 1e-6
        jacobian = np.array([[(f(*(x + step * e)) - f(*(x - step * e))) / (2 * step) for e in np.eye(2)]
                             for f in (equation, slope)])
        x = x - np.linalg.solve(jacobian, value)
    return x[0]


class BeckColumn(RotorTest):
    scene = "beck_column"

    def links(self, n):
        """The scene's text with n links instead of eight."""
        text = self.changed(links=n)
        link = "\n[[body]]\nname = \"link 1\""
        head, tail = text[:text.index(link)], text[text.index("\n[[follower_force]]"):]
        second = text[text.index("\n[[body]]\nname = \"link 2\""):text.index("\n[[body]]\nname = \"link 3\"")]
        first = text[text.index(link):text.index(second)]
        chain = first + "".join(second.replace("link 2", f"link {i}").replace("link 1.end", f"link {i - 1}.end")
                                .replace("hinge 2", f"hinge {i}").replace('["1*h"', f'["{i - 1}*h"')
                                for i in range(2, n + 1))
        return head + chain + tail.replace("link 8", f"link {n}")

    def test_the_text_for_eight_links_is_the_scene(self):
        self.assertEqual(self.links(LINKS), self.scene_text())

    def test_spectrum_of_the_chain_against_load(self):
        file = self.trace_scene("--to", "18")
        self.assert_follows(file, lambda load: spectrum(LINKS, load), "load", np.linspace(0, 18, 40))

    def test_spectrum_beyond_flutter(self):
        file = self.trace_scene()
        for load, s in zip((21.0, 25.0, 29.5), self.spectra(file, (21.0, 25.0, 29.5))):
            expected = spectrum(LINKS, load)
            self.assertEqual(np.sum(np.abs(expected.real) > 1e-3), 2)
            self.assert_same_spectrum(s, expected, message=f"load {load}")

    def flutter_load(self, n):
        """At the flutter load two frequencies meet and become a growing and a decaying pair."""
        file = self.trace_text(self.links(n), "--modes", "3", "--from", "15", "--to", "24", tolerance=1e-8)
        return min(load for load, s in self.special_points(file, "collision"))

    def test_flutter_load_of_the_chain(self):
        def apart(load):
            return np.max(np.abs(spectrum(LINKS, load).real)) < 1e-4
        low, high = 15.0, 24.0
        while high - low > 1e-7:
            middle = 0.5 * (low + high)
            low, high = (middle, high) if apart(middle) else (low, middle)
        self.assertAlmostEqual(self.flutter_load(LINKS), low, delta=1e-6)

    def test_flutter_load_converges_with_the_square_of_the_links(self):
        exact = beck()
        self.assertAlmostEqual(exact, 20.0509536, places=6)
        errors = [abs(self.flutter_load(n) - exact) for n in (5, 10, 20)]
        self.assertLess(errors[-1], 0.2)
        for coarse, fine in zip(errors, errors[1:]):
            self.assertAlmostEqual(math.log2(coarse / fine), 2.0, delta=0.2)

    def test_a_dead_load_buckles_instead(self):
        """Euler's load pi^2/4 of a clamped column, divergence, when the force keeps its direction."""
        force = self.scene_text()[self.scene_text().index("[[follower_force]]"):]
        dead = self.scene_text().replace(force, '[[force]]\npoint = "link 8.end"\ncomponents = ["-load", 0, 0]\n')
        file = self.trace_text(dead, "--to", "4", tolerance=1e-8)
        kinds = [(kind, p) for kind in ("divergence", "branch_point") for p, _ in self.special_points(file, kind)]
        self.assertTrue(kinds)
        self.assertAlmostEqual(kinds[0][1], math.pi**2 / 4, delta=0.02)


if __name__ == "__main__":
    unittest.main()
