"""Stability over two parameters: a map, with the curves of a boundary drawn on it."""

import numpy as np

from ..errors import SceneError
from ..selection import curve as smooth_curve
from .curves import parts
from .labels import Room
from .loci import BOTTOM, LEFT, NAME, RIGHT, framed
from .picture import Area, Axis, Cells, Line, Marks
from .style import INK, with_unit

# Names and colours of cells: by the number of growing modes, as on the report page.
CELLS = [("unknown", "#bdbdbd"), ("stable", "#dff0e8"), ("marginal", "#fbf3d3"), ("1 growing mode", "#f6c08a"),
         ("2 growing modes", "#e08a3c"), ("3 growing modes", "#b3531c"), ("4 or more", "#6d2a0c")]
CURVES = {"flutter": "#0072b2", "divergence": "#d55e00", "damping_ratio": "#009e73"}
POINTS_PER_STEP = 12
OUTSIDE = 0.02  # a boundary is shown so far beyond its window, as a share of it


def plane_picture(data, boundary=None, size=None):
    """A map file or a boundary file; `boundary`: a boundary file over the same two parameters, drawn on the map."""
    is_map = data.attrs["format"] == "eigentrail-map"
    curves = [one for one in (boundary, None if is_map else data) if one is not None]
    names = (data.attrs["parameter"], data.attrs["second_parameter"])
    for one in curves:
        if one.attrs.get("format") != "eigentrail-boundary":
            raise SceneError(f"boundary: expected a boundary file, found the format {one.attrs.get('format')!r}")
        if (one.attrs["parameter"], one.attrs["second_parameter"]) != names:
            raise SceneError(f"boundary: expected one over {names[0]} and {names[1]}, found "
                             f"{one.attrs['parameter']} and {one.attrs['second_parameter']}")
    legend = (_cell_legend(data) if is_map else []) + [entry for one in curves for entry in _curve_legend(one)]
    picture, top = framed(data, size or (7.5, 5.5), [entry.legend for entry in legend])
    axes = [Axis(with_unit(name, data[name].attrs.get("units", "1")), *ends) for name, ends in zip(names, _window(data, names))]
    panel = picture.add(LEFT + 0.15, BOTTOM, picture.width - RIGHT, top, *axes)
    if is_map:
        _add_map(panel, data, names)
    for one in curves:
        _add_curves(panel, one, names)
    picture.legend = legend
    return picture


def _window(data, names):
    """Ranges of both axes: those of the map, or the window of the boundary."""
    if data.attrs["format"] == "eigentrail-map":
        return [(float(data[name].min()), float(data[name].max())) for name in names]
    ends = []
    for name, (begin, end) in zip(names, (("option_from", "option_to"), ("second_from", "second_to"))):
        low, high = sorted((float(data.attrs[begin]), float(data.attrs[end])))
        ends.append((low - OUTSIDE * (high - low), high + OUTSIDE * (high - low)))
    return ends


def _kinds(data):
    """Index into CELLS of every cell."""
    growing, margin = data.unstable.values, data.margin.values
    return np.where(growing < 0, 0, np.where(growing > 0, 2 + np.minimum(growing, 4), np.where(margin > 0, 1, 2)))


def _add_map(panel, data, names):
    x, y = (np.argsort(data[name].values) for name in names)
    kinds = data.unstable.copy(data=_kinds(data)).transpose(names[1], names[0]).values
    panel.items.append(Cells(data[names[0]].values[x], data[names[1]].values[y], kinds[np.ix_(y, x)],
                             [colour for _, colour in CELLS], [name for name, _ in CELLS]))
    if data.sizes.get("axis_point", 0):
        panel.items.append(Marks(data.axis_parameter.values, data[names[1]].values[data.axis_line.values], "circle", INK, 3.0,
                                 "located events", [str(kind) for kind in data.axis_kind.values]))


def _cell_legend(data):
    found = np.unique(_kinds(data))
    entries = [Area([], [], CELLS[kind][1], 1.0, legend=CELLS[kind][0]) for kind in found]
    if data.sizes.get("axis_point", 0):
        entries.append(Marks([], [], "circle", INK, 3.0, legend="located on the lines"))
    return entries


def _curve_legend(data):
    kinds = dict.fromkeys(map(str, data.curve_kind.values))
    entries = [Line([], [], CURVES.get(kind, INK), 2.2, legend=kind.replace("_", " ")) for kind in kinds]
    if data.sizes["point"] and (data.other_unstable.values > 0).any():
        entries.append(Line([], [], "#777777", 1.2, "dash", legend="others grow already"))
    if data.sizes["corner"]:
        entries.append(Marks([], [], "diamond-open", INK, 6.0, legend="corner"))
    return entries


def _add_curves(panel, data, names):
    for curve in range(data.sizes["curve"]):
        steps = int(np.sum(data.step_curve.values == curve))
        if not steps:
            continue
        line = smooth_curve(data, curve, POINTS_PER_STEP * steps + 1)
        first = int(data.curve_first[curve])
        others = data.other_unstable.values[first:first + steps + 1]
        kind = str(data.curve_kind.values[curve])
        x, y = line[names[0]].values, line[names[1]].values
        step = np.minimum(np.arange(len(x) - 1) // POINTS_PER_STEP, steps - 1)
        bounds = (np.minimum(others[step], others[step + 1]) == 0)
        for on, width, dash in ((True, 2.2, "solid"), (False, 1.2, "dash")):
            line_parts = parts(x, y, (bounds == on).astype(int), 1)
            if len(line_parts[0]):
                panel.items.append(Line(*line_parts, CURVES.get(kind, INK), width, dash, f"{kind} {curve + 1}"))
    if data.sizes["corner"]:
        corners = data.corner_parameter.values
        panel.items.append(Marks(corners[:, 0], corners[:, 1], "diamond-open", INK, 6.0, "corner",
                                 [str(kind) for kind in data.corner_kind.values]))
        room = Room(panel)
        for (x, y), kind in zip(corners, data.corner_kind.values):
            room.beside(x, y, str(kind).replace("takens_bogdanov", "Takens\u2013Bogdanov"), NAME, 5)
