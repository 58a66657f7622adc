"""Draws a scene at an equilibrium: bodies as bars, points as dots, joints by symbol, springs as zigzags."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle, FancyArrowPatch, Polygon, Rectangle

INK, BODY, ACCENT, SPRING, FORCE = "#222222", "#9ecae1", "#0072b2", "#009e73", "#d55e00"
PLANES = {"xy": [[1, 0, 0], [0, 1, 0]], "xz": [[1, 0, 0], [0, 0, 1]], "yz": [[0, 1, 0], [0, 0, 1]]}
JOINTS = ["revolute", "universal", "ball", "cylindrical", "prismatic", "weld"]


def projection(view):
    """The two directions of the picture: a plane, or azimuth and elevation of the eye in degrees."""
    if isinstance(view, str):
        return np.array(PLANES[view], float)
    a, e = np.radians(view)
    return np.array([[-np.sin(a), np.cos(a), 0],
                     [-np.sin(e) * np.cos(a), -np.sin(e) * np.sin(a), np.cos(e)]])


def convex_hull(points):
    """Corners in order (Andrew's monotone chain)."""
    points = sorted(map(tuple, np.round(points, 12)))
    turn = lambda o, a, b: (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    chains = []
    for order in (points, points[::-1]):
        chain = []
        for p in order:
            while len(chain) > 1 and turn(chain[-2], chain[-1], p) <= 1e-9:
                chain.pop()
            chain.append(p)
        chains += chain[:-1]
    return np.array(chains)


class Sketch:
    def __init__(self, posture, settings):
        self.posture, self.scene, self.settings = posture, posture.scene, settings
        self.on_body = {name: [posture.place(name + "." + m) for m in body["markers"]]
                        for name, body in posture.bodies.items()}
        self.used, self.grounds = [], []
        for kind in [*JOINTS, "rod", "spring", "damper", "maxwell_damper", "point_on_line", "point_on_plane", "bearing"]:
            for table in self.scene.tables(kind):
                for key in ("from", "to"):
                    if key in table:
                        self.use(table[key])
        places = [*self.used, *posture.points.values(), *(p for ps in self.on_body.values() for p in ps)]
        places += [b["origin"] for b in posture.bodies.values()]
        self.extra = [[posture.place(end) for end in line] for line in settings.get("lines", [])]
        self.grounds = [posture.place(at) for at in settings["grounds"]] if "grounds" in settings else self.grounds
        places += [end for line in self.extra for end in line]
        self.places = np.array(places)
        self.view = projection(settings.get("view") or self.best_plane())
        flat = self.places @ self.view.T
        self.size = max(np.ptp(flat, axis=0).max(), 1e-9)
        self.u = 0.03 * self.size * settings.get("symbols", 1.0)  # the measure of all symbols
        self.middle = flat.mean(axis=0)
        self.figure, self.axes = plt.subplots(figsize=settings.get("sketch_size", [3.4, 3.4]))
        self.axes.set_aspect("equal")
        self.axes.axis("off")

    def use(self, place):
        at = self.posture.place(place)
        owner = self.posture.owner(place)
        if owner in self.on_body:
            self.on_body[owner].append(at)
        if owner is None:
            self.grounds.append(at)
        self.used.append(at)

    def best_plane(self):
        extent = np.ptp(self.places, axis=0)
        for plane, normal in (("xz", 1), ("xy", 2), ("yz", 0)):
            if extent[normal] < 1e-6 * extent.max() and np.count_nonzero(extent > 1e-6 * extent.max()) == 2:
                return plane
        return "xz" if extent[1] < 1e-6 * extent.max() else [-60, 20]

    def flat(self, place):
        return self.view @ np.asarray(place)

    def line(self, places, **style):
        xy = np.array([self.flat(p) for p in places])
        self.axes.plot(xy[:, 0], xy[:, 1], **({"color": INK, "linewidth": 1.2, "solid_capstyle": "round"} | style))

    # What the picture is made of

    def bodies(self):
        for name, places in self.on_body.items():
            xy = np.array([self.flat(p) for p in [*places, self.posture.bodies[name]["origin"]]])
            middle = xy.mean(axis=0)
            along = np.linalg.svd(xy - middle)[2]
            spread = np.ptp((xy - middle) @ along.T, axis=0)
            if spread[1] < 0.5 * self.u:  # a bar
                reach = (xy - middle) @ along[0]
                ends = [middle + reach.min() * along[0], middle + reach.max() * along[0]]
                self.axes.plot(*np.transpose(ends), color=INK, linewidth=8.2, solid_capstyle="round", zorder=1)
                self.axes.plot(*np.transpose(ends), color=BODY, linewidth=6.6, solid_capstyle="round", zorder=1.1)
            else:
                self.axes.add_patch(Polygon(convex_hull(xy), facecolor=BODY, edgecolor=INK, linewidth=0.9, zorder=1,
                                            joinstyle="round"))
            if self.posture.bodies[name]["mass"] > 0:
                self.centre(self.flat(self.posture.place(name + ".centre")))

    def centre(self, at):
        r = 0.75 * self.u
        self.axes.add_patch(Circle(at, r, facecolor="white", edgecolor=INK, linewidth=0.8, zorder=3))
        t = np.linspace(0, np.pi / 2, 10)
        for turn in (0, np.pi):
            xy = np.column_stack([np.cos(t + turn), np.sin(t + turn)]) * r + at
            self.axes.add_patch(Polygon(np.vstack([at, xy]), facecolor=INK, linewidth=0, zorder=3.1))

    def points(self):
        masses = [max(self.scene.number(t["mass"]), 0.0) for t in self.scene.tables("point")]
        for table, mass in zip(self.scene.tables("point"), masses):
            r = self.u * (0.5 + 0.9 * np.cbrt(mass / max(max(masses), 1e-300)))
            self.axes.add_patch(Circle(self.flat(self.posture.points[table["name"]]), r, facecolor=ACCENT,
                                       edgecolor=INK, linewidth=0.8, zorder=3))

    def rods(self):
        for table in self.scene.tables("rod"):
            self.line([self.posture.place(table["from"]), self.posture.place(table["to"])], linewidth=1.6, zorder=2)

    def joints(self):
        for kind in JOINTS:
            for table in self.scene.tables(kind):
                at = self.flat(self.posture.place(table["from"]))
                axis = self.direction(table.get("axis"))
                in_plane = axis is not None and np.linalg.norm(axis) > 0.2
                if kind == "weld":
                    self.box(at, np.array([1.0, 0.0]), 0.8, 0.8, INK)
                elif kind in ("cylindrical", "prismatic"):
                    self.box(at, axis if in_plane else np.array([1.0, 0.0]), 2.0, 0.9, "white")
                else:
                    if kind != "ball" and in_plane:
                        self.axes.plot(*np.transpose([at - 2.6 * self.u * axis, at + 2.6 * self.u * axis]), color=INK,
                                       linewidth=0.8, dashes=(6, 2, 1, 2), zorder=3.5)
                    self.axes.add_patch(Circle(at, self.u, facecolor="0.75" if kind == "ball" else "white",
                                               edgecolor=INK, linewidth=1.2, zorder=4))
                    if kind == "universal":
                        for a in (0.25, 0.75):
                            d = self.u * np.array([np.cos(a * np.pi), np.sin(a * np.pi)])
                            self.axes.plot(*np.transpose([at - d, at + d]), color=INK, linewidth=1, zorder=4.1)
        for table in self.scene.tables("point_on_line"):
            at, axis = self.posture.place(table["from"]), self.posture.direction(table["axis"])
            on = self.posture.place(table["to"])
            ends = axis @ (on - at)
            self.line([at + (min(ends, 0) - 5 * self.u) * axis, at + (max(ends, 0) + 5 * self.u) * axis], color="0.5",
                      linewidth=1, zorder=0.5)
            self.box(self.flat(on), self.view @ axis, 1.4, 0.8, "white")

    def direction(self, direction):
        return None if direction is None else self.view @ self.posture.direction(direction)

    def box(self, at, along, length, width, colour):
        along = along / np.linalg.norm(along)
        across = np.array([-along[1], along[0]])
        corners = [at + self.u * (i * length * along + j * width * across) for i, j in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
        self.axes.add_patch(Polygon(corners, facecolor=colour, edgecolor=INK, linewidth=1.1, zorder=4))

    def springs(self):
        for kind, draw in (("spring", self.zigzag), ("damper", self.dashpot), ("maxwell_damper", self.dashpot)):
            for table in self.scene.tables(kind):
                draw(self.flat(self.posture.place(table["from"])), self.flat(self.posture.place(table["to"])))
        for table in self.scene.tables("guided_spring"):
            at = self.posture.place(table["point"])
            end = self.flat(at - 0.3 * self.size * self.posture.direction(table["direction"]))
            self.zigzag(end, self.flat(at))
            self.ground(end)
        torsional = ("torsional_spring", "torsional_damper", "torsional_maxwell_damper")
        for table in (table for kind in torsional for table in self.scene.tables(kind)):
            joint = next((j for k in JOINTS for j in self.scene.tables(k) if j.get("name") == table["joint"]), None)
            if joint is not None:
                t = np.linspace(0, 3.2 * np.pi, 120)
                r = self.u * (1.4 + 1.3 * t / t[-1])
                x, y = self.flat(self.posture.place(joint["from"]))
                self.axes.plot(x + r * np.cos(t), y + r * np.sin(t), color=SPRING, linewidth=1.2, zorder=5)

    def across(self, a, b):
        d = (b - a) / max(np.linalg.norm(b - a), 1e-300)
        return d, np.array([-d[1], d[0]])

    def zigzag(self, a, b):
        d, n = self.across(a, b)
        length = np.linalg.norm(b - a)
        coils = int(np.clip(length / (1.6 * self.u), 4, 12))
        at = np.concatenate([[0], 0.15 + 0.7 * (np.arange(2 * coils) + 0.5) / (2 * coils), [1]])
        side = np.concatenate([[0], [1, -1] * coils, [0]])
        xy = a + np.outer(at, b - a) + np.outer(side, n) * self.u
        self.axes.plot(xy[:, 0], xy[:, 1], color=SPRING, linewidth=1.3, zorder=2.5, solid_joinstyle="round")

    def dashpot(self, a, b):
        d, n = self.across(a, b)
        middle, u = (a + b) / 2, self.u
        style = dict(color=SPRING, linewidth=1.3, zorder=2.6)
        self.axes.plot(*np.transpose([a, middle - u * d]), **style)
        self.axes.plot(*np.transpose([middle + 0.3 * u * d, b]), **style)
        cup = [middle + u * (i * d + j * n) for i, j in ((1.2, 1), (-1, 1), (-1, -1), (1.2, -1))]
        self.axes.plot(*np.transpose(cup), **style)
        self.axes.plot(*np.transpose([middle + u * (0.3 * d + 0.7 * n), middle + u * (0.3 * d - 0.7 * n)]), **style)

    def ground(self, at):
        """A hatched line at a fixed place, on the side away from what it carries."""
        u = self.u
        up = 1 if self.middle[1] < at[1] - 0.1 * self.size else -1
        y = at[1] + 1.4 * u * up
        self.axes.plot([at[0] - 2 * u, at[0] + 2 * u], [y, y], color=INK, linewidth=1.2, zorder=0.6)
        self.axes.plot([at[0] - u, at[0], at[0] + u], [y, at[1], y], color=INK, linewidth=1, zorder=0.6)
        for k in np.linspace(-1.6, 2, 6):
            self.axes.plot([at[0] + k * u, at[0] + (k - 0.6) * u], [y, y + 0.7 * u * up], color=INK, linewidth=0.7,
                           zorder=0.6)

    def arrow(self, a, b, colour, text=""):
        self.axes.add_patch(FancyArrowPatch(a, b, arrowstyle="-|>", mutation_scale=10, color=colour, linewidth=1.4,
                                            shrinkA=0, shrinkB=0, zorder=5))
        if text:
            d, n = self.across(np.asarray(a), np.asarray(b))
            self.axes.annotate(text, np.asarray(b), xytext=tuple(8 * d), textcoords="offset points", ha="center", va="center",
                               color=colour, fontsize=10, zorder=6)

    def forces(self):
        for table in self.scene.tables("force"):
            f = self.view @ self.scene.vector(table["components"])
            if np.linalg.norm(f) > 0:
                at = self.flat(self.posture.place(table["point"]))
                self.arrow(at, at + 0.22 * self.size * f / np.linalg.norm(f), FORCE, "F")
        for table in self.scene.tables("follower_force"):
            line = self.posture.place(table["to"]) - self.posture.place(table["from"])
            a, k = self.scene.number(table.get("angle", 0)), self.scene.vector(table.get("axis", [0, 0, 1]))
            k = k / np.linalg.norm(k)
            f = self.view @ (np.cos(a) * line + np.sin(a) * np.cross(k, line) + (1 - np.cos(a)) * (k @ line) * k)
            f = f / np.linalg.norm(f) * (np.sign(self.scene.number(table["magnitude"])) or 1)
            at = self.flat(self.posture.place(table["point"]))
            tail, head = (at, at + 0.22 * self.size * f)
            if f @ (at - self.flat(self.places.mean(axis=0))) < 0:  # a push ends at the point
                tail, head = at - 0.22 * self.size * f, at
            self.arrow(tail, head, FORCE, "P" if head is not at else "")

    def turning(self, at, axis, text, radius=2.4):
        """An arc with an arrow about an axis."""
        e = axis / np.linalg.norm(axis)
        a = np.cross(e, [1, 0, 0] if abs(e[0]) < 0.8 else [0, 1, 0])
        a /= np.linalg.norm(a)
        t = np.linspace(-0.35 * np.pi, 1.25 * np.pi, 60)
        circle = np.outer(np.cos(t), a) + np.outer(np.sin(t), np.cross(e, a))
        eye = np.cross(self.view[0], self.view[1])
        if abs(e @ eye) < 0.2:  # seen from the side: tilt it towards the eye
            circle += 0.3 * np.outer(circle @ eye, e)
        xy = (np.asarray(at) + radius * self.u * circle) @ self.view.T
        self.axes.plot(xy[:, 0], xy[:, 1], color=FORCE, linewidth=1.2, zorder=5)
        self.axes.add_patch(FancyArrowPatch(xy[-4], xy[-1], arrowstyle="-|>", mutation_scale=9, color=FORCE, linewidth=0,
                                            shrinkA=0, shrinkB=0, zorder=5))
        self.axes.annotate(text, xy[:, 0].max() * np.array([1, 0]) + xy[:, 1].mean() * np.array([0, 1]), xytext=(4, 0),
                           textcoords="offset points", ha="left", va="center", color=FORCE, fontsize=10)

    def discs(self):
        for table in self.scene.tables("spinning_disc"):
            axis = self.posture.direction(table["axis"])
            name = table["axis"]["body"] if isinstance(table["axis"], dict) else table["axis"].rsplit(".", 1)[0]
            at = self.posture.place(name + ".centre")
            self.disc(at, axis, 0.16 * self.size)
            self.turning(at + 2.5 * self.u * axis, axis, "ω")

    def disc(self, at, axis, radius):
        a = np.cross(axis, [1, 0, 0] if abs(axis[0]) < 0.8 else [0, 1, 0])
        a /= np.linalg.norm(a)
        t = np.linspace(0, 2 * np.pi, 80)
        rim = at + radius * (np.outer(np.cos(t), a) + np.outer(np.sin(t), np.cross(axis, a)))
        self.axes.add_patch(Polygon(rim @ self.view.T, facecolor=BODY, edgecolor=INK, linewidth=1, zorder=1.5, alpha=0.9))

    def blades(self):
        for table in self.scene.tables("blade_element"):
            at = lambda v: self.flat(self.posture.place({"body": table["body"], "at": v}))
            root, tip = self.scene.vector(table["root"]), self.scene.vector(table["tip"])
            lead, chord = self.scene.vector(table["leading"]), self.scene.number(table["chord"])
            lead = lead / np.linalg.norm(lead)
            corners = [at(list(p + k * chord * lead)) for p, k in ((root, 0.25), (tip, 0.25), (tip, -0.75), (root, -0.75))]
            self.axes.add_patch(Polygon(corners, facecolor="#cccccc", edgecolor=INK, linewidth=0.7, zorder=0.9))

    def strips(self):
        """Strips on bodies, from leading to trailing edge; those on beams are not drawn."""
        for table in self.scene.tables("strips"):
            if "root" not in table:
                continue
            root, tip = self.scene.vector(table["root"]), self.scene.vector(table["tip"])
            lead, chord = self.scene.vector(table.get("leading", [0, 1, 0])), self.scene.number(table["chord"])
            quarter = self.scene.number(table.get("quarter_chord_y", 0))
            lead = lead / np.linalg.norm(lead)
            corners = [self.flat(self.posture.place({"body": table["on"], "at": list(p + (quarter + k * chord) * lead)}))
                       for p, k in ((root, 0.25), (tip, 0.25), (tip, -0.75), (root, -0.75))]
            self.axes.add_patch(Polygon(corners, facecolor="#cccccc", edgecolor=INK, linewidth=0.7, zorder=0.9))

    def bearings(self):
        for table in self.scene.tables("bearing"):
            at = self.flat(self.posture.place(table["point"]))
            end = at - np.array([0, 5 * self.u])
            self.zigzag(end, at)
            self.ground(end)

    def fields(self):
        """Gravity beside the picture, the axis of a turning frame through the origin."""
        low, high = (self.places @ self.view.T).min(axis=0), (self.places @ self.view.T).max(axis=0)
        for table in self.scene.tables("gravity"):
            g = self.view @ self.scene.vector(table["acceleration"])
            if np.linalg.norm(g) > 0:
                left = self.settings.get("gravity") == "left"
                start = np.array([low[0] - 5 * self.u if left else high[0] + 5 * self.u,
                                  (low[1] + high[1]) / 2 + 2.5 * self.u])
                self.arrow(start, start + 5 * self.u * g / np.linalg.norm(g), "0.45", "g")
        for table in self.scene.tables("frame"):
            w = self.scene.vector(table["angular_velocity"])
            if np.linalg.norm(w) == 0:
                continue
            e = w / np.linalg.norm(w)
            along = self.places @ e
            a, b = min(along.min(), 0) - 4 * self.u, max(along.max(), 0) + 6 * self.u
            self.line([a * e, b * e], color=FORCE, linewidth=0.9, dashes=(8, 2, 1, 2), zorder=0.4)
            self.turning(b * e, e, "Ω")

    def shapes(self):
        """Balls and discs of the settings, which say nothing about the physics: { at, radius } and { at, axis, radius }."""
        for shape in self.settings.get("shapes", []):
            at, radius = self.posture.place(shape["at"]), self.scene.number(shape["radius"])
            if "axis" in shape:
                self.disc(at, self.posture.direction(shape["axis"]), radius)
            else:
                self.axes.add_patch(Circle(self.flat(at), radius, facecolor=BODY, edgecolor=INK, linewidth=0.9, zorder=1.2))

    def names(self):
        """Texts of the settings: place, what it says, offset in points."""
        for label in self.settings.get("labels", []):
            self.axes.annotate(label["text"], self.flat(self.posture.place(label["at"])), xytext=label.get("offset", [10, 6]),
                               textcoords="offset points", fontsize=9, ha=label.get("align", "left"), va="center", zorder=7)

    def draw(self):
        parts = [self.bodies, self.shapes, self.points, self.rods, self.joints, self.springs, self.discs, self.blades, self.strips, self.bearings]
        for part in parts:
            if part.__name__ not in self.settings.get("hide", []):
                part()
        for turn in self.settings.get("turns", []):
            self.turning(self.posture.place(turn["at"]), self.posture.direction(turn["axis"]), turn["text"])
        for line in self.extra:
            self.line(line, color="0.35", linewidth=3, zorder=0.9)
        for at in {tuple(np.round(self.flat(p), 9)) for p in self.grounds}:
            self.ground(np.array(at))
        self.forces()
        self.fields()
        self.names()
        self.axes.margins(0.08)
        self.axes.autoscale_view()
        return self.figure
