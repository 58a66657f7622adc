"""air_resonance_fuselage.toml with two trimmed parameters."""

import re

from program import edited


def tables(text):
    """The text in parts, each of which begins with a table."""
    return re.split(r"(?m)^(?=\[)", text)


def with_air_held(text):
    """With a speed of the air through the disc that is trimmed to momentum theory and stays as it is in the motion."""
    text = "".join(part for part in tables(text) if not part.startswith("[[inflow]]"))
    text = edited(text, 'inflow     = "disc"', 'wind = [0, 0, "-inflow"]\ndensity = "rho"').replace("thrust(disc)", "thrust(air)")
    text = edited(text, "[parameters]\n", '[parameters]\ninflow = { value = 8.0, unit = "m/s" }\n')
    return text + '\n[[trim]]\nunknown = "inflow"\ncondition = "thrust(air) = 2 * rho * pi * radius^2 * inflow^2"\n'
