"""Figures of a trace: Campbell diagram, damping, root locus."""

import numpy as np

from ..errors import SceneError
from .curves import damping_percent, oscillates, runs, usual_range
from .drawing import excitation
from .loci import BOTTOM, LEFT, MOST_NAMED, NAME, RIGHT, LociFigure, padded
from .picture import Axis, Line, Marks, Span
from .separation import Operation
from .style import ANGULAR, GREY, INK, MARGIN, OPERATION, TOO_CLOSE, event_kinds, mode_colour, number


def harmonics_of(figure, asked):
    """Harmonics to draw and their frequency: parameter and rad/s; none where the parameter has no excitation and none were
    asked for."""
    found = excitation(figure.loci)
    if found is None:
        if asked:
            raise SceneError(
                f"harmonics need an angular velocity or a frequency as the parameter ({', '.join(ANGULAR)}), or an excitation "
                f"in the scene's [trace]; the parameter {figure.parameter} has the unit {figure.parameter_unit!r}")
        return [], None
    if asked is None:
        values = [value for kind, _, _, value, _ in figure.event_table() if kind == "resonance"]
        asked = sorted({float(value) for value in [*values, *found.harmonics] if np.isfinite(value) and value > 0})
    asked = [float(n) for n in np.atleast_1d(asked)]
    if any(not np.isfinite(n) or n <= 0 for n in asked):
        raise SceneError(f"harmonics={asked}: expected positive numbers")
    return asked, found


def campbell_picture(loci, harmonics=None, unit=None, log=False, size=None):
    """Damped frequency over the parameter with rays of harmonics; the damping ratio below."""
    figure = LociFigure(loci, unit)
    harmonics, source = harmonics_of(figure, harmonics)
    modes = oscillating(figure)
    low, high = frequency_range(figure, modes, harmonics, source, log)
    modes = [mode for mode in modes if np.nanmin(figure.frequency[:, mode]) < high]
    events = [*figure.event_table(), *ray_crossings(figure, modes, harmonics, source)]
    operation = Operation.of(loci)
    words = [OPERATION[2], MARGIN[2], event_kinds()[TOO_CLOSE][1]] if operation.ranges else []
    picture, top = figure.begin(size or (9.0, 6.5), modes, ["resonance", *words] if harmonics else words)
    right, middle = picture.width - RIGHT - figure.name_width(modes), BOTTOM + 0.3 * (top - BOTTOM)
    above = picture.add(LEFT, middle + 0.18, right, top, figure.parameter_axis(),
                        Axis(f"damped frequency, {figure.unit}", low, high, log))
    above.x.title, above.x.shown = "", False
    below = picture.add(LEFT, BOTTOM, right, middle, figure.parameter_axis(),
                        Axis("damping ratio, %", *damping_range(figure, modes)))
    for panel in picture.panels:
        add_operation(figure, panel, operation, events)
    rays = add_rays(figure, above, harmonics, source)
    add_curves(figure, above, modes, figure.frequency, 1 / figure.factor)
    add_curves(figure, below, modes, figure.damping, figure.damping_per_error)
    events = [(TOO_CLOSE if kind == "resonance" and operation.is_too_close(p, s) else kind, p, s, *more)
              for kind, p, s, *more in events]
    room = figure.add_events(above, lambda p, s: (p, abs(s.imag) / figure.factor), events=events, before=rays)
    figure.add_events(below, damping_place, labelled=False, events=events)
    figure.add_names(above, room, modes, figure.p, figure.frequency)
    return figure.finish(picture)


def add_operation(figure, panel, operation, events):
    """Shaded operating ranges and their separation margins."""
    critical = [(p, s) for kind, p, s, *_ in events if kind == "resonance"]
    for intervals, (colour, opacity, words) in ((operation.ranges, OPERATION), (operation.strips(critical), MARGIN)):
        for low, high in intervals:
            low, high = max(low, panel.x.low), min(high, panel.x.high)
            if low < high:
                panel.items.append(Span(low, high, colour, opacity))
                figure.explain(Span(0, 0, colour, 2 * opacity, legend=words))


def damping_picture(loci, size=None):
    """Damping ratio of oscillating modes over the parameter."""
    figure = LociFigure(loci)
    modes = oscillating(figure)
    picture, top = figure.begin(size or (9.0, 5.0), modes)
    panel = picture.add(LEFT, BOTTOM, picture.width - RIGHT - figure.name_width(modes), top, figure.parameter_axis(),
                        Axis("damping ratio, %", *damping_range(figure, modes)))
    add_curves(figure, panel, modes, figure.damping, figure.damping_per_error)
    room = figure.add_events(panel, damping_place)
    figure.add_names(panel, room, modes, figure.p, figure.damping)
    return figure.finish(picture)


def add_curves(figure, panel, modes, y, per_error):
    """Everything along the parameter but events and names. `per_error`: change of y per change of s."""
    figure.add_ranges(panel)
    figure.add_folds(panel)
    if panel.y.low < 0 < panel.y.high:
        panel.items.append(Line([panel.x.low, panel.x.high], [0, 0], GREY, 0.8, name="axis"))
    figure.add_bands(panel, modes, y, per_error)
    figure.add_modes(panel, modes, figure.p, y)


def damping_place(p, s):
    return p, float(damping_percent(np.complex128(s))) if s.imag else np.nan


def oscillating(figure):
    """Modes that oscillate somewhere."""
    modes = [mode for mode in figure.modes if np.sum(oscillates(figure.s[:, mode])) > 2]
    if not modes:
        raise SceneError("no mode of this trace oscillates; root_locus() draws real eigenvalues")
    return modes


def frequency_range(figure, modes, harmonics, source, log):
    """To the highest ray at the end of the range, at least to the lowest mode; to all modes where there are no rays."""
    values = figure.frequency[:, modes]
    highest = usual_range(values)[1]
    if harmonics:
        ray = max(harmonics) * float(np.max(source.frequency)) / figure.factor
        highest = max(ray, 1.05 * np.nanmax(values, axis=0).min())
    if log:
        return 0.8 * float(values[values > 1e-6 * highest].min()), 1.25 * highest
    return (-0.02 * highest, 1.04 * highest) if highest > 0 else (-0.02, 1.0)


def damping_range(figure, modes):
    low, high = usual_range(figure.damping[:, modes])
    if max(abs(low), abs(high)) < 1e-6:
        return -1.0, 1.0
    return padded(min(low, 0.0), max(high, 0.0), 0.06, 0.08)


def add_rays(figure, panel, harmonics, source):
    """Lines of harmonics. Returns a function of the room that adds their names, at their ends in the window."""
    rays = []
    for n in harmonics:
        x, y = np.asarray(source.parameter, float), n * np.asarray(source.frequency, float) / figure.factor
        x, y = (np.interp(np.linspace(0, len(x) - 1, 400), np.arange(len(x)), values) for values in (x, y))
        panel.items.append(Line(x, y, GREY, 1.0, "dot", f"harmonic {number(n)}"))
        seen, _, _ = panel.seen(x, y)
        rays.append((x[seen], y[seen], f"{number(n)}\u00d7"))

    def names(room):
        for x, y, text in rays:
            room.at_end(x, y, text, NAME, "#444444")

    return names


def ray_crossings(figure, modes, harmonics, source):
    """Crossings of rays and modes that are no events of the file."""
    known = [(p, value) for kind, p, _, value, _ in figure.event_table() if kind == "resonance"]
    size = figure.range[1] - figure.range[0]
    found = []
    for n in harmonics:
        def excess(p, s, n=n):
            return np.where(oscillates(s), np.abs(s.imag), np.nan) - n * np.interp(p, source.parameter, source.frequency)
        for mode, p, s in zip(*figure.curves.crossings(modes, excess)):
            if not any(abs(p - q) < 1e-6 * size and n == value for q, value in known):
                found.append(("resonance", p, s, n, str(mode + 1)))
    return found


def root_locus_picture(loci, unit=None, size=None):
    """Im s over Re s, upper half plane: a ring where a mode begins, a dot where it ends."""
    figure = LociFigure(loci, unit)
    modes, s = figure.modes, figure.s
    real, imag = s.real, np.abs(s.imag) / figure.factor
    low, high = usual_range(real[:, modes])
    top_value = usual_range(imag[:, modes])[1]
    if max(abs(low), abs(high)) < 1e-7 * top_value * figure.factor:
        low, high = -1e-3 * top_value * figure.factor, 1e-3 * top_value * figure.factor
    figure.explain(Marks([], [], "circle-open", INK, 5.0, legend="begins"))
    figure.explain(Marks([], [], "circle", INK, 5.0, legend="ends"))
    picture, top = figure.begin(size or (9.0, 6.0), modes, ["begins", "ends"])
    named = figure.name_width(modes) if len(modes) > MOST_NAMED else 0
    panel = picture.add(LEFT, BOTTOM, picture.width - RIGHT - named, top,
                        Axis("Re s, 1/s", *padded(min(low, 0.0), max(high, 0.0), 0.05, 0.07)),
                        Axis(f"damped frequency Im s, {figure.unit}", *padded(0.0, top_value or 1.0, 0.03, 0.05)))
    panel.items.append(Line([0, 0], [panel.y.low, panel.y.high], "#555555", 1.0, name="axis"))
    figure.add_modes(panel, modes, real, imag)
    ends = [((begin, end - 1), mode) for mode in modes for begin, end in runs(np.isfinite(s[:, mode])) if end - begin > 2]
    for pick, (symbol, what) in enumerate((("circle-open", "begins"), ("circle", "ends"))):
        at = tuple(zip(*((places[pick], mode) for places, mode in ends)))
        panel.items.append(Marks(real[at], imag[at], symbol, INK, 5.0 if len(ends) <= 40 else 3.5, what))

    def name_ends(panel, room, modes, x, y):
        for (_, end), mode in ends:
            room.beside(x[end, mode], y[end, mode], figure.short_name(mode), NAME, 5, mode_colour(mode))

    room = figure.add_events(panel, lambda p, s: (s.real, abs(s.imag) / figure.factor))
    figure.add_names(panel, room, modes, real, imag, few=name_ends)
    return figure.finish(picture)
