"""Draws the pictures of scenes: python3 docs/scenes/draw.py PROGRAM NAME...

Traces data/scenes/NAME.toml and writes docs/scenes/NAME.svg, eigenvalues against the parameter from the dense output,
and docs/scenes/NAME_sketch.svg, the scene at its equilibrium. docs/scenes/pictures.toml has the settings.
"""
import pathlib
import subprocess
import sys
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE.parent.parent / "data" / "scenes"
sys.path.insert(0, str(HERE.parent))

import h5py
import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

from rotating_mass import eigenvalues, parameter, two_point_taylor
from scene_file import Posture, SceneFile, unit_factor
from sketch import Sketch

COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999"]
DASHES = ["-", "--", "-.", (0, (1, 1)), (0, (5, 1, 1, 1, 1, 1))]
EVENTS = {"flutter": ("X", "#b2182b"), "divergence": ("s", "#b2182b"), "collision": ("P", "#b2182b"),
          "branch_point": ("D", "#762a83"), "fold": (">", "#762a83"), "crossing": ("o", "0.4"), "veering": ("d", "0.4"),
          "extremum": ("^", "0.4"), "damping_ratio": ("v", "0.4"), "resonance": ("*", "#b35806")}
# What a picture shows of the special points unless it is asked for others.
SHOWN = ["flutter", "divergence", "branch_point", "fold", "resonance"]


class Loci:
    """A loci file in memory, and its dense output at many places."""

    def __init__(self, path, per_step=None):
        with h5py.File(path) as file:
            self.data = {name: file[name][()] for name in file if isinstance(file[name], h5py.Dataset)}
            self.attributes = dict(file.attrs)
            self.name = self.attributes["parameter"]
            self.unit = file[self.name].attrs["units"]
        steps = len(self.data["step_length"])
        count = per_step or max(12, 600 // steps)
        t = 0.5 - 0.5 * np.cos(np.linspace(0, np.pi, count))  # close at the ends, where a step may end at a root
        places = [(step, x) for step in range(steps) for x in t]
        self.p = np.array([parameter(self.data, *place) for place in places])
        self.s = np.array([eigenvalues(self.data, *place) for place in places])
        self.s[~np.isfinite(self.s)] = complex(np.nan, np.nan)
        self.kinds = [line.decode().split(",")[0] for line in self.data["events"]]

    def unstable(self):
        """Ranges of the parameter on which a mode grows."""
        p = self.data[self.name]
        low, high = min(p), max(p)
        ranges = sorted(sorted(pair) for pair in zip(self.data["stable_from"], self.data["stable_to"]))
        at, gaps = low, []
        for a, b in ranges:
            if a > at + 1e-9 * (high - low):
                gaps.append((at, a))
            at = max(at, b)
        if high > at + 1e-9 * (high - low):
            gaps.append((at, high))
        return gaps

    def coordinates(self, node):
        names = [name.decode() for name in self.data["coordinate"]]
        return dict(zip(names, self.data["equilibrium"][node]))


def trace(program, scene, options, folder, number):
    out = pathlib.Path(folder) / f"{scene.stem}_{number}.h5"
    subprocess.run([program, "trace", str(scene), "-o", str(out), "--quiet", *options], check=False)
    return Loci(out)


def draw_modes(axes, loci, part, settings, run):
    names = settings.get("modes", [])
    chosen = settings.get("show_modes", range(1, loci.s.shape[1] + 1))
    for mode in chosen:
        k = mode - 1 + run["first_style"]
        label = names[mode - 1] if mode <= len(names) and run["first_style"] == 0 else None
        if "modes" in run and mode <= len(run["modes"]):
            label = run["modes"][mode - 1] or None
        values = part(loci.s[:, mode - 1]) / divisor(loci, settings, mode)
        axes.plot(loci.p, values, color=COLOURS[k % len(COLOURS)], linestyle=DASHES[k % len(DASHES)],
                  linewidth=1.6, label=label, zorder=2)


def divisor(loci, settings, mode):
    """What frequencies are shown in units of: 1, the traced parameter in SI, or where the mode begins."""
    per = settings.get("per")
    if per is None:
        return 1.0
    return loci.p * unit_factor(loci.unit) if per == "parameter" else abs(loci.s[0, mode - 1])


def described(kind, direction):
    if kind == "extremum":
        return "least damping ratio" if direction > 0 else "largest damping ratio"
    return kind.replace("_", " ")


def draw_events(axes, loci, part, settings, done):
    shown = settings.get("events", SHOWN)
    for kind, p, s, direction in zip(loci.kinds, loci.data["event_parameter"], loci.data["event_eigenvalue"],
                                     loci.data["event_direction"]):
        if kind not in shown or not np.isfinite(s):
            continue
        marker, colour = EVENTS[kind]
        value = f"{p:.4g}"
        once = settings.get("critical") if kind == "resonance" else None  # one text for all critical speeds
        key = (kind, once or value)
        label = None if key in done else once or f"{described(kind, direction)} at {value}"
        done.add(key)
        scale = p * unit_factor(loci.unit) if settings.get("per") == "parameter" else 1.0
        axes.plot(p, part(np.array([complex(s.real, abs(s.imag))])) / scale, linestyle="none", marker=marker,
                  color=colour, markersize=11 if marker == "*" else 7, markeredgecolor="white", markeredgewidth=0.7,
                  label=label, zorder=4)


def draw_harmonics(axes, loci, settings):
    """Multiples of the traced speed, in rad/s: the rays of a Campbell diagram."""
    for n in settings.get("rays", []):
        axes.plot(loci.p, n * loci.p * unit_factor(loci.unit), color="0.6", linewidth=0.9, zorder=1)
        at = loci.p[np.argmax(loci.p)] / n**0.5 * settings.get("rays_at", 0.5)
        axes.annotate(f"{n}/rev", (at, n * at * unit_factor(loci.unit)), xytext=(-3, 3), textcoords="offset points", ha="right",
                      fontsize=8.5, color="0.4")


def result_picture(name, settings, runs):
    largest = max(np.nanmax(np.abs(loci.s)) for loci, _ in runs)
    damped = any(np.nanmax(np.abs(loci.s.real)) > 1e-6 * largest for loci, _ in runs)
    coordinate = settings.get("coordinate")
    panels = 1 + damped + (coordinate is not None)
    figure, all_axes = plt.subplots(1, panels, figsize=(4.6 * panels if panels > 1 else 5.6, 3.5), layout="constrained",
                                    squeeze=False)
    all_axes = list(all_axes[0])
    first = runs[0][0]
    unit = "" if first.unit in ("", "1") else f", {first.unit}"
    xlabel = settings.get("parameter", first.name.replace("_", " ")) + unit
    divisor_name = settings.get("per")
    parts = [("frequency", lambda s: np.imag(s), {None: "Im s, rad/s", "parameter": f"Im s / {first.name}",
                                                  "start": "Im s / that at the start"}[divisor_name])]
    if damped:
        parts.append(("growth", lambda s: np.real(s), "Re s, 1/s"))
    for axes, (key, part, ylabel) in zip(all_axes[panels - len(parts):], parts):
        done = set()
        drawn = settings if key == "frequency" else settings | {"per": None}
        for loci, run in runs:
            draw_modes(axes, loci, part, drawn, run)
            draw_events(axes, loci, part, drawn, done)
        axes.set(xlabel=xlabel, ylabel=ylabel)
        if key == "frequency":
            draw_harmonics(axes, first, settings)
        if key in settings:
            axes.set_ylim(*settings[key])
        elif key == "frequency" and not divisor_name:
            axes.set_ylim(bottom=0)
        if key == "growth":
            axes.axhline(0, color="0.5", linewidth=0.8, zorder=1)
    if coordinate is not None:
        axes = all_axes[0]
        for loci, run in runs:
            q = [loci.coordinates(i)[coordinate["name"]] for i in range(len(loci.data["node"]))]
            k = run["first_style"]
            axes.plot(loci.data[loci.name], np.array(q) * coordinate.get("scale", 1.0), color=COLOURS[k % len(COLOURS)],
                      linestyle=DASHES[k % len(DASHES)], linewidth=1.6, label=run.get("label"))
        axes.set(xlabel=xlabel, ylabel=coordinate.get("label", coordinate["name"]))
    grey = first.unstable() if len(runs) == 1 and settings.get("shade", True) else []
    for mark in settings.get("marks", []):
        for axes in all_axes:
            axes.axvline(mark["at"], color="0.6", linewidth=0.8, linestyle=":", zorder=1)
        all_axes[0].annotate(mark["text"], (mark["at"], mark.get("height", 0.05)), xycoords=("data", "axes fraction"),
                             xytext=(4, 0), textcoords="offset points", fontsize=8.5, color="0.3")
    for axes in all_axes:
        axes.spines[["top", "right"]].set_visible(False)
        axes.set_xlim(*settings.get("range", (min(min(l.p) for l, _ in runs), max(max(l.p) for l, _ in runs))))
        for i, (a, b) in enumerate(grey):
            axes.axvspan(a, b, color="0.9", zorder=0, label="unstable" if i == 0 else None)
        if axes is all_axes[0] or (axes is all_axes[1] and coordinate is not None):
            if axes.get_legend_handles_labels()[0]:
                axes.legend(frameon=False, loc=settings.get("legend", "best"), fontsize=8.5, ncol=settings.get("columns", 1))
    figure.savefig(HERE / f"{name}.svg", metadata={"Date": None})
    plt.close(figure)


def boundary_lines(program, scene, wanted, out):
    """Names and units of both parameters, and the curves of `eigentrail boundary` (places x parameters)."""
    options = ["--second", wanted["second"], "--second-from", str(wanted["from"]), "--second-to", str(wanted["to"]),
               *wanted.get("options", [])]
    subprocess.run([program, "boundary", str(scene), *options, "-o", str(out), "--quiet", "--force"], check=True)
    with h5py.File(out) as file:
        names = [file.attrs["parameter"], wanted["second"]]
        units = [file[name].attrs["units"] for name in names]
        lines = []
        for curve in np.unique(file["step_curve"]):
            steps = np.flatnonzero(file["step_curve"][:] == curve)
            series, lengths = file["dense_output"][steps].real, file["step_length"][steps]
            lines.append(np.array([two_point_taylor(h, f[:2, 0], f[:2, 1], t) for h, f in zip(lengths, series)
                                   for t in np.linspace(0, 1, 20)]))
    return names, units, lines


def boundary_picture(program, scene, settings, folder):
    """Stability limits over a second parameter, also of variants of the scene."""
    wanted = settings["boundary"]
    folder = pathlib.Path(folder)
    figure, axes = plt.subplots(figsize=(4.2, 3.3), layout="constrained")
    variants = wanted.get("variants", [{}])
    for variant, style in zip(variants, DASHES):
        edited = folder / scene.name
        edited.write_text(scene.read_text(encoding="utf-8").replace(*variant.get("replace", ["", ""])), encoding="utf-8")
        names, units, lines = boundary_lines(program, edited, wanted, folder / "boundary.h5")
        for i, line in enumerate(lines):
            axes.plot(line[:, 1], line[:, 0], color="#b2182b", linewidth=1.8 if style == "-" else 1.2, linestyle=style,
                      label=variant.get("label") if i == 0 else None)
    if len(variants) > 1:
        axes.legend(frameon=False, fontsize=8.5)
    texts = [wanted.get("first_label", settings.get("parameter", names[0])), wanted.get("label", names[1])]
    ylabel, xlabel = (text + (f", {unit}" if unit not in ("", "1") else "") for text, unit in zip(texts, units))
    axes.set(xlabel=xlabel, ylabel=ylabel, xlim=(wanted["from"], wanted["to"]))
    axes.set_ylim(*wanted["range"])
    axes.annotate("unstable", wanted["unstable"], ha="center", color="0.3")
    axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(HERE / f"{scene.stem}_boundary.svg", metadata={"Date": None})
    plt.close(figure)


def sketch_picture(name, settings, loci, text):
    nodes = loci.data[loci.name]
    node = int(np.argmin(abs(nodes - settings["sketch_at"]))) if "sketch_at" in settings else 0
    scene = SceneFile(text, loci.name, nodes[node])
    figure = Sketch(Posture(scene, loci.coordinates(node)), settings).draw()
    figure.savefig(HERE / f"{name}_sketch.svg", metadata={"Date": None}, bbox_inches="tight", pad_inches=0.05)
    plt.close(figure)


def draw(program, name, settings):
    scene = SCENES / f"{name}.toml"
    runs = [{"options": settings.get("options", []), "label": settings.get("label")}, *settings.get("runs", [])]
    with tempfile.TemporaryDirectory() as folder:
        traced, style = [], 0
        for i, run in enumerate(runs):
            loci = trace(program, scene, list(map(str, run.get("options", []))), folder, i)
            run["first_style"] = run.get("style", style)
            style = run["first_style"] + loci.s.shape[1]
            traced.append((loci, run))
        if "boundary" in settings:
            boundary_picture(program, scene, settings, folder)
    result_picture(name, settings, traced)
    text = scene.read_text(encoding="utf-8")
    if not any(table in text for table in ("[matrix_family]", "[[shaft]]")) and settings.get("sketch", True):
        sketch_picture(name, settings, traced[settings.get("sketch_run", 0)][0], text)


def main():
    program, *names = sys.argv[1:]
    matplotlib.rcParams.update({"svg.hashsalt": "eigentrail", "font.size": 9.5})  # the same input gives the same file
    settings = tomllib.loads((HERE / "pictures.toml").read_text(encoding="utf-8"))
    for name in names:
        draw(str(pathlib.Path(program).resolve()), name, settings.get(name, {}))


if __name__ == "__main__":
    main()
