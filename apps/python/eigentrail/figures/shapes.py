"""Pictures of mode shapes: a stick figure, the bent axis of a rotor, or bars."""

from itertools import cycle

import numpy as np

from ..errors import SceneError
from ..selection import mode_names, mode_number
from .curves import damping_percent, without_rounding
from .drawing import geometry
from .labels import Room, text_width
from .picture import Area, Axis, Label, Line, Marks, Picture
from .style import ANGULAR, COLOURS, FAINT, GREY, INK, number

# Turns of the view about the vertical axis and its tilt, in radians, as on the report page.
VIEWS = {"3D": (-0.6, 0.42), "xy": (0.0, np.pi / 2), "xz": (0.0, 0.0), "yz": (-np.pi / 2, 0.0)}
BLUE, GREEN, ORANGE, PINK = COLOURS[0], COLOURS[2], COLOURS[1], COLOURS[3]
SOFT = ("spring", "damper", "bearing", "damping")
JOINTS = ("ball", "revolute", "universal", "cylindrical", "prismatic")
LARGEST = 0.3          # displacement in the picture, as a share of the radius of the figure
MOST_NAMED = 24        # points and bodies with names
MOST_BARS = 60         # coordinates drawn as bars with names
ON_AN_AXIS = 4         # so many carriers on a straight line are drawn as a bent axis
NOTHING = 1e-3         # a displacement below this share of the largest is not drawn
PHASES = np.linspace(0.0, 2 * np.pi, 73)


def shape_picture(loci, value, mode, view="3D", size=None):
    """The shape of a mode at the stored point that is nearest to a value of the parameter."""
    parameter = loci.attrs["parameter"]
    node = int(np.abs(loci[parameter].values - float(value)).argmin())
    column = mode_number(loci, mode)
    shape = np.asarray(loci.mode_shape.values[node, column], complex)
    if view not in VIEWS:
        raise SceneError(f"view={view!r}: expected one of {', '.join(map(repr, VIEWS))}")
    title = _title(loci, node, column)
    if not np.isfinite(shape).all() or not np.abs(shape).any():
        raise SceneError(f"{title}: the mode does not exist there")
    shape = shape / shape[np.abs(shape).argmax()]
    if "shaft_coordinate" in loci:
        return _bent_shafts(loci, shape, title, size)
    figure = _Carriers(loci, node)
    if not figure.names:
        return _bars(loci, shape, title, size)
    if figure.axis is not None:
        return _bent_axis(figure, shape, title, size)
    return _stick_figure(figure, shape, title, view, size)


def _title(loci, node, column):
    parameter = loci[loci.attrs["parameter"]]
    unit = parameter.attrs.get("units", "1")
    s = without_rounding(np.complex128(loci.eigenvalue.values[node, column]))
    label, name = (names[column] for names in mode_names(loci))
    where = f"{label}{'' if name == label else ' ' + name} at {parameter.name} = {number(float(parameter[node]), 6)}"
    where += "" if unit == "1" else f" {unit}"
    if not np.isfinite(s):
        return where
    if s.imag == 0.0:
        return f"{where}: s = {number(s.real)} 1/s"
    known = unit if unit in ANGULAR else "Hz"
    return f"{where}: {number(abs(s.imag) / ANGULAR[known])} {known}, damping {number(float(damping_percent(s)))} %"


class _Carriers:
    """Points and bodies of a scene at a stored point, with the places on them and the links between these."""

    def __init__(self, loci, node):
        found = geometry(loci, node)
        carriers = found["carriers"]  # none if the coordinates are not those of points and bodies
        self.names, self.first, self.body = ([one[key] for one in carriers] for key in ("name", "first", "body"))
        self.places = [(place["carrier"], np.array(place["at"][0], float)) for place in found["places"]]
        self.lines = [(line["kind"], line["from"], line["to"]) for line in found["lines"]]
        self._equilibrium = loci.equilibrium.values[node]
        rest = self.at(np.zeros(len(self._equilibrium)))
        self.rest = np.array([*rest[0], *rest[2]])
        self.axis = _common_axis(rest[0]) if len(carriers) >= ON_AN_AXIS else None

    def at(self, displacement):
        """Origins (k, 3), axes (k, 3, 3; rows) and places (j, 3) with a displacement of the coordinates added."""
        x = self._equilibrium + displacement
        origins = np.array([x[i:i + 3] for i in self.first])
        axes = [x[i + 3:i + 12].reshape(3, 3) if body else np.zeros((3, 3)) for i, body in zip(self.first, self.body)]
        places = [local if carrier is None else origins[carrier] + local @ axes[carrier] for carrier, local in self.places]
        return origins, axes, np.array(places).reshape(-1, 3)

    def middles(self, displacement):
        """Middles (k, 3) of the origins and the places of carriers, where their names stand."""
        origins, _, places = self.at(displacement)
        return np.array([np.mean([origin, *(place for (carrier, _), place in zip(self.places, places) if carrier == k)], axis=0)
                         for k, origin in enumerate(origins)])

    def radius(self):
        return max(np.linalg.norm(np.ptp(self.rest, axis=0)) / 2, 1e-9) or 1.0

    def scale(self, shape):
        """Factor of the shape with which the largest displacement is a share of the radius."""
        moved = [self.at((shape * np.exp(1j * phase)).real) for phase in PHASES[:36]]
        largest = max(np.linalg.norm(np.concatenate([origins, places]) - self.rest, axis=1).max()
                      for origins, _, places in moved)
        radius = self.radius() if self.radius() > 1e-8 else 1.0
        return LARGEST * radius / largest if largest > 0 else 0.0


def _common_axis(origins):
    """Unit vector of the line on which all origins lie; None if they do not."""
    middle = origins - origins.mean(axis=0)
    _, size, axes = np.linalg.svd(middle)
    return axes[0] if size[0] > 0 and size[1] < 1e-6 * size[0] else None


def _stick_figure(figure, shape, title, view, size):
    turn, tilt = VIEWS[view]
    across = np.array([np.cos(turn), -np.sin(turn), 0.0])
    up = np.array([np.sin(tilt) * np.sin(turn), np.sin(tilt) * np.cos(turn), np.cos(tilt)])
    flat = np.column_stack([across, up])
    shape = shape * figure.scale(shape)
    orbits = np.array([np.concatenate(figure.at((shape * np.exp(1j * phase)).real)[::2]) for phase in PHASES]) @ flat
    everything = np.concatenate([orbits.reshape(-1, 2), figure.rest @ flat])
    if size is None:  # as high as the figure needs
        wide, high = np.maximum(np.ptp(everything, axis=0), 0.3 * figure.radius())
        size = (6.5, float(np.clip(5.8 * high / wide, 2.6, 4.7)) + 0.8)
    picture = Picture(*size, title=title)
    left, bottom, right, top = 0.35, 0.3, size[0] - 0.35, size[1] - 0.5
    x, y = _equal_axes(everything, (right - left) / (top - bottom), 0.3 * figure.radius())
    panel = picture.add(left, bottom, right, top, x, y, frame=False)
    for k in range(len(figure.names)):
        panel.items.append(Line(*orbits[:, k].T, BLUE, 0.7, name=f"orbit of {figure.names[k]}"))
    _add_parts(panel, figure, figure.at(np.zeros(len(shape))), flat, ghost=True)
    _add_parts(panel, figure, figure.at(shape.real), flat, ghost=False)
    _add_triad(panel, flat)
    if len(figure.names) <= MOST_NAMED:
        room = Room(panel)
        for name, place in zip(figure.names, figure.middles(shape.real) @ flat):
            room.beside(*place, name, 8.0, 5, BLUE)
    picture.legend = [Line([], [], FAINT, 2.5, legend="equilibrium"), Line([], [], BLUE, 2.5, legend="displaced"),
                      Line([], [], BLUE, 0.7, legend="orbits")]
    return picture


def _equal_axes(points, ratio, least):
    """Axes with equal scales on both, with all points inside."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, 0.56 * np.maximum(high - low, least)
    half = np.maximum(half, [ratio * half[1], half[0] / ratio])
    return tuple(Axis("", middle[k] - half[k], middle[k] + half[k], shown=False) for k in (0, 1))


def _add_parts(panel, figure, positions, flat, ghost):
    origins, axes, places = positions[0] @ flat, positions[1], positions[2] @ flat
    kind_of = "equilibrium" if ghost else "displaced"

    def line(a, b, colour, width, dash="solid", name=""):
        panel.items.append(Line([a[0], b[0]], [a[1], b[1]], FAINT if ghost else colour, width, dash, name))

    def dots(points, symbol, colour, size, name):
        if len(points):
            panel.items.append(Marks(*np.array(points).T, symbol, FAINT if ghost else colour, size, name))

    for (carrier, _), place in zip(figure.places, places):
        if carrier is not None:
            line(origins[carrier], place, BLUE, 2.2, name=kind_of)
    for kind, begin, end in figure.lines:
        soft = any(word in kind for word in SOFT)
        line(places[begin], places[end], GREEN if soft else INK, 1.2 if soft else 1.7, "dash" if soft else "solid", kind)
    joints = [places[end] for kind, _, end in figure.lines if any(word in kind for word in JOINTS)]
    dots(joints, "circle-open", INK, 5.0, "joint")
    fixed = [place for (carrier, _), place in zip(figure.places, places) if carrier is None]
    dots(fixed, "circle-open", GREY, 5.0, "fixed place")
    for origin, rows, body in zip(positions[0], axes, figure.body):
        for row, colour in zip(rows if body else (), (ORANGE, GREEN, PINK)):
            line(origin @ flat, (origin + 0.1 * figure.radius() * row) @ flat, colour, 1.2, name="axis of a body")
    for body, size in ((True, 4.0), (False, 8.0)):
        dots([origin for origin, is_body in zip(origins, figure.body) if is_body == body], "circle", BLUE, size, kind_of)


def _add_triad(panel, flat):
    """The axes of the frame in the lower left corner."""
    for k, name in enumerate("xyz"):
        tip = 22 * flat[k]
        x, y = panel.at(*(24 + np.outer(tip, (0.0, 1.0, 1.35))))
        if np.hypot(*tip) > 4:
            panel.items.append(Line(x[:2], y[:2], GREY, 1.0, name=f"direction {name}"))
            panel.items.append(Label(x[2], y[2], name, GREY, 8.0, "center"))


def _bent_axis(figure, shape, title, size):
    """Displacements across the axis on which the carriers lie, over the place along it."""
    origins = figure.at(np.zeros(len(shape)))[0]
    axis = figure.axis * (1 if figure.axis[np.abs(figure.axis).argmax()] > 0 else -1)
    along = origins @ axis
    order = np.argsort(along)
    moved = np.array([shape[i:i + 3] for i in figure.first])[order]
    parts = [(name, along[order], moved @ vector) for name, vector in zip("xyz", np.eye(3)) if abs(vector @ axis) < 0.9]
    if np.abs(moved @ axis).max() > 0.1 * np.abs(moved).max():
        parts.append(("along the axis", along[order], moved @ axis))
    return _over_the_axis(parts, title, size)


def _bent_shafts(loci, shape, title, size):
    """The same for the shafts of a rotor."""
    if "projection_basis" in loci:
        shape = loci.projection_basis.values @ shape
        shape = shape / shape[np.abs(shape).argmax()]
    moved = np.append(shape, 0.0)[loci.shaft_coordinate.values]  # a freedom that is held has the index -1: zero
    parts = []
    for shaft_number in np.unique(loci.shaft_number.values):
        nodes = np.flatnonzero(loci.shaft_number.values == shaft_number)
        shaft = str(loci.shaft_node.values[nodes[0]]).rsplit("node", 1)[0].strip()
        for axis, name in enumerate(loci.shaft_axis.values):
            parts.append((f"{shaft} {name}".strip(), loci.shaft_place.values[nodes], moved[nodes, axis]))
    return _over_the_axis(parts, title, size)


def _over_the_axis(parts, title, size):
    """Displacements (name, places, values) over the place along an axis: where the largest component is real, and later."""
    parts = [(name, np.real(places), values) for name, places, values in parts]
    largest = max(np.abs(values).max() for _, _, values in parts) or 1.0
    low, high = min(places.min() for _, places, _ in parts), max(places.max() for _, places, _ in parts)
    pad = 0.02 * (high - low)
    picture, panel = _chart(title, size or (8.0, 4.2), Axis("place along the axis, m", low - pad, high + pad),
                            Axis("displacement / largest", -1.12, 1.12))
    for turned, dash, later in ((1.0, "solid", ""), (1j, "dash", ", a quarter period later")):
        for (words, places, values), colour in zip(parts, cycle((BLUE, ORANGE, GREEN, PINK))):
            height = (turned * values).real / largest
            if np.abs(height).max() < NOTHING:
                continue
            panel.items.append(Line(places, height, colour, 1.6, dash, words + later))
            panel.items.append(Marks(places, height, "circle", colour, 3.5, f"{words}{later}, nodes"))
            picture.legend.append(Line([], [], colour, 1.6, dash, legend=words + later))
    return picture


def _chart(title, size, x, y):
    """A picture of one panel with a line at zero."""
    picture = Picture(*size, title=title)
    panel = picture.add(0.8, 0.6, picture.width - 0.25, picture.height - 0.6, x, y)
    panel.items.append(Line([x.low, x.high], [0, 0], GREY, 0.8, name="axis"))
    return picture, panel


def _bars(loci, shape, title, size):
    """One bar per coordinate: pale the magnitude, strong the real part where the largest component is real."""
    n = len(shape)
    if n > MOST_BARS:
        return _profile(shape, title, size)
    names = [str(name) for name in loci.coordinate.values]
    margin = min(text_width(max(names, key=len), 9.0) / 72 + 0.4, 3.0)
    picture = Picture(*(size or (max(5.0, margin + 4.0), 1.1 + 0.19 * max(n, 4))), title=title)
    picture.legend_columns = 2
    axis = Axis("", n - 0.4, -0.6, ticks=list(enumerate(names)))
    panel = picture.add(margin, 0.55, picture.width - 0.25, picture.height - 0.55,
                        Axis("component / largest", -1.08, 1.08), axis)
    for i, value in enumerate(shape):
        for low, high, opacity, name in ((-abs(value), abs(value), 0.18, "magnitude"), (0.0, value.real, 1.0, "real part")):
            panel.items.append(Area([low, high, high, low], [i - 0.32, i - 0.32, i + 0.32, i + 0.32], BLUE, opacity,
                                    f"{name} of {names[i]}"))
    panel.items.append(Line([0, 0], [n - 0.4, -0.6], GREY, 0.8, name="axis"))
    picture.legend = [Area([], [], BLUE, 1.0, legend="real part"), Area([], [], BLUE, 0.18, legend="magnitude")]
    return picture


def _profile(shape, title, size):
    """Components over their numbers, where there are too many for bars."""
    n = len(shape)
    picture, panel = _chart(title, size or (8.0, 4.0), Axis("number of the coordinate", 0, n + 1), Axis("component / largest", -1.08, 1.08))
    where, size_of = np.arange(1, n + 1), np.abs(shape)
    panel.items += [Area(np.concatenate([where, where[::-1]]), np.concatenate([size_of, -size_of[::-1]]), BLUE, 0.18, "magnitude"),
                    Line(where, shape.real, BLUE, 1.2, name="real part")]
    picture.legend = [Line([], [], BLUE, 1.2, legend="real part"), Area([], [], BLUE, 0.18, legend="magnitude")]
    return picture
