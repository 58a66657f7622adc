"""The linearized equations of a scene as arrays, for control tools and programs of one's own."""

from collections.abc import Sequence
from typing import Any, NamedTuple, Optional

import numpy as np

from .engine import engine
from .errors import SceneError

RATE = "rate of "


class Matrices(NamedTuple):
    """z' = A z + B u, y = C z + D u: the order in which control tools take them."""

    A: Any
    B: Any
    C: Any
    D: Any


class LinearModel(dict[str, Any]):
    """Arrays by their names, those of the files of `eigentrail linearize`: `model["M"]`, or `model.M`; also
    `np.savez("model.npz", **model)` and `scipy.io.savemat("model.mat", {**model})`.

    M, C, K (f x f), F (f x inputs): M q'' + C q' + K q = F u, with the displacements T q (T: n x f) of all n coordinates and
    the inputs u in the units of their parameters. M_full, C_full, K_full (n x n), F_full, constraints (m x n), x and lambda of
    the equilibrium; state_E z' = state_A z + state_B u, with z = [q; rates of those q that have mass]. Names: state_names of q,
    rate_names, coordinate_names, constraint_names, input_names. What a scene does not have is absent. For a list of values the
    arrays have one more axis in front.

    >>> model = et.linearize(scene, at=[0, 0.5])
    >>> model.K.shape, model["p"], model.rate_names
    ((2, 2, 2), array([0. , 0.5]), ['x1', 'x2'])
    """

    def __getattr__(self, name: str) -> Any:
        if name not in self:
            raise AttributeError(f"this model has no array {name!r}; it has {', '.join(self)}")
        return self[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]

    def __repr__(self) -> str:
        return f"LinearModel({', '.join(f'{name} {np.shape(array)}' for name, array in self.items())})"

    def state_space(self, outputs: Optional[Sequence[str]] = None) -> Matrices:
        """A, B, C and D of z' = A z + B u, y = C z + D u, for one value of the parameter: `control.ss(*model.state_space())`.

        `outputs`: names of coordinates, "tip.x", or of their rates, "rate of tip.x"; all coordinates by default. Where equations
        have no derivative (state_E is singular) they are solved, and the states are combinations of z. Raises SceneError where
        that is not possible.

        >>> model = et.linearize(scene, at=0.5)
        >>> model.state_space(["x2", "rate of x1"]).C
        array([[0., 1., 0., 0.],
               [0., 0., 1., 0.]])
        """
        if self["state_E"].ndim != 2:
            raise SceneError("state_space: expected the model of one value of the parameter, found "
                             f"{len(self['state_E'])}; linearize at one value")
        A, B, P, Q = _explicit(self["state_E"], self["state_A"], self.get("state_B", np.zeros((len(self["state_E"]), 0))))
        names, T = list(self["coordinate_names"]), self["T"]
        C, D = [], []
        for name in names if outputs is None else outputs:
            of_state = np.zeros(len(P))
            of_state[:T.shape[1]] = T[self._index(name, names)]
            if not name.startswith(RATE):
                C.append(of_state @ P)
                D.append(of_state @ Q)
            elif np.any(of_state @ Q):
                raise SceneError(f"output {name!r}: contains the rate of an input, because no mass stands between")
            else:
                C.append(of_state @ P @ A)
                D.append(of_state @ P @ B)
        return Matrices(A, B, np.reshape(C, (len(C), len(A))), np.reshape(D, (len(D), B.shape[1])))

    def _index(self, output: str, names: list[str]) -> int:
        name = output.removeprefix(RATE)
        if name not in names:
            raise SceneError(f"output {output!r}: expected a coordinate, or '{RATE}' one; {engine().suggestion(name, names)}")
        return names.index(name)


def _explicit(E: Any, A: Any, B: Any) -> tuple[Any, Any, Any, Any]:
    """w' = A w + B u with z = P w + Q u, of E z' = A z + B u. Where E is singular its singular vectors separate the equations
    without derivatives; rows and columns are scaled to a largest entry of one, so that units do not matter."""
    rows = _factors(E, 1)
    columns = _factors(rows * E, 0)
    U, size, Vt = np.linalg.svd(rows * E * columns)
    r = int((size > len(E) * np.finfo(float).eps * size.max(initial=0.0)).sum())
    if r == len(E):
        return np.linalg.solve(E, A), np.linalg.solve(E, B), np.eye(r), np.zeros(B.shape)
    V = columns.T * Vt.T
    a, b = U.T @ (rows * A) @ V, U.T @ (rows * B)
    if np.linalg.cond(a[r:, r:]) * np.finfo(float).eps >= 1.0:
        raise SceneError("state_space: the equations without derivatives (state_E is singular) cannot be solved for as many "
                         "states; use state_E, state_A and state_B as a descriptor system")
    solved = -np.linalg.solve(a[r:, r:], np.hstack([a[r:, :r], b[r:]]))
    of_state, of_input = solved[:, :r], solved[:, r:]
    explicit = (np.hstack([a[:r, :r], b[:r]]) + a[:r, r:] @ solved) / size[:r, None]
    return explicit[:, :r], explicit[:, r:], V[:, :r] + V[:, r:] @ of_state, V[:, r:] @ of_input


def _factors(given: Any, axis: int) -> Any:
    """The reciprocals of the largest entries of rows (axis 1) or columns (0); 1 where all are zero."""
    largest = np.abs(given).max(axis=axis, keepdims=True, initial=0.0)
    return 1.0 / np.where(largest > 0.0, largest, 1.0)
