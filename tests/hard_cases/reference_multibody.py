#!/usr/bin/python3
"""Special points of the rotating point mass (seed paper, Sect. 6.3, Eq. 144) in 40-digit arithmetic.

    /usr/bin/python3 reference_multibody.py

With L = 2 lambda and D = L - m w^2 the steady equations are solved by
    {x, y, z} = m w^2 e {D L, a_t L, a_n D} / (L (D^2 + a_t^2) + a_n^2 D),
and x^2 + y^2 + z^2 = l^2 is left for lambda. Along a_t the path is described by lambda instead: the same equation is
a quadratic for a_t^2, which has no fold there.
"""
import mpmath as mp
import numpy as np

from reference_methods import Expressions, double_eigenvalues, line, number, report

m, l, e, a_n = 50.0, 5.0, 1.0, 1000.0


def position(lam, w, a_t):
    L = 2 * lam
    D = L - m * w * w
    factor = m * w * w * e / (L * (D * D + a_t * a_t) + a_n * a_n * D)
    return factor * D * L, factor * a_t * L, factor * a_n * D


def pencil(lam, w, a_t, r, pivot):
    """T^T (.) T with a T that is analytic in the parameter and spans the tangent plane where the pivot, coordinate 0
    or 1, is not zero."""
    x, y, z = position(lam, w, a_t)
    T = [[-y, -z], [x, 0 * x], [0 * x, x]] if pivot == 0 else [[y, 0 * y], [-x, -z], [0 * y, y]]
    c, k = 2 * m * w, 2 * lam - m * w * w
    M = [[m, 0, 0], [0, m, 0], [0, 0, m]]
    C = [[r, -c, 0], [c, r, 0], [0, 0, r]]
    K = [[k, a_t, a_n], [-a_t, k, 0], [-a_n, 0, 2 * lam]]
    project = lambda B: [[sum(T[i][a] * B[i][j] * T[j][b] for i in range(3) for j in range(3)) for b in range(2)]
                         for a in range(2)]
    return project(M), project(C), project(K)


class AlongSpeed(Expressions):
    """Parameter w: the equilibrium of largest lambda, analytic for |Im w| < 0.65 (folds at 6.948 +- 0.659 i)."""

    def __init__(self, begin, end, r, reach, a_t=-100.0):
        self.r, self.a_t, self.memory = r, a_t, {}
        super().__init__(begin, end, self.matrices, reach=reach)

    def matrices(self, w, arithmetic):
        lam = self.multiplier(complex(w))
        if arithmetic is mp:
            lam = mp.findroot(lambda v: self.length_error(v, w), mp.mpc(lam))
        return pencil(lam, w, self.a_t, self.r, 0)

    def length_error(self, lam, w):
        return sum(c * c for c in position(lam, w, self.a_t)) / (l * l) - 1

    def multiplier(self, w):
        real = w.real
        low, high = 0.5 * m * real**2 * (1 + 1e-12), m * real**2 + 1e6
        while high - low > 1e-13 * high:  # the largest root: the error falls to -1 from here on
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.length_error(middle, real).real > 0 else (low, middle)
        lam = complex(high)
        steps, at = 20, real
        for step in range(1, steps + 1):
            lam -= 0.5 * m * at**2  # D changes little
            at = complex(real, w.imag * step / steps)
            lam += 0.5 * m * at**2
            for _ in range(8):
                h = 1e-7 * abs(lam)
                f = self.length_error(lam, at)
                slope = (self.length_error(lam + h, at) - self.length_error(lam - h, at)) / (2 * h)
                lam -= f / slope
        return lam


class AlongMultiplier(Expressions):
    """The path of a_t through the fold at w = 40; parameter lambda, a_t = -sqrt(q(lambda))."""

    def __init__(self, begin, end, r):
        self.r, self.w = r, 40.0
        super().__init__(begin, end, lambda v, arithmetic: pencil(v, self.w, self.a_t(v, arithmetic), self.r, 1))

    def a_t(self, lam, arithmetic):
        # l^2 (L D^2 + L q + a_n^2 D)^2 = (m w^2 e)^2 (L^2 D^2 + q L^2 + a_n^2 D^2), the larger root q
        L = 2 * lam
        D = L - m * self.w**2
        c, base = (m * self.w**2 * e / l) ** 2, L * D * D + a_n * a_n * D
        b, a0 = 2 * L * base - c * L * L, base * base - c * D * D * (L * L + a_n * a_n)
        root = arithmetic.sqrt(b * b - 4 * L * L * a0)
        return -arithmetic.sqrt((-b + root) / (2 * L * L))


def fold():
    path = AlongMultiplier(40000, 39990, 2.0)
    lam = mp.findroot(lambda v: mp.diff(lambda u: path.a_t(u, mp), v), mp.mpf(39993.7))
    print("    fold at a_t = %s, lambda = %s" % (number(path.a_t(lam, mp), 25), number(lam, 25)))
    M, C, K = path.wide(lam)
    print("    det K there: %s" % mp.nstr(mp.det(K) / mp.norm(K) ** 2, 5))


if __name__ == "__main__":
    for name, family in (("C01 r = 2", AlongSpeed(100, 5, 2.0, 0.005)), ("C01 r = 20", AlongSpeed(100, 5, 20.0, 0.005)),
                         ("C02", AlongSpeed(20, 6, 500.0, 0.035))):
        family.damped = True
        report(name, family)
    path = AlongMultiplier(47995.0, 31991.4, 2.0)
    path.damped, path.reach, path.overhang = True, 0.005, 0.0  # a_t = 0 is a branch point
    report("C03, along lambda", path)
    for p, s in double_eigenvalues(path):
        print("    %s" % line("collision", mp.re(path.a_t(p, mp)), s))
    fold()
