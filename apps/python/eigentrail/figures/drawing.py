"""What only the scene in a file says: the frequency of the excitation, and the links between points and bodies.

It is read from the file that the Dataset was made from. Without that the excitation is known where the parameter is an angular
velocity, and figures of shapes have no links.
"""

import json
from collections import namedtuple

import numpy as np

from .. import files
from ..engine import engine
from ..errors import SceneError
from .style import ANGULAR

Excitation = namedtuple("Excitation", "parameter frequency harmonics")  # values of the parameter, rad/s, those of the scene


def excitation(loci):
    """The frequency whose multiples are the harmonics; None where there is none."""
    found = _read(loci, 0)
    if found is not None:
        known = found["excitation"]
        return Excitation(known["parameter"], np.abs(known["frequency"]), known["harmonics"]) if known else None
    parameter = loci[loci.attrs["parameter"]]
    factor = ANGULAR.get(parameter.attrs.get("units"))
    if factor is None:
        return None
    low, high = float(parameter.min()), float(parameter.max())
    places = np.unique([low, min(max(low, 0.0), high), high])
    return Excitation(places, factor * np.abs(places), [])  # a rotor that turns the other way is excited as often


def geometry(loci, node):
    """Carriers (points and bodies), places on them and links between these at a stored point; without the file the carriers,
    by the names of their coordinates."""
    stored = (_read(loci, node) or {}).get("geometry")
    return stored or {"carriers": json.loads(engine().carriers(list(map(str, loci.coordinate.values)))), "places": [], "lines": []}


def _read(loci, node):
    image = loci.encoding.get(files.IMAGE)
    try:
        return None if image is None else json.loads(engine().drawing_data(image, node))
    except SceneError:
        return None
