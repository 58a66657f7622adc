"""Rotors of ROSS (Rotordynamic Open Source Software): their matrices as a family."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Union

import numpy as np

from .errors import SceneError
from .families import Family, Samples
from .later import xarray

FREEDOMS = {4: ("x", "y", "alpha", "beta"), 6: ("x", "y", "z", "alpha", "beta", "theta")}
AGREE = 1e-9  # largest difference, relative to the largest entry, of the state matrix here and that of ROSS


def from_ross(rotor: Any, speeds: Any = None, *, probes: Sequence[Any] = (), title: str = "") -> Union[Family, Samples]:
    """The family M x'' + (C + speed G) x' + K x = 0 of a rotor of ROSS, along its speed in rad/s.

        rotor = from_ross(ross.rotor_example())
        loci = trace(rotor, speed=(0, 800), modes=12)
        loci.eigentrail.whirl()

    The matrices are those of rotor.M(), K(), C(), G(). Where coefficients of bearings or seals are tables over speed, the
    family is sampled at `speeds`, by default at those of the tables; the error of the interpolation is carried to every
    eigenvalue, and a range must lie within the tables. ROSS takes the speed as the frequency of the tables, and so does
    this. Coordinates have the names of nodes ("node 3 x"), those of discs, bearings and `probes` (ross.Probe) their tags
    ("disk 0 x").
    Raises SceneError where the state matrix differs from rotor.A(speed).
    """
    if not all(hasattr(rotor, matrix) for matrix in "MCKG"):
        raise TypeError(f"rotor: expected a Rotor of ROSS, found {type(rotor).__name__}")
    names = _names(rotor, probes)
    tables = [np.asarray(table, float) for table in _tables(rotor)]
    gyroscopic = np.asarray(rotor.G())
    stiffening = [] if getattr(rotor, "Kst", None) is None else [np.asarray(rotor.Kst())]  # times the speed; none in most versions
    labels: dict[str, Any] = dict(parameter="speed", unit="rad/s", names=names,
                                  title=title or str(getattr(rotor, "tag", None) or "rotor of ROSS"))

    def matrices(speed: float) -> tuple[Any, Any, Any]:
        return (_mass(rotor, speed), np.asarray(rotor.C(speed)) + speed * gyroscopic,
                np.asarray(rotor.K(speed)) + sum(speed * matrix for matrix in stiffening))

    if speeds is None and not tables:
        _compare(rotor, 100.0, *matrices(100.0))
        M, C, K = matrices(0.0)
        return Family(M=M, C=[C, gyroscopic], K=[K, *stiffening], **labels)
    at = np.unique(np.concatenate(tables)) if speeds is None else np.asarray(speeds, float)
    each = [matrices(speed) for speed in at]
    _compare(rotor, at[len(at) // 2], *each[len(at) // 2])
    M, C, K = map(np.array, zip(*each))
    return Samples(at, M=M, C=C, K=K, **labels)


def whirl(loci: xarray.Dataset) -> xarray.DataArray:
    """Direction and shape of the orbits of a mode: per stored point, mode and node the ratio of the axes of the ellipse
    that the node runs through in the plane of x and y; 1: a circle in the direction of rotation (from x to y), -1: a circle
    against it, 0: a line; NaN where the mode does not exist or has no lateral motion.

    The coordinate `direction` of a mode at a point is "forward" or "backward" if all nodes agree, else "mixed"; "" without
    lateral motion. Needs coordinates whose names end with " x" and " y".
    """
    coordinates = [str(name) for name in loci.coordinate.values]
    nodes = [name[:-2] for name in coordinates if name.endswith(" x") and name[:-2] + " y" in coordinates]
    if not nodes:
        raise SceneError("expected coordinates with the names 'NODE x' and 'NODE y'")
    x = loci.mode_shape.values[..., [coordinates.index(f"{node} x") for node in nodes]]
    y = loci.mode_shape.values[..., [coordinates.index(f"{node} y") for node in nodes]]
    # x(t) + j y(t) = a e^{jwt} + conj(b) e^{-jwt} of x = X e^{jwt}, y = Y e^{jwt}: a = X + jY runs forward, b = X - jY back.
    forward, backward = np.abs(x + 1j * y), np.abs(x - 1j * y)
    size = np.maximum(forward, backward)
    lateral = size > LATERAL * np.nanmax(np.abs(loci.mode_shape.values), axis=-1, keepdims=True)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(lateral, (forward - backward) / (forward + backward), np.nan)
        ahead, against = ratio > STRAIGHT, ratio < -STRAIGHT
    direction = np.where(ahead.any(-1) & against.any(-1), "mixed",
                         np.where(ahead.any(-1), "forward", np.where(against.any(-1), "backward", "")))
    return xarray.DataArray(
        ratio, dims=("node", "mode", "shaft_node"),
        coords={loci.attrs["parameter"]: loci[loci.attrs["parameter"]], "mode": loci.mode,
                "shaft_node": [node.rstrip(":") for node in nodes],
                "direction": (("node", "mode"), direction.astype(object))},
        name="whirl", attrs={"long_name": "ratio of the axes of the orbit, positive forward", "units": "1"})


LATERAL = 1e-6  # of the largest component of a shape: below it a node does not move laterally
STRAIGHT = 1e-6  # ratio of the axes below which an orbit is a line: neither forward nor backward


def _mass(rotor: Any, speed: float) -> Any:
    """The mass matrix. In later versions that of seals is a table over the speed, too."""
    try:
        return np.asarray(rotor.M(speed))
    except TypeError:
        return np.asarray(rotor.M())


def _names(rotor: Any, probes: Sequence[Any]) -> list[str]:
    letters = FREEDOMS.get(int(rotor.number_dof))
    if letters is None:
        raise SceneError(f"rotor.number_dof: expected 4 or 6 freedoms per node, found {rotor.number_dof}")
    n_nodes = int(rotor.ndof) // len(letters)
    labels = [f"node {node}" for node in range(n_nodes)]
    taken: set[str] = set()
    for element in [*probes, *getattr(rotor, "bearing_elements", ()), *getattr(rotor, "disk_elements", ())]:
        tag, node = getattr(element, "tag", None), int(getattr(element, "n", getattr(element, "node", -1)))
        if tag and 0 <= node < n_nodes and tag not in taken:
            labels[node] = str(tag)
            taken.add(str(tag))
    return [f"{label} {letter}" for label in labels for letter in letters]


def _tables(rotor: Any) -> list[Any]:
    """Frequencies of the bearings and seals whose coefficients change with it."""
    known = [(bearing, getattr(bearing, "frequency", None)) for bearing in getattr(rotor, "bearing_elements", ())]
    return [table for bearing, table in known if table is not None and np.size(table) > 1 and _changes(bearing, table)]


def _changes(bearing: Any, table: Any) -> bool:
    first, others = table[0], table[1:]
    return any(not np.array_equal(np.asarray(matrix(first)), np.asarray(matrix(other)))
               for matrix in (bearing.K, bearing.C) for other in others)


def _compare(rotor: Any, speed: float, M: Any, C: Any, K: Any) -> None:
    n = len(M)
    theirs = np.asarray(rotor.A(speed))[n:]
    ours = -np.linalg.solve(M, np.hstack([K, C]))
    for part, name in ((slice(0, n), "stiffness"), (slice(n, 2 * n), "damping")):
        difference = np.abs(theirs[:, part] - ours[:, part]).max() / max(np.abs(theirs[:, part]).max(), 1e-300)
        if not difference <= AGREE:
            raise SceneError(f"the {name} at {speed:g} rad/s differs from that of rotor.A by {difference:.1e}: this version of "
                             "ROSS builds its state matrix in another way; give the matrices as a Family")
