"""Eigenvalues of modes that are followed together, from the functions of their block."""

from itertools import permutations

import numpy as np

# A difference of two roots may change by this share of itself on a piece, or the piece is halved.
LARGEST_CHANGE = 0.5
COINCIDING = 1e-12  # of the largest root: such roots need not be told apart
SHORTEST_PIECE = 1e-14  # of a step
# Roots that differ by rounding only, all along, cannot be told apart: beyond so many new pieces nobody tries.
PATIENCE = 2000


def roots_of(functions):
    """Roots of a block, (..., k), from the values of its functions: of 1, of 2, or of k^2 with k >= 3, (..., functions)."""
    count = functions.shape[-1]
    if count == 1:
        return functions
    if count == 2:
        return functions[..., :1] + np.sqrt(functions[..., 1:]) * np.array([1.0, -1.0])
    k = round(count**0.5)
    by_columns = functions.reshape(*functions.shape[:-1], k, k)
    # Real matrices have exact pairs. (A matrix and its transpose, as it is read here, have the same eigenvalues.)
    return np.linalg.eigvals(by_columns if np.any(by_columns.imag) else by_columns.real).astype(complex)


def distinctness(functions):
    """How well the roots of a block can be distinguished, from the values of its functions (functions): the least
    distance of two roots, for three and more relative to their condition numbers 1 / |y^H x|. At an exceptional point
    rounding alone separates the roots, and the condition numbers are large."""
    count = functions.shape[-1]
    if count <= 2:
        roots = roots_of(functions)
        condition = np.ones(len(roots))
    else:
        k = round(count**0.5)
        roots, vectors = np.linalg.eig(functions.reshape(k, k))
        try:
            inverse = np.linalg.inv(vectors)
        except np.linalg.LinAlgError:
            return 0.0
        condition = np.linalg.norm(inverse, axis=1) * np.linalg.norm(vectors, axis=0)
    i, j = np.triu_indices(len(roots), 1)
    return (np.abs(roots[i] - roots[j]) / np.maximum(condition[i], condition[j])).min()


def named(known, roots):
    """The roots (k) with the least total distance from the m <= k known values first, in their order, the others last."""
    orders = np.array(list(permutations(range(len(roots)))))
    cost = np.abs(known[:, np.newaxis] - roots)
    cost = np.where(np.isfinite(cost), cost, 0.0)
    total = cost[np.arange(len(known)), orders[:, :len(known)]].sum(axis=1)
    return roots[orders[total.argmin()]]


def followed(roots_at, start, roots, t):
    """Roots at each of the places t (n), (n, k), in the order that `roots` (k) have at the place `start`, 0 or 1.

    roots_at(t) gives the roots, (n, k), in any order.
    """
    mesh, found = _resolved(roots_at, np.union1d(t, start))
    if start == 1:
        mesh, found = mesh[::-1], found[::-1]
    found = found.copy()
    found[0] = roots
    orders = _orders(found[:-1], found[1:])
    order = np.arange(len(roots))
    places = [order]
    for along in orders:
        order = along[order]
        places.append(order)
    ordered = np.take_along_axis(found, np.array(places), axis=1)
    ascending = slice(None, None, -1 if start == 1 else 1)
    return ordered[ascending][np.searchsorted(mesh[ascending], t)]


def _resolved(roots_at, mesh):
    """Halves the pieces of an ascending mesh until differences of roots change little on each; mesh and roots there."""
    roots = roots_at(mesh)
    unclear = np.ones(len(mesh) - 1, bool)
    most = 2 * len(mesh) + PATIENCE
    while unclear.any() and len(mesh) < most:
        left, right = mesh[:-1][unclear], mesh[1:][unclear]
        # Seen from its ends alone a piece in which roots change places looks like one in which nothing happens.
        middle = 0.5 * (left + right)
        at_middle = roots_at(middle)
        clear = _differ_little(roots[:-1][unclear], at_middle) & _differ_little(at_middle, roots[1:][unclear])
        after = np.flatnonzero(unclear) + 1
        pieces = 1 + unclear
        unclear[unclear] = ~clear & (right - left > SHORTEST_PIECE)
        unclear = np.repeat(unclear, pieces)
        mesh, roots = np.insert(mesh, after, middle), np.insert(roots, after, at_middle, axis=0)
    return mesh, roots


def _orders(a, b):
    """The order in which roots b continue roots a (n, k): b[order] has the least sum of squared distances from a.

    Squares, since then the roots may move together by more than they differ: their differences keep their directions.
    """
    k = a.shape[1]
    orders = np.array(list(permutations(range(k))))
    centred = a - a.mean(axis=1, keepdims=True), b - b.mean(axis=1, keepdims=True)
    alike = (np.conj(centred[0])[:, :, np.newaxis] * centred[1][:, np.newaxis, :]).real
    best = orders[sum(alike[:, i][:, orders[:, i]] for i in range(k)).argmax(axis=1)]
    # Two close roots beside a distant one are lost in the rounding of the sum; their difference tells.
    for i, j in zip(*np.triu_indices(k, 1)):
        ahead = np.take_along_axis(b, best, axis=1)
        turned = (np.conj(a[:, i] - a[:, j]) * (ahead[:, i] - ahead[:, j])).real < 0.0
        best[np.ix_(turned, [i, j])] = best[np.ix_(turned, [j, i])]
    return best


def _differ_little(a, b):
    """Whether, from a to b (n, k), the difference of no two roots changes by much of itself."""
    i, j = np.triu_indices(a.shape[1], 1)
    b = np.take_along_axis(b, _orders(a, b), axis=1)
    before, behind = a[:, i] - a[:, j], b[:, i] - b[:, j]
    least, most = np.minimum(np.abs(before), np.abs(behind)), np.maximum(np.abs(before), np.abs(behind))
    scale = np.abs(a).max(axis=1, keepdims=True)
    return np.all((np.abs(behind - before) <= LARGEST_CHANGE * least) | (most <= COINCIDING * scale), axis=1)
