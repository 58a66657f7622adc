"""Work-precision diagram of an accuracy study: error over time, a line per method."""

import numpy as np

from ..errors import SceneError
from .labels import text_width
from .loci import BOTTOM, NAME, RIGHT, framed
from .picture import Axis, Line, Marks
from .style import GREY, SYMBOLS, mode_colour, number

WORK = {"wall_time": "wall time, s", "factorizations": "complex LU factorizations", "points": "points"}
DASHES = ("solid", "dash", "dot")
LEFT = 0.9


def work_precision_picture(study, work="wall_time", size=None):
    """Largest relative error over the work, for every method and order. `work`: wall_time, factorizations or points."""
    if work not in WORK:
        raise SceneError(f"work={work!r}: expected one of {', '.join(map(repr, WORK))}")
    groups = {}
    for run, (method, order) in enumerate(zip(study.method.values, study.order.values)):
        if study.error.values[run] > 0 and study[work].values[run] > 0:
            groups.setdefault(f"{method}, order {order}" if order > 0 else str(method), []).append(run)
    if not groups:
        raise SceneError("no run of this study has an error that was measured")
    runs = np.concatenate(list(groups.values())).astype(int)
    picture, top = framed(study, size or (8.0, 5.0), [])
    picture.legend_right = True
    names = (max(text_width(name, NAME) for name in groups) + 50) / 72
    panel = picture.add(LEFT, BOTTOM, picture.width - RIGHT - names, top,
                        _decades(study[work].values[runs], WORK[work]), _decades(study.error.values[runs], "largest relative error"))
    for i, (name, members) in enumerate(groups.items()):
        members = sorted(members, key=lambda run: study[work].values[run])
        x, y = study[work].values[members], study.error.values[members]
        done = np.array([str(study.status.values[run]) == "completed" for run in members])
        symbol, colour = SYMBOLS[i % len(SYMBOLS)], mode_colour(i)
        panel.items.append(Line(x, y, colour, 1.5, DASHES[i // 7 % 3], name))
        texts = [_hover(study, run) for run in members]
        for mask, ending in ((done, ""), (~done, "-open")):
            if mask.any():
                panel.items.append(Marks(x[mask], y[mask], symbol + ending, colour, 5.5, name,
                                         [text for text, on in zip(texts, mask) if on]))
        picture.legend.append(Marks([], [], symbol, colour, 5.5, legend=name, legend_line=DASHES[i // 7 % 3]))
    if any(str(status) != "completed" for status in study.status.values[runs]):
        picture.legend.append(Marks([], [], "circle-open", GREY, 5.5, legend="open: ended early"))
    return picture


def _decades(values, title):
    low, high = 10.0 ** np.floor(np.log10(values.min())), 10.0 ** np.ceil(np.log10(values.max()))
    return Axis(title, low / 1.15, 1.15 * (high if high > low else 10 * low), log=True)


def _hover(study, run):
    tolerance = study.run_tolerance.values[run]
    return (f"tolerance {number(tolerance)}, " if np.isfinite(tolerance) else "") + f"{study.points.values[run]} points"
