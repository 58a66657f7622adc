"""Families of matrices that are hard to follow, as scenes."""

import numpy as np


def family(begin, end, **matrices):
    """A scene that follows det(s^2 M + s C + K) = 0 from p = begin to end; each matrix is a list of coefficients of p."""
    rows = [f"{name} = {[np.asarray(matrix, float).tolist() for matrix in series]}" for name, series in matrices.items()]
    return "\n".join(['[trace]', 'parameter = "p"', f"from = {begin}", f"to = {end}", "[matrix_family]", *rows])


def coalescing(k, damping=0.0):
    """All k modes meet at p = 0, where K has one Jordan block: s^2 = -(1 + 0.1 p^(1/k)) without damping."""
    corner = np.zeros((k, k))
    corner[-1, 0] = 0.1
    jordan = np.eye(k) + 0.1 * np.diag(np.ones(k - 1), 1)
    return family(-1, 0.7, M=[np.eye(k)], C=[damping * np.eye(k)], K=[jordan, corner])


def _rotation(n):
    return np.linalg.qr(np.random.default_rng(3).normal(size=(n, n)))[0]


def oscillators(start, slope, coupling=0.0, curvature=0.0):
    """Oscillators s^2 = -(start + p slope), which cross, in a random basis; `coupling` between all turns it into veering,
    and coupling by curvature p^2 only makes them depend on each other."""
    n, Q = len(start), _rotation(len(start))
    others = 1.0 - np.eye(n)
    K = [np.diag(start) + coupling * others, np.diag(slope)] + ([curvature * others] if curvature else [])
    return family(-1, 1.1, M=[np.eye(n)], K=[Q @ coefficient @ Q.T for coefficient in K])


def random_family(n, seed):
    rng = np.random.default_rng(seed)
    return family(-1, 1, M=[np.eye(n)], C=[0.3 * rng.normal(size=(n, n))],
                  K=[rng.normal(size=(n, n)) + 2.0 * np.eye(n), 2.0 * rng.normal(size=(n, n))])


THROUGH_INFINITY_ONCE = family(0, 0.7, M=[[[-0.5]], [[1]]], C=[[[1]]], K=[[[1]]])
THROUGH_INFINITY_TWICE = family(0, 0.7, M=[np.diag([-0.5, -0.5]), np.eye(2)], C=[np.eye(2)], K=[np.diag([1, 1.2])])
