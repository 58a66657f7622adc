#!/usr/bin/python3
"""Special points of families of matrices in 40-digit arithmetic. reference.py holds the cases.

A double eigenvalue is a zero of D(p) = prod_{i<j} (s_i - s_j)^2, analytic in p. Each case looks for the zeros with
from <= Re p <= to and |Im p| <= reach (to - from), and compares their number with the winding number of D round that
rectangle, so that none is missed. A simple defective eigenvalue counts once, a semisimple double one twice.
Matrices are made of the same double-precision numbers that the scenes hold.

  * double eigenvalues: Newton on the Jordan chain P z = 0, P w + P_s z = 0, 40 digits
  * flutter, divergence: changes of the number of unstable eigenvalues on a fine grid, then Newton
"""
import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # the matrices are small

import mpmath as mp
import numpy as np

mp.mp.dps = 40
REACH = 0.1
UNSTABLE = 1e-11  # real parts below this, relative to the largest |s|, are neutral


class Family:
    """(M(p) s^2 + C(p) s + K(p)) z = 0: matrices as lists of coefficients of powers of p."""

    overhang = 1e-3  # the rectangle's ends beyond the range, to count what lies on the ends

    def __init__(self, begin, end, M, C, K, known=(), reach=REACH):
        self.begin, self.end, self.known, self.reach = begin, end, list(known), reach
        self.coefficients = [[np.array(c, dtype=float) for c in X] for X in (M, C, K)]
        self.n = len(self.coefficients[0][0])

    def at(self, p):
        """M, C, K in double precision at complex p."""
        return [sum((c * p**k for k, c in enumerate(X)), np.zeros((self.n, self.n))) for X in self.coefficients]

    def wide(self, p, derivative=0):
        """M, C, K, or their derivatives, with mpmath numbers."""
        result = []
        for X in self.coefficients:
            total = mp.zeros(self.n)
            for k, c in enumerate(X):
                if k < derivative:
                    continue
                factor = mp.mpf(1)
                for j in range(derivative):
                    factor *= k - j
                total += mp.matrix(c.tolist()) * (factor * p ** (k - derivative))
            result.append(total)
        return result


class Expressions(Family):
    """The same with matrices given by a function of (p, arithmetic), arithmetic being numpy or mpmath."""

    def __init__(self, begin, end, function, known=(), reach=REACH):
        self.begin, self.end, self.known, self.reach, self.function = begin, end, list(known), reach, function
        self.n = len(function(begin, np)[0])

    def at(self, p):
        return [np.array(X, dtype=complex) for X in self.function(complex(p), np)]

    def wide(self, p, derivative=0):
        if derivative == 0:
            return [mp.matrix(X) for X in self.function(p, mp)]
        h = mp.mpf(10) ** (-mp.mp.dps // 3)
        up, down = self.wide(p + h), self.wide(p - h)
        return [(a - b) / (2 * h) for a, b in zip(up, down)]  # Newton needs no more


def eigenvalues(family, p):
    M, C, K = family.at(p)
    n = len(M)
    inverse = np.linalg.inv(M)
    companion = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ K, -inverse @ C]])
    return np.linalg.eigvals(companion)


def log_discriminant_angle(family, p):
    """Angle of D(p) det(M)^(4n - 2): the factor removes the poles where the mass is singular."""
    s = eigenvalues(family, p)
    i, j = np.triu_indices(len(s), 1)
    power = 4 * family.n - 2
    return np.sum(2 * np.angle(s[i] - s[j])) + power * np.angle(np.linalg.det(family.at(p)[0]))


def wrapped(angle):
    return (angle + np.pi) % (2 * np.pi) - np.pi


def winding_number(angle, corners, pieces=400):
    total = 0.0
    for a, b in zip(corners, corners[1:] + corners[:1]):
        stack = [(a + (b - a) * k / pieces, a + (b - a) * (k + 1) / pieces, 0) for k in range(pieces)]
        for left, right, depth in stack:
            middle = (left + right) / 2
            change = wrapped(angle(right) - angle(left))
            halves = wrapped(angle(middle) - angle(left)), wrapped(angle(right) - angle(middle))
            if depth < 30 and (max(map(abs, halves)) > 0.5 or abs(change - sum(halves)) > 1.0):
                stack += [(left, middle, depth + 1), (middle, right, depth + 1)]
            else:
                total += sum(halves)
    return round(total / (2 * np.pi), 3)


def jordan_chain(family, p, s):
    """Newton for a defective double eigenvalue near (p, s); None when it does not converge."""
    n = family.n
    M, C, K = family.at(complex(p))
    _, _, Vh = np.linalg.svd(M * s * s + C * s + K)
    z = mp.matrix(Vh[-1].conj().tolist())
    c = z.copy()
    p, s = mp.mpc(p), mp.mpc(s)
    w = None
    for iteration in range(60):
        M, C, K = family.wide(p)
        Mp, Cp, Kp = family.wide(p, 1)
        P, Ps, Pss = M * s * s + C * s + K, M * (2 * s) + C, M * 2
        Pp, Psp = Mp * s * s + Cp * s + Kp, Mp * (2 * s) + Cp
        if w is None:
            A = mp.zeros(n + 1)
            for i in range(n):
                for j in range(n):
                    A[i, j] = P[i, j]
                A[i, n] = (Ps * z)[i]
                A[n, i] = mp.conj(c[i])
            try:
                w = mp.matrix(mp.lu_solve(A, mp.matrix(list(-(Ps * z)) + [0]))[:n])
            except ZeroDivisionError:  # the start is already exact
                w = mp.zeros(n, 1)
        J = mp.zeros(2 * n + 2)
        f = mp.zeros(2 * n + 2, 1)
        blocks = [(P, None, Ps * z, Pp * z), (Ps, P, Ps * w + Pss * z, Pp * w + Psp * z)]
        for row, (left, right, ds, dp) in enumerate(blocks):
            for i in range(n):
                for j in range(n):
                    J[row * n + i, j] = left[i, j]
                    if right is not None:
                        J[row * n + i, n + j] = right[i, j]
                J[row * n + i, 2 * n], J[row * n + i, 2 * n + 1] = ds[i], dp[i]
        for j in range(n):
            J[2 * n, j] = J[2 * n + 1, n + j] = mp.conj(c[j])
        f1, f2 = P * z, P * w + Ps * z
        for i in range(n):
            f[i], f[n + i] = -f1[i], -f2[i]
        f[2 * n] = 1 - sum(mp.conj(c[j]) * z[j] for j in range(n))
        f[2 * n + 1] = -sum(mp.conj(c[j]) * w[j] for j in range(n))
        try:
            d = mp.lu_solve(J, f)
        except ZeroDivisionError:
            return None
        z += d[:n]
        w += d[n : 2 * n]
        s += d[2 * n]
        p += d[2 * n + 1]
        if abs(d[2 * n + 1]) + abs(d[2 * n]) < mp.mpf(10) ** -34 * (1 + abs(p) + abs(s)):
            return p, s
        if abs(p) > 1e9 or abs(s) > 1e9:
            return None
    return None


def inside(family, p, reach):
    low, high = sorted((family.begin, family.end))
    margin = 1e-9 * (high - low)
    return low - margin <= mp.re(p) <= high + margin and abs(mp.im(p)) <= reach * (high - low) + margin


def double_eigenvalues(family, columns=80, rows=5):
    """All defective double eigenvalues (p, s) in the rectangle; starts are local minima over a grid of it."""
    low, high = sorted((family.begin, family.end))
    span = high - low
    found = []
    reals = np.linspace(low, high, columns)
    imags = np.linspace(-1.0, 1.0, rows) * family.reach * span if family.reach > 0 else [0.0]
    for x in reals:
        for y in imags:
            p = complex(x + 0.37 * span / columns, y + 1e-4 * span)
            s = eigenvalues(family, p)
            i, j = np.triu_indices(len(s), 1)
            distance = abs(s[i] - s[j])
            relative = distance / (np.abs(s[i]) + np.abs(s[j]) + 1e-300)
            for k in {*np.argsort(relative)[:4], *np.argsort(distance)[:2]}:
                start = local_zero(family, p, 0.5 * (s[i[k]] + s[j[k]]), 3.0 * span / columns)
                if start is None or any(
                    abs(start[0] - q) < 1e-7 * span and abs(start[1] - t) < 1e-5 * (1 + abs(t)) for q, t in found
                ):
                    continue
                exact = jordan_chain(family, *start)
                if exact is None or not inside(family, exact[0], family.reach):
                    continue
                if any(abs(exact[0] - mp.mpf(q)) < 1e-9 * span for _, q, _, _ in family.known):
                    continue
                if any(same(exact, other, span) for other in found):
                    continue
                found.append(exact)
                q, t = exact
                images = [(mp.conj(q), mp.conj(t))]
                if not family.damped:
                    images += [(q, -t), (mp.conj(q), -mp.conj(t))]
                found += [image for k, image in enumerate(images)
                          if not any(same(image, other, span) for other in found + images[:k])]
    return found


def same(a, b, span):
    return abs(a[0] - b[0]) < mp.mpf(10) ** -20 * span and abs(a[1] - b[1]) < mp.mpf(10) ** -15


def local_zero(family, p, s, step):
    """Muller-like secant on delta(p) = ((s_1 - s_2) / 2)^2 of the two eigenvalues nearest to s."""

    def delta(q, centre):
        e = eigenvalues(family, q)
        a, b = e[np.argsort(abs(e - centre))[:2]]
        return ((a - b) / 2) ** 2, (a + b) / 2

    d0, centre = delta(p, s)
    q = p + 1e-3 * step
    for _ in range(40):
        d1, centre1 = delta(q, centre)
        if d1 == d0:
            break
        move = -d1 * (q - p) / (d1 - d0)
        if abs(move) > step:
            move *= step / abs(move)
        p, d0, centre = q, d1, centre1
        q = q + move
        if abs(move) < 1e-9 * step:
            return q, centre
        low, high = sorted((family.begin, family.end))
        beyond = max(low - q.real, q.real - high, 0) / (high - low)
        if beyond > 0.01 or abs(q.imag) > (1.5 * family.reach + 0.01) * (high - low):
            return None
    return None


def characteristic(family, p, s):
    M, C, K = family.wide(p)
    return M * s * s + C * s + K


def infinite_eigenvalues(family, points=3989):
    """Where the mass becomes singular."""
    ps = np.linspace(family.begin, family.end, points)
    dets = [np.linalg.det(family.at(p)[0]).real for p in ps]
    f = lambda p: mp.det(family.wide(p)[0])
    return [mp.findroot(f, (a, b)) for a, b, da, db in zip(ps, ps[1:], dets, dets[1:]) if da * db < 0]


def stability_changes(family, points=3989):
    """Flutter and divergence points: where the number of unstable eigenvalues changes."""
    ps = np.linspace(family.begin, family.end, points)

    def unstable(p):
        s = eigenvalues(family, p)
        return int(np.sum(s.real > UNSTABLE * abs(s).max()))

    counts = [unstable(p) for p in ps]
    result = []
    for a, b, na, nb in zip(ps, ps[1:], counts, counts[1:]):
        if na == nb or np.linalg.det(family.at(a)[0]).real * np.linalg.det(family.at(b)[0]).real < 0:
            continue
        for _ in range(60):
            middle = 0.5 * (a + b)
            if unstable(middle) == na:
                a = middle
            else:
                b = middle
        s = eigenvalues(family, b)
        s = s[np.argmin(abs(s.real) / (abs(s) + 1e-3 * abs(s).max()))]
        if abs(s) < 1e-4 * abs(eigenvalues(family, b)).max():
            f = lambda p: mp.det(family.wide(p)[2])
            result.append(("divergence", mp.findroot(f, (a - 1e-6, b + 1e-6)), mp.mpc(0)))
        else:

            def real_part(p):
                f = lambda v: mp.det(characteristic(family, p, v))
                found.append(mp.findroot(f, found[-1], tol=1e-70, maxsteps=60, verify=False))
                return mp.re(found[-1])

            found = [mp.mpc(s)]
            p = mp.findroot(real_part, (a - 1e-9, b + 1e-9), tol=1e-60, maxsteps=60, verify=False)
            w = mp.im(found[-1])
            result.append(("flutter", p, mp.mpc(0, abs(w))))
    return result


def number(x, digits=21):
    x = mp.mpf(x)
    return mp.nstr(x if abs(x) > mp.mpf(10) ** -28 else mp.mpf(0), digits)


def line(kind, p, s, half_width=0):
    s = mp.mpc(s)
    real = mp.mpf(0) if abs(mp.re(s)) < mp.mpf(10) ** -28 * (1 + abs(s)) else mp.re(s)
    imag = mp.mpf(0) if abs(mp.im(s)) < mp.mpf(10) ** -28 * (1 + abs(s)) else mp.im(s)
    width = ", " + number(half_width) if half_width else ""
    return '{"%s", %s, {%s, %s}%s},' % (kind, number(p), number(real), number(imag), width)


def report(name, family):
    low, high = sorted((family.begin, family.end))
    span = high - low
    doubles = double_eigenvalues(family) if family.reach >= 0 else []
    # Coincidences that are known by construction and that the Jordan chain does not describe.
    weight = sum(w for _, _, _, w in family.known)
    if family.reach > 0:
        end, h = family.overhang * span, family.reach * span
        corners = [complex(low - end, -h), complex(high + end, -h), complex(high + end, h), complex(low - end, h)]
        count = winding_number(lambda p: log_discriminant_angle(family, p), corners)
    else:
        count = float("nan")
    print("%s: %d defective + %d by construction, winding number %g" % (name, len(doubles), weight, count))
    lines = []
    for kind, p, s, _ in family.known:
        lines.append((mp.mpf(p), line(kind, p, s)))
    for p, s in doubles:
        if mp.im(s) < -1e-20 * (1 + abs(s)):
            continue  # the conjugate of another one
        mirror = [q for q, t in doubles if mp.im(t) >= 0 and abs(q - mp.conj(p)) < mp.mpf(10) ** -20 * span]
        if mp.im(p) < -mp.mpf(10) ** -25 * span and mirror:
            continue  # the other one of a veering that is symmetric about the real axis
        if abs(mp.im(p)) < mp.mpf(10) ** -25 * span:
            lines.append((mp.re(p), line("collision", mp.re(p), s)))
        else:
            lines.append((mp.re(p), line("veering", mp.re(p), s, abs(mp.im(p)))))
    for kind, p, s in stability_changes(family) if family.damped else []:
        lines.append((mp.re(p), line(kind, mp.re(p), s)))
    for p in infinite_eigenvalues(family):
        lines.append((p, line("infinite", p, 0)))
    for text in dict.fromkeys(text for _, text in sorted(lines, key=lambda item: item[0])):
        print("   ", text)
