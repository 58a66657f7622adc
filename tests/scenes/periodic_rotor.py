"""Small motions of a rotor on a hub, derived blade by blade in the frame that stands, without multiblade coordinates: the
coefficients are periodic in time. Floquet multipliers by numerical integration over one revolution.

A particle at p(q, t) obeys sum m (dp/dq) . p'' = Q. With p = p0 + J q + q H q / 2, to first order in q,

    sum m [ J^T (J q'' + 2 J' q' + J'' q) + (H q)^T (p0'' - g) ] + C q' + K q = 0

The hub shifts by x, y and turns about x and y at the height 0; the blades are particles on rods, at r from hinges at the
radius e and the height h. They flap up by beta and then lag forward by zeta about an axis that flaps."""

import numpy as np


def cross(axis):
    x, y, z = axis
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


TURNS = [cross([1.0, 0, 0]), cross([0, 1.0, 0])]
SPIN = cross([0, 0, 1.0])
SHIFTS = [np.array([1.0, 0, 0]), np.array([0, 1.0, 0])]


def on_a_line(mass, first, second):
    """Two particles with these moments about the hinge."""
    r = second / first
    return [(first / r, r), (mass - first / r, 0.0)]


class PeriodicRotor:
    """Degrees of freedom: x, y, roll, pitch, then flap and lag of each blade; `free` selects those that exist. `particles`
    are pairs of mass and r, `flap` is the steady flap angle under gravity, and M, C, K begin with those of the support and
    of hinges."""

    def __init__(self, blades, speed, hinge, height, particles, free, flap=0.0, gravity=0.0):
        self.blades, self.speed, self.hinge, self.height = blades, speed, hinge, height
        self.particles, self.flap, self.free, self.gravity = particles, flap, free, gravity
        n = 4 + 2 * blades
        self.M, self.C, self.K = np.zeros((n, n)), np.zeros((n, n)), np.zeros((n, n))

    def on_blade(self, r):
        """Place of a particle in the blade's axes, its derivatives by (flap, lag), and the second ones."""
        b = self.flap
        place = np.array([self.hinge + r * np.cos(b), 0, r * np.sin(b)])
        first = [r * np.array([-np.sin(b), 0, np.cos(b)]), r * np.array([0, 1.0, 0])]
        outward = r * np.array([np.cos(b), 0, np.sin(b)])
        second = {(0, 0): -outward, (1, 1): -outward, (0, 1): np.zeros(3)}
        return place, first, second

    def matrices(self, t):
        M, C, K = self.M.copy(), self.C.copy(), self.K.copy()
        W = self.speed * SPIN
        for k in range(self.blades):
            psi = self.speed * t + 2 * np.pi * k / self.blades
            turn = np.array([[np.cos(psi), -np.sin(psi), 0], [np.sin(psi), np.cos(psi), 0], [0, 0, 1]])
            dof = [0, 1, 2, 3, 4 + 2 * k, 5 + 2 * k]
            for mass, r in self.particles:
                place, first, second = self.on_blade(r)
                place, first = turn @ place, [turn @ v for v in first]
                up = np.array([0, 0, self.height])
                J = np.array([*SHIFTS, *(T @ (place + up) for T in TURNS), *first]).T
                rate = np.array([*(2 * [np.zeros(3)]), *(T @ W @ place for T in TURNS), *(W @ v for v in first)]).T
                growth = np.array([*(2 * [np.zeros(3)]), *(T @ W @ W @ place for T in TURNS), *(W @ W @ v for v in first)]).T
                inward = W @ W @ place + np.array([0, 0, self.gravity])
                H = np.zeros((6, 6))
                for i, a in enumerate(TURNS):
                    for j, b in enumerate(TURNS):
                        H[2 + i, 2 + j] = inward @ (0.5 * (a @ b + b @ a) @ (place + up))
                    for j in range(2):
                        H[2 + i, 4 + j] = H[4 + j, 2 + i] = inward @ a @ first[j]
                for (i, j), v in second.items():
                    H[4 + i, 4 + j] = H[4 + j, 4 + i] = inward @ turn @ v
                M[np.ix_(dof, dof)] += mass * J.T @ J
                C[np.ix_(dof, dof)] += 2 * mass * J.T @ rate
                K[np.ix_(dof, dof)] += mass * (J.T @ growth + H)
        keep = np.ix_(self.free, self.free)
        return M[keep], C[keep], K[keep]

    def multipliers(self, steps=2000):
        """Floquet multipliers of one revolution, by the classical Runge-Kutta method. The matrices have the harmonics 0 to 2
        of the azimuth, so eight samples give them at all times."""
        n, period = len(self.free), 2 * np.pi / self.speed
        times = np.arange(2 * steps + 1) * (0.5 / steps)
        waves = np.exp(2j * np.pi * np.outer(times, np.fft.fftfreq(8, 1 / 8)))
        samples = [np.array(part) for part in zip(*(self.matrices(period * i / 8) for i in range(8)))]
        M, C, K = (np.tensordot(waves, np.fft.fft(part, axis=0) / 8, 1).real for part in samples)
        system = np.zeros((len(times), 2 * n, 2 * n))
        system[:, :n, n:] = np.eye(n)
        system[:, n:, :n], system[:, n:, n:] = -np.linalg.solve(M, K), -np.linalg.solve(M, C)
        h, X = period / steps, np.eye(2 * n)
        for i in range(steps):
            begin, middle, end = system[2 * i:2 * i + 3]
            k1 = begin @ X
            k2 = middle @ (X + 0.5 * h * k1)
            k3 = middle @ (X + 0.5 * h * k2)
            k4 = end @ (X + h * k3)
            X = X + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        return np.linalg.eigvals(X)
