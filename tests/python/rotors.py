"""A rotor of Timoshenko beam elements, assembled independently of the program, with the functions of a rotor of ROSS.

Friswell, Penny, Garvey & Lees, Dynamics of Rotating Machines (2010), example 5.9.1: a shaft of 1.5 m and 50 mm in six
elements, discs of 280 and 350 mm and 70 mm width at 0.5 and 1.0 m, bearings of 1 MN/m at both ends. Element matrices: ibid.,
section 5.4. Freedoms per node: x, y, z, alpha, beta, theta; z is the axis."""

import types

import numpy as np

E, G, RHO = 211e9, 81.2e9, 7810.0
LENGTH, DIAMETER, N_ELEMENTS = 1.5, 0.05, 6
DISCS = {2: (0.28, 0.07), 4: (0.35, 0.07)}  # node: diameter, width


class Bearing:
    """Constant coefficients, or tables over `frequency` that are interpolated linearly."""

    def __init__(self, n, k, c, tag, frequency=None):
        self.n, self.tag, self.frequency, self._k, self._c = n, tag, frequency, k, c

    def _at(self, coefficients, frequency):
        if self.frequency is None:
            return np.asarray(coefficients, float)
        return np.array([np.interp(frequency, self.frequency, one) for one in np.transpose(coefficients)])

    def K(self, frequency):
        kxx, kxy, kyx, kyy = self._at(self._k, frequency)
        return np.array([[kxx, kxy], [kyx, kyy]])

    def C(self, frequency):
        cxx, cxy, cyx, cyy = self._at(self._c, frequency)
        return np.array([[cxx, cxy], [cyx, cyy]])


class Rotor:
    number_dof, tag = 6, ""

    def __init__(self, bearings):
        self.bearing_elements = bearings
        self.disk_elements = [types.SimpleNamespace(n=n, tag=f"disc {i + 1}") for i, n in enumerate(DISCS)]
        self.ndof = 6 * (N_ELEMENTS + 1)
        self._M, self._K, self._G = (np.zeros((self.ndof, self.ndof)) for _ in range(3))
        for first in range(N_ELEMENTS):
            self._add_element(first)
        for n, (diameter, width) in DISCS.items():
            self._add_disc(n, diameter, width)

    def M(self, frequency=None):
        return self._M.copy()

    def G(self):
        return self._G.copy()

    def K(self, frequency):
        return self._with_bearings(self._K, "K", frequency)

    def C(self, frequency):
        return self._with_bearings(np.zeros_like(self._K), "C", frequency)

    def A(self, speed=0.0):
        n, M = self.ndof, self.M()
        return np.block([[np.zeros((n, n)), np.eye(n)],
                         [-np.linalg.solve(M, self.K(speed)), -np.linalg.solve(M, self.C(speed) + speed * self.G())]])

    def _with_bearings(self, matrix, which, frequency):
        matrix = matrix.copy()
        for bearing in self.bearing_elements:
            place = slice(6 * bearing.n, 6 * bearing.n + 2)
            matrix[place, place] += getattr(bearing, which)(frequency)
        return matrix

    def _add_element(self, first):
        L, A, I = LENGTH / N_ELEMENTS, np.pi * DIAMETER ** 2 / 4, np.pi * DIAMETER ** 4 / 64
        nu = E / (2 * G) - 1
        kappa = 6 * (1 + nu) / (7 + 6 * nu)  # Cowper (1966), solid circular section
        f = 12 * E * I / (kappa * G * A * L ** 2)
        stiffness = E * I / (L ** 3 * (1 + f)) * _beam(12, 6 * L, -12, 6 * L, (4 + f) * L ** 2, (2 - f) * L ** 2)
        translation = RHO * A * L / (840 * (1 + f) ** 2) * _beam(
            312 + 588 * f + 280 * f ** 2, (44 + 77 * f + 35 * f ** 2) * L, 108 + 252 * f + 140 * f ** 2,
            -(26 + 63 * f + 35 * f ** 2) * L, (8 + 14 * f + 7 * f ** 2) * L ** 2, -(6 + 14 * f + 7 * f ** 2) * L ** 2)
        rotation = RHO * I / (30 * L * (1 + f) ** 2) * _beam(
            36, (3 - 15 * f) * L, -36, (3 - 15 * f) * L, (4 + 5 * f + 10 * f ** 2) * L ** 2,
            (-1 - 5 * f + 5 * f ** 2) * L ** 2)
        nodes = (6 * first, 6 * first + 6)
        xz = [at + offset for at in nodes for offset in (0, 4)]           # x and beta
        yz = [at + offset for at in nodes for offset in (1, 3)]           # y and -alpha
        sign = np.array([1.0, -1.0, 1.0, -1.0])
        flip = np.outer(sign, sign)
        for matrix, of_bending in ((self._K, stiffness), (self._M, translation + rotation)):
            matrix[np.ix_(xz, xz)] += of_bending
            matrix[np.ix_(yz, yz)] += flip * of_bending
        coupling = 2 * rotation * sign                                    # from y, alpha to x, beta
        self._G[np.ix_(xz, yz)] += coupling
        self._G[np.ix_(yz, xz)] -= coupling.T
        for offset, k, m in ((2, E * A, RHO * A), (5, 2 * G * I, 2 * RHO * I)):
            at = [node + offset for node in nodes]
            self._K[np.ix_(at, at)] += k / L * np.array([[1, -1], [-1, 1]])
            self._M[np.ix_(at, at)] += m * L / 6 * np.array([[2, 1], [1, 2]])

    def _add_disc(self, n, diameter, width):
        mass = RHO * width * np.pi * (diameter ** 2 - DIAMETER ** 2) / 4
        diametral = mass * (3 * (diameter ** 2 + DIAMETER ** 2) / 4 + width ** 2) / 12
        polar = mass * (diameter ** 2 + DIAMETER ** 2) / 8
        at = 6 * n + np.arange(6)
        self._M[at, at] += [mass, mass, mass, diametral, diametral, polar]
        self._G[at[3], at[4]] += polar
        self._G[at[4], at[3]] -= polar


def _beam(w, wt, w2, wt2, t, t2):
    """A symmetric 4 x 4 matrix for deflection and slope at both ends."""
    return np.array([[w, wt, w2, wt2], [wt, t, -wt2, t2], [w2, -wt2, w, -wt], [wt2, t2, -wt, t]])


def isotropic():
    return Rotor([Bearing(n, [1e6, 0, 0, 1e6], [0, 0, 0, 0], f"bearing {i + 1}") for i, n in enumerate((0, N_ELEMENTS))])


def anisotropic():
    return Rotor([Bearing(n, [1e6, 0, 0, 0.8e6], [200, 0, 0, 150], f"bearing {i + 1}") for i, n in enumerate((0, N_ELEMENTS))])


def speed_dependent():
    """Cross-coupled bearings with tables over the speed, smooth ones."""
    w = np.linspace(0, 500, 11)
    k = np.transpose([1e6 + 400 * w, 300 * w, -300 * w, 0.8e6 + 500 * w])
    c = np.transpose([250 - 0.1 * w, 0 * w, 0 * w, 200 - 0.1 * w])
    return Rotor([Bearing(n, k, c, f"bearing {i + 1}", w) for i, n in enumerate((0, N_ELEMENTS))])
