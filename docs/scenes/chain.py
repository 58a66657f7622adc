"""Chains of rigid links, as scenes, and how they converge to the continuum: python3 docs/scenes/chain.py PROGRAM

Draws docs/scenes/chain.svg and prints the table of docs/scenes/chain.md. The text of one chain:
python3 docs/scenes/chain.py hanging 10, or: rotating 10
"""
import csv
import io
import math
import pathlib
import subprocess
import sys
import tempfile

LENGTH, MASS, G, SPEED = 2.0, 3.0, 9.81, 20.0
J0_ZEROS = [2.404825557695773, 5.520078110286311, 8.653727912911013]


def links(n, along, joint):
    """Thin rods one after the other; the first hangs at the origin."""
    text = []
    for i in range(n):
        centre = [f'"{i + 0.5} * length / {n}"' if c == along else "0" for c in "xz"]
        if along == "z":
            centre[1] = f'"-{i + 0.5} * length / {n}"'
        text.append(f"""
[[body]]
name = "link {i + 1}"
mass = "mass / {n}"
inertia = [0, "mass / {n} * (length / {n})^2 / 12", "mass / {n} * (length / {n})^2 / 12"]
position = [{centre[0]}, 0, {centre[1]}]
x_axis = {"[0, 0, -1]" if along == "z" else "[1, 0, 0]"}
y_axis = [0, 1, 0]
markers = {{ top = ["-length / {2 * n}", 0, 0], bottom = ["length / {2 * n}", 0, 0] }}

{joint}
from = {f'"link {i}.bottom"' if i else "[0, 0, 0]"}
to = "link {i + 1}.top"
""")
    return "".join(text)


def hanging(n):
    """A chain of n links that hangs and swings in a plane; traced over g."""
    return f"""\
title = "Hanging chain of {n} links"

[parameters]
g = {G}
mass = {MASS}
length = {LENGTH}

[trace]
parameter = "g"
from = {G}
to = 20
tolerance = 1e-10

[gravity]
acceleration = [0, 0, "-g"]
""" + links(n, "z", "[[revolute]]\naxis = [0, 1, 0]")


def rotating(n):
    """A cable of n links without weight, hinged on the axis of a turning frame; it flaps and lags. Traced over the speed."""
    return f"""\
title = "Rotating cable of {n} links"

[parameters]
omega = {SPEED}
mass = {MASS}
length = {LENGTH}

[trace]
parameter = "omega"
from = {SPEED}
to = 40
tolerance = 1e-10

[frame]
angular_velocity = [0, 0, "omega"]
""" + links(n, "x", "[[universal]]\naxis = [0, 0, 1]\ncross_axis = [0, 1, 0]")


def frequencies(program, text, at, *options):
    """Frequencies of a scene at one value of its parameter, ascending."""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "chain.toml"
        scene.write_text(text, encoding="utf-8")
        subprocess.run([program, "trace", scene, "-o", scene.with_suffix(".h5"), "--quiet", *options], check=True)
        rows = subprocess.run([program, "eval", scene.with_suffix(".h5"), "--csv", "--at", repr(at)], check=True,
                              capture_output=True, text=True).stdout
    return sorted(float(row["imag"]) for row in csv.DictReader(io.StringIO(rows)))


def bessel_j0(x):
    """Sum of (-x^2/4)^k / k!^2; good to 1e-10 below x = 12."""
    term = total = 1.0
    for k in range(1, 60):
        term *= -x * x / 4.0 / k**2
        total += term
    return total


def continuum():
    """Frequencies of the hanging chain; flap and lag of the rotating cable (Legendre polynomials P_1, P_3, P_5)."""
    hung = [z / 2.0 * math.sqrt(G / LENGTH) for z in J0_ZEROS]
    flap = [SPEED * math.sqrt(k * (2 * k - 1)) for k in (1, 2, 3)]
    lag = [SPEED * math.sqrt(k * (2 * k - 1) - 1) for k in (1, 2, 3)]
    return hung, flap, lag


def converging(program, numbers):
    """Relative errors of the first modes by name, one per number of links. Those that any number of links has exactly, the
    straight cable that flaps and lags as a whole, are left out."""
    hung, flap, lag = continuum()
    expected = sorted(flap[1:] + lag[1:])
    names = [f"cable, {kind} {k}" for kind, k in (("lag", 2), ("flap", 2), ("lag", 3), ("flap", 3))]
    errors = {name: [] for name in [f"hanging chain {k}" for k in (1, 2, 3)] + names}
    for n in numbers:
        found = frequencies(program, hanging(n), G, "--to", "10", "--modes", "3")
        for k in range(3):
            errors[f"hanging chain {k + 1}"].append(found[k] / hung[k] - 1.0)
        found = frequencies(program, rotating(n), SPEED, "--to", "21", "--modes", "8", "--tolerance", "1e-8")
        found = [f for f in found if f > 1.5 * SPEED]
        for name, f, e in zip(names, found, expected):
            errors[name].append(f / e - 1.0)
    return errors


def shapes(program, n):
    """Depth and sideways displacement of the joints of a hanging chain in its first three modes."""
    import h5py
    import numpy as np
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "chain.toml"
        scene.write_text(hanging(n), encoding="utf-8")
        subprocess.run([program, "trace", scene, "-o", scene.with_suffix(".h5"), "--quiet", "--to", "10", "--modes", "3"],
                       check=True)
        with h5py.File(scene.with_suffix(".h5")) as file:
            names = [name.decode() for name in file["coordinate"]]
            shape = file["mode_shape"][0]
    turn = shape[:, [names.index(f"link {i + 1}.x_axis.x") for i in range(n)]]
    largest = np.argmax(abs(turn), axis=1)
    turn = (turn / turn[range(3), largest][:, None]).real  # one phase for the whole chain
    x = np.cumsum(np.hstack([np.zeros((3, 1)), turn]), axis=1)
    return np.linspace(0, LENGTH, n + 1), x / x[:, -1:]


def draw(program):
    import matplotlib
    matplotlib.use("svg")
    import matplotlib.pyplot as plt
    import numpy as np
    matplotlib.rcParams.update({"svg.hashsalt": "eigentrail", "font.size": 9.5})
    numbers = [5, 10, 20, 40]
    errors = converging(program, numbers)
    print("| mode | " + " | ".join(f"{n} links" for n in numbers) + " | order |\n|---|" + "---|" * (len(numbers) + 1))
    for name, values in errors.items():
        order = math.log2(values[-2] / values[-1])
        print(f"| {name} | " + " | ".join(f"{v:.2e}" for v in values) + f" | {order:.2f} |")
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained", width_ratios=[2.2, 1])
    colours = {"hanging": "#0072b2", "lag": "#009e73", "flap": "#d55e00"}
    markers = "os^"
    for name, values in errors.items():
        kind = next(k for k in colours if k in name)
        number = int(name[-1])
        left.loglog(numbers, values, color=colours[kind], marker=markers[number - 1], markersize=5, linewidth=1.3,
                    linestyle="-" if kind == "hanging" else "--", label=name)
    left.loglog(numbers, [7.0 / n**2 for n in numbers], color="0.5", linewidth=1, linestyle=":",
                label=r"slope $-2$")
    left.set(xlabel="number of links", ylabel="relative error of the frequency", xticks=numbers,
             xticklabels=[str(n) for n in numbers])
    left.minorticks_off()
    left.legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5))
    depth, x = shapes(program, 20)
    fine = np.linspace(0, LENGTH, 200)
    for k, colour in enumerate(["#0072b2", "#d55e00", "#009e73"]):
        right.plot([bessel_j0(J0_ZEROS[k] * math.sqrt(1 - z / LENGTH)) for z in fine], -fine, color=colour, linewidth=1.3,
                   linestyle=["-", "--", "-."][k], label=f"mode {k + 1}")
        right.plot(x[k], -depth, ".", color=colour, markersize=4)
    right.set(xlabel="displacement", ylabel="height, m", title="hanging chain, 20 links (dots)")
    right.title.set_fontsize(9)
    right.legend(frameon=False, fontsize=8, loc="upper right")
    for axes in (left, right):
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(pathlib.Path(__file__).resolve().parent / "chain.svg", metadata={"Date": None})


if __name__ == "__main__":
    if sys.argv[1] in ("hanging", "rotating"):
        print({"hanging": hanging, "rotating": rotating}[sys.argv[1]](int(sys.argv[2])))
    else:
        draw(str(pathlib.Path(sys.argv[1]).resolve()))
