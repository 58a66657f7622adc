"""Eigenvalues ("roots") of a block of modes from the functions of the block (docs/loci-file.md)."""

from itertools import permutations

import numpy as np

# A piece of a step is halved if the difference of two roots changes on it by more than this fraction of itself.
LARGEST_CHANGE = 0.5
COINCIDING = 1e-12  # roots that differ by less, relative to the largest root, need not be distinguished
SHORTEST_PIECE = 1e-14  # of a step; shorter pieces are not halved
# Limit of the number of new pieces. It is reached where roots differ only by rounding on a whole step and cannot be
# distinguished.
PATIENCE = 2000
MOST_PERMUTED = 6  # of more roots there are too many permutations to compare all


def roots_of(functions):
    """Roots (..., k) of a block from the values of its functions (..., m): m is 1, 2, or k^2 for k >= 3."""
    count = functions.shape[-1]
    if count == 1:
        return functions
    if count == 2:
        return functions[..., :1] + np.sqrt(functions[..., 1:]) * np.array([1.0, -1.0])
    k = round(count**0.5)
    by_columns = functions.reshape(*functions.shape[:-1], k, k)
    # The eigenvalues of a real matrix are exactly real or exactly conjugate. The functions are the columns of the
    # matrix; reshape reads them as rows, which gives the transpose with the same eigenvalues.
    return np.linalg.eigvals(by_columns if np.any(by_columns.imag) else by_columns.real).astype(complex)


def distinctness(functions):
    """A measure of how well the roots of a block can be distinguished, from the values (m) of its functions.

    It is the least distance of two roots, for three and more roots divided by the larger of their condition numbers
    1 / |y^H x|. At an exceptional point the roots differ by rounding only, and the condition numbers are large."""
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
    """The roots (k) in the order of m <= k known values, assigned with the least total distance; the others last."""
    cost = np.abs(known[:, np.newaxis] - roots)
    cost = np.where(np.isfinite(cost), cost, 0.0)
    if len(roots) > MOST_PERMUTED:
        return roots[_assigned(cost)]
    orders = np.array(list(permutations(range(len(roots)))))
    total = cost[np.arange(len(known)), orders[:, :len(known)]].sum(axis=1)
    return roots[orders[total.argmin()]]


def _assigned(cost):
    """The columns of cost (m, k), m <= k, in the order of the rows to which they are assigned with the least total; the
    others last."""
    from scipy.optimize import linear_sum_assignment

    columns = linear_sum_assignment(cost)[1]
    return np.concatenate([columns, np.setdiff1d(np.arange(cost.shape[1]), columns)])


def followed(roots_at, start, roots, t):
    """Roots (n, k) at the places t (n), in the order in which they continue `roots` (k), those at `start`, 0 or 1.

    roots_at(t) returns the roots (n, k) in any order.
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
    """Halves the pieces of an ascending mesh until the differences of the roots change little on each piece.

    Returns the mesh and the roots there."""
    roots = roots_at(mesh)
    unclear = np.ones(len(mesh) - 1, bool)
    most = 2 * len(mesh) + PATIENCE
    while unclear.any() and len(mesh) < most:
        left, right = mesh[:-1][unclear], mesh[1:][unclear]
        # The middle is needed: if roots change places within a piece, its ends alone do not show it.
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

    With squares, a common displacement of all roots has no influence, even if it exceeds their differences.
    """
    k = a.shape[1]
    centred = a - a.mean(axis=1, keepdims=True), b - b.mean(axis=1, keepdims=True)
    alike = (np.conj(centred[0])[:, :, np.newaxis] * centred[1][:, np.newaxis, :]).real
    if k > MOST_PERMUTED:
        best = np.array([_assigned(-one) for one in alike]).reshape(len(alike), k)
    else:
        orders = np.array(list(permutations(range(k))))
        best = orders[sum(alike[:, i][:, orders[:, i]] for i in range(k)).argmax(axis=1)]
    # If two roots are close and a third is distant, rounding of the sum hides the order of the close ones. It follows
    # from the direction of their difference.
    for i, j in zip(*np.triu_indices(k, 1)):
        ahead = np.take_along_axis(b, best, axis=1)
        turned = (np.conj(a[:, i] - a[:, j]) * (ahead[:, i] - ahead[:, j])).real < 0.0
        best[np.ix_(turned, [i, j])] = best[np.ix_(turned, [j, i])]
    return best


def _differ_little(a, b):
    """Whether from a to b (n, k) all differences of two roots change by at most LARGEST_CHANGE of themselves."""
    i, j = np.triu_indices(a.shape[1], 1)
    b = np.take_along_axis(b, _orders(a, b), axis=1)
    before, behind = a[:, i] - a[:, j], b[:, i] - b[:, j]
    least, most = np.minimum(np.abs(before), np.abs(behind)), np.maximum(np.abs(before), np.abs(behind))
    scale = np.abs(a).max(axis=1, keepdims=True)
    return np.all((np.abs(behind - before) <= LARGEST_CHANGE * least) | (most <= COINCIDING * scale), axis=1)
