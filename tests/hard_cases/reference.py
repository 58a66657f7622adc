#!/usr/bin/python3
"""Special points of the hard cases in 40-digit arithmetic: prints the numbers that the catalogue's files hold.

    /usr/bin/python3 reference.py [name ...]        needs numpy and mpmath; without names: every case

The multibody scenes are in reference_multibody.py.
"""
import sys

import mpmath as mp
import numpy as np

from reference_methods import Expressions, Family, report

I1, I2, I3, I4 = np.eye(1), np.eye(2), np.eye(3), np.eye(4)
Z1, Z2, Z3, Z4 = 0 * I1, 0 * I2, 0 * I3, 0 * I4
J = np.array([[0.0, -1.0], [1.0, 0.0]])
A = lambda *rows: np.array(rows, dtype=float)
one = mp.mpc(0, 1)  # s of the mode with unit stiffness and mass
cases = {}


def case(name, family, damped):
    family.damped = damped
    cases[name] = family


# ---- the listed families ----
for eps in (1e-2, 1e-4, 1e-6, 1e-9, 1e-12):
    case("H01 %g" % eps, Family(-0.5, 0.5, [I2], [Z2], [A([1, eps], [eps, 1]), A([1, 0], [0, -1])]), False)
case("H05", Family(0, 1, [I2], [Z2], [A([1, 0], [0, 2]), -J]), False)


def damping_of_h07(p, m):
    return [[1.0]], [[2 * (1 + 0.5 * m.cos(p))]], [[1.0]]


case("H07", Expressions(0, 2 * np.pi, damping_of_h07), True)


def ziegler(b):
    C = b * A([2, -1], [-1, 1])
    return Family(0, 3, [A([3, 1], [1, 1])], [C], [A([2, -1], [-1, 1]), A([-1, 1], [0, 0])])


case("H08", ziegler(0.0), False)
for b in (1e-4, 1e-2, 1.0):
    case("H09 %g" % b, ziegler(b), True)
case("H10", Family(3, 1, [I2], [Z2, J], [-I2]), False)
start = -0.015 + one * mp.sqrt(1 - mp.mpf(0.03) ** 2 / 4)
case("H11", Family(0, 6, [I2], [0.03 * I2], [I2, -0.01 * J], [("crossing", 0, start, 4)]), True)
case("H12", Family(0, 6, [I2], [0.03 * I2], [A([1.02, 0], [0, 0.98]), -0.01 * J]), True)


def ground_resonance(cz, cx, cy, end):
    Sb, Ib, h = 65.0, 800.0, 2.0
    M = A([Ib, 0, 0, -Sb], [0, Ib, Sb, 0], [0, h * Sb, 576, 0], [-h * Sb, 0, 0, 251])
    lag = np.zeros((4, 4))
    lag[0, 1], lag[1, 0] = 1.0, -1.0
    return Family(5, end, [M], [np.diag([cz, cz, cx, cy]), 2 * Ib * lag],
                  [np.diag([0, 0, 85000.0, 85000.0]), cz * lag, np.diag([Sb - Ib, Sb - Ib, 0, 0])])


case("H13", ground_resonance(0, 0, 0, 40), False)
case("H14", ground_resonance(300, 350, 175, 40), True)
case("H15", ground_resonance(3000, 3500, 1750, 60), True)


def flap_lag(t, m):
    ga, sg, cd, a, p2 = 5.0, 0.05, 0.01, 2 * m.pi, 4 / (3 + 0 * m.pi)
    inflow = m.pi * sg / 8 * (m.sqrt(1 + 12 * t / (m.pi * sg)) - 1)
    b0 = ga / 8 * (t - inflow) / p2
    C = [[ga / 8, 2 * b0 - ga / 8 * (2 * t - inflow)],
         [-2 * b0 + ga / 8 * (t - 2 * inflow), ga / 8 * (2 * cd / a + t * inflow)]]
    return [[1.0, 0.0], [0.0, 1.0]], C, [[p2, 0.0], [0.0, p2]]


case("H16", Expressions(0.01, 0.5, flap_lag), True)
case("H17", Family(0, 1.5, [I1], [0.1 * I1], [I1, -I1]), True)
case("H18", Family(0, 1.5, [I1], [Z1], [I1, -I1]), False)
case("H20", Family(0, 1.5, [I1, -I1], [0.5 * I1], [I1]), True)


def blades(n=8, kappa=0.05):
    shift = np.roll(np.eye(n), 1, 0)
    K0 = (1 + 2 * kappa) * np.eye(n) - kappa * (shift + shift.T)
    D = np.diag([float(mp.sin(3 * j + 1)) for j in range(n)])
    known = []
    for k in (1, 2, 3):
        mu = mp.mpf(1 + 2 * kappa) - 2 * mp.mpf(kappa) * mp.cos(2 * mp.pi * k / n)
        known.append(("crossing", 0, -mp.mpf(0.005) + one * mp.sqrt(mu - mp.mpf(0.01) ** 2 / 4), 4))
    return Family(0, 0.2, [np.eye(n)], [0.01 * np.eye(n)], [K0, D], known)


case("H21", blades(), True)
case("H22", Family(-0.1, 0.1, [I3], [Z3], [A([1, -1, 0], [-1, 2, -1], [0, -1, 1]), np.diag([1.0, 0, 0])]), False)


def pipe(n=8, beta=0.2):
    lam = [mp.findroot(lambda x: mp.cos(x) * mp.cosh(x) + 1, (k - 0.5) * mp.pi) for k in range(1, n + 1)]
    sig = [(mp.sinh(x) - mp.sin(x)) / (mp.cosh(x) + mp.cos(x)) for x in lam]
    b, c = np.zeros((n, n)), np.zeros((n, n))
    for s in range(n):
        for r in range(n):
            sign, ratio = (-1) ** (r + s), (lam[s] / lam[r]) ** 2
            if s == r:
                b[s, r], c[s, r] = 2.0, float(lam[r] * sig[r] * (2 - lam[r] * sig[r]))
            else:
                b[s, r] = float(4 / (ratio + sign))
                c[s, r] = float(4 * (lam[r] * sig[r] - lam[s] * sig[s]) / (sign - ratio))
    Z = np.zeros((n, n))
    damping = np.array([[float(2 * mp.sqrt(mp.mpf(beta)) * mp.mpf(x)) for x in row] for row in b])
    return Family(0, 8, [np.eye(n)], [Z, damping], [np.diag([float(x**4) for x in lam]), Z, c])


case("H23", pipe(), True)

# ---- own cases ----
k = 1e-3
cluster = A([1 + 2 * k, -k, -k], [-k, 1 + 2 * k + 2e-4, -k], [-k, -k, 1 + 2 * k - 1.5e-4])
case("three_blade_cluster", Family(-0.02, 0.02, [I3], [0.002 * I3], [cluster, np.diag([1, -0.4, -0.6])]), True)
two_partners = A([1, 1e-4, 1e-4], [1e-4, 0.99, 0], [1e-4, 0, 1.01])
case("two_veerings_two_partners", Family(-0.5, 0.5, [I3], [Z3], [two_partners, np.diag([1.0, 0, 0])]), False)
case("two_veerings_same_pair",
     Family(-0.5, 0.5, [I2], [Z2], [A([0.9975, 1e-5], [1e-5, 1]), Z2, np.diag([1.0, 0])]), False)
# x3 = p x1 eliminated with T = [[1, 0], [0, 1], [p, 0]]
case("constrained_exceptional_point",
     Family(0, 1, [I2, Z2, np.diag([1.0, 0])], [Z2],
            [A([1, 0], [0, 2]), A([0, 2], [-2, 0]), A([0.5, -0.3], [0.3, 0])]), False)
case("hamiltonian_hopf", Family(4, 0.2, [I2], [Z2, J], [np.diag([-1.0, -2.0])]), False)
# Damping d of the first coordinate that puts the exceptional point at the wanted distance from the real axis.
for b, d in ((1e-1, 0.21818926174404107), (1e-3, 0.002177324669416801), (1e-5, 2.1773242158526304e-05),
             (1e-8, 2.1773242158072697e-08)):
    case("near_exceptional %g" % b, Family(0, 1.5, [I2], [np.diag([d, d / 4])], [A([1, 0], [0, 2]), -J]), True)


def rotor(nd=6, ci=0.002, ce=0.01, aniso=0.02):
    T = 2 * np.eye(nd) - np.eye(nd, k=1) - np.eye(nd, k=-1)
    g = np.diag([0.16523937077237263, 0.21244434678543145, 0.0872714216738833,
                 0.1532482815592989, 0.2678840863042964, 0.2688879266800314])
    G, Kc = np.kron(g, -J), np.kron(ci * T, -J)
    M = np.kron(np.diag([1, 1.1, 1.2, 1.3, 1.4, 1.5]), I2)
    return Family(0, 6, [M], [np.kron(ci * T, I2) + ce * np.eye(2 * nd), G],
                  [np.kron(T, np.diag([1 + aniso, 1 - aniso])), Kc], reach=0.02)


case("rotor_12", rotor(), True)
cases["rotor_12"].overhang = 0.0  # exceptional points at p < 0 mirror those close to p = 0
case("frequencies_cross_dampings_veer",
     Family(-0.5, 0.5, [I2], [np.diag([0.06, 0.04])], [A([1, 0.006], [0.006, 1]), A([1, 0], [0, -1])]), True)
U = A([1, 1], [0, 1])
case("overdamped_crossing",
     Family(0, 1, [U.T @ U], [U.T @ np.diag([5, 7.5]) @ U, U.T @ np.diag([2.0, -2.0]) @ U],
            [U.T @ np.diag([4.0, 11.0]) @ U, U.T @ np.diag([5, -7.5]) @ U, U.T @ U],
            [("crossing", 0.5, -1.5, 2), ("crossing", 0.75, -4.75, 2)]), True)
U = A([1, 1, 0, 0], [0, 1, 1, 0], [0, 0, 1, 1], [0, 0, 0, 1])
case("triple_crossing",
     Family(-0.5, 0.5, [U.T @ U], [Z4],
            [U.T @ np.diag([1.0, 1, 1, 2]) @ U, U.T @ np.diag([1, -1, 0.5, 0]) @ U], [("crossing", 0, one, 12)]), False)
case("graded_veering",
     Family(-0.1, 0.1, [I4], [Z4],
            [A([1e-6, 1e-9, 0, 0], [1e-9, 1e-6, 1e-4, 0], [0, 1e-4, 1, 1e2], [0, 0, 1e2, 1e6]),
             np.diag([1e-6, -1e-6, 0, 0])]), False)
case("whirl_through_zero", Family(0.5, 1.5, [I2], [Z2, 2 * J], [I2, Z2, -I2], [("crossing", 1, 0, 2)]), False)
case("whirl_anisotropic", Family(0.5, 1.5, [I2], [Z2, 2 * J], [np.diag([0.9, 1.1]), Z2, -I2]), False)
case("whirl_damped", Family(0.5, 1.5, [I2], [0.05 * I2, 2 * J], [np.diag([0.9, 1.1]), Z2, -I2]), True)
case("tangent_divergence", Expressions(1, -0.5, lambda p, m: ([[1.0]], [[0.2]], [[m.tan(p)]])), True)
C, K = A([0.1, 0.05], [0.05, 0.4]), A([1, 0.2], [0.2, 1])
case("mass_through_zero", Family(1, -0.5, [np.diag([1.0, 0]), np.diag([0, 1.0])], [C], [K]), True)
case("mass_through_zero_undamped", Family(1, -0.5, [np.diag([1.0, 0]), np.diag([0, 1.0])], [Z2], [K], [("infinite", 0, 0, 1)]), False)
case("touching", Family(-0.5, 0.5, [I1], [2 * I1], [I1, Z1, I1], [("collision", 0, -1, 2)]), True)

if __name__ == "__main__":
    for name, family in cases.items():
        if len(sys.argv) == 1 or any(name.startswith(wanted) for wanted in sys.argv[1:]):
            report(name, family)
