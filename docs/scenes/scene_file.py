"""Reads a scene as the pictures need it: expressions evaluated, places and directions found at an equilibrium."""
import math
import re
import tomllib

import numpy as np

UNITS = {"m": 1, "km": 1e3, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "in": 0.0254, "ft": 0.3048, "kg": 1, "g": 1e-3,
         "mg": 1e-6, "t": 1e3, "lb": 0.45359237, "slug": 14.593902937206, "s": 1, "ms": 1e-3, "us": 1e-6, "ns": 1e-9,
         "min": 60, "h": 3600, "N": 1, "mN": 1e-3, "kN": 1e3, "MN": 1e6, "lbf": 4.4482216152605, "Pa": 1, "kPa": 1e3,
         "MPa": 1e6, "GPa": 1e9, "J": 1, "kJ": 1e3, "W": 1, "kW": 1e3, "rad": 1, "mrad": 1e-3, "deg": math.pi / 180,
         "rev": 2 * math.pi, "rpm": 2 * math.pi / 60, "Hz": 1, "kHz": 1e3, "kt": 1852 / 3600, "mph": 0.44704,
         "g0": 9.80665, "%": 0.01, "1": 1}
FUNCTIONS = {name: getattr(math, name) for name in "pi sqrt sin cos tan asin acos atan sinh cosh tanh exp log".split()}


def unit_factor(unit):
    """SI value of one unit: "N m^-1", "kg m^2", "rad/s"."""
    factor, sign = 1.0, 1
    for symbol, name, power in re.findall(r"([ *·/]?)\s*([A-Za-z%][A-Za-z0-9]*|1)(?:\^(-?\d+))?", unit):
        sign = -1 if symbol == "/" else 1
        factor *= UNITS[name] ** (sign * int(power or 1))
    return factor


class SceneFile:
    """A scene at one value of its traced parameter."""

    def __init__(self, text, parameter=None, value=None):
        self.toml = tomllib.loads(text)
        self.known, self.pending = dict(FUNCTIONS), {}
        self.units = {}
        for name, entry in self.toml.get("parameters", {}).items():
            given = entry if isinstance(entry, dict) else {"value": entry}
            self.units[name] = given.get("unit", "")
            if name == parameter:
                given = given | {"value": value}
            self.pending[name] = given
        while self.pending:
            self._resolve(next(iter(self.pending)))

    def _resolve(self, name):
        given = self.pending.pop(name)
        if isinstance(given["value"], str):
            for other in re.findall(r"[A-Za-z_]\w*", given["value"]):
                if other in self.pending:
                    self._resolve(other)
        factor = 1.0 if isinstance(given["value"], str) else unit_factor(self.units[name] or "1")
        self.known[name] = self.number(given["value"]) * factor

    def number(self, value):
        if isinstance(value, str):
            return float(eval(value.replace("^", "**"), {"__builtins__": {}}, self.known))  # the scene was read already
        return float(value)

    def vector(self, values):
        return np.array([self.number(v) for v in values])

    def tables(self, name):
        found = self.toml.get(name, [])
        return found if isinstance(found, list) else [found]


class Posture:
    """Where everything is: a scene file and the coordinates of an equilibrium."""

    def __init__(self, scene, coordinates):
        self.scene, self.points, self.bodies = scene, {}, {}
        at = lambda name: np.array([coordinates[f"{name}.{c}"] for c in "xyz"])
        for table in scene.tables("point"):
            self.points[table["name"]] = at(table["name"])
        for table in scene.tables("body"):
            name = table["name"]
            axes = np.column_stack([at(f"{name}.{c}_axis") for c in "xyz"])
            markers = {key: scene.vector(v) for key, v in table.get("markers", {}).items()}
            markers["centre"] = scene.vector(table.get("centre", [0, 0, 0]))
            self.bodies[name] = {"origin": at(name), "axes": axes, "markers": markers, "mass": scene.number(table["mass"])}

    def owner(self, place):
        """Name of the body or point that a place belongs to; None for a fixed one."""
        if isinstance(place, dict):
            return place["body"]
        if isinstance(place, str):
            return next(n for n in [*self.points, *self.bodies] if place == n or place.startswith(n + "."))
        return None

    def place(self, place):
        if isinstance(place, list):
            return self.scene.vector(place)
        if isinstance(place, dict):
            body, at = self.bodies[place["body"]], self.scene.vector(place["at"])
            return body["origin"] + body["axes"] @ at
        if place in self.points:
            return self.points[place]
        if place in self.bodies:
            return self.bodies[place]["origin"]
        body = self.bodies[self.owner(place)]
        return body["origin"] + body["axes"] @ body["markers"][place[len(self.owner(place)) + 1:]]

    def direction(self, direction):
        if isinstance(direction, dict):
            v = self.bodies[direction["body"]]["axes"] @ self.scene.vector(direction["along"])
        elif isinstance(direction, str):
            name, axis = direction.rsplit(".", 1)
            v = self.bodies[name]["axes"][:, "xyz".index(axis)]
        else:
            v = self.scene.vector(direction)
        return v / np.linalg.norm(v)
