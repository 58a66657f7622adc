"""Inflow of a rotor in hover, climb and at a turbine: mean velocity by blade-element momentum theory, eigenvalues of the
inflow of Pitt and Peters, and the lift deficiency of the flap mode, all in closed form."""

import unittest

import h5py
import numpy as np
from scipy.optimize import fsolve

from program import edited
from rotor_test_case import RotorTest, upper

DENSITY, CHORD, RADIUS, BLADES = 1.2, 0.3, 5.0, 3
AREA = np.pi * RADIUS**2


def rotor(model="pitt_peters", blades=BLADES, **values):
    """Rigid untwisted blades of incidence theta, held in a rotating frame."""
    given = {"omega": 30.0, "theta": 0.1, "climb": 0.0} | values
    text = "\n".join(f"{name} = {value!r}" for name, value in given.items())
    text = f"""[parameters]
{text}
[trace]
parameter = "theta"
from = 0.05
to = 0.25
[frame]
angular_velocity = [0, 0, "omega"]
[[inflow]]
name = "disc"
model = "{model}"
radius = {RADIUS}
density = {DENSITY}
wind = [0, 0, "-climb"]
"""
    if blades < BLADES:
        text += f"blades = {BLADES}\n"
    for i in range(blades):
        text += f"""[[body]]
name = "blade{i}"
mass = 60
centre = [{RADIUS / 2}, 0, 0]
inertia = [0, {60 * RADIUS**2 / 12}, {60 * RADIUS**2 / 12}]
position = [0, 0, 0]
euler = {{ sequence = "zyx", angles = ["{i}*2*pi/{BLADES}", 0, 0] }}
[[weld]]
from = [0, 0, 0]
to = "blade{i}"
[[strips]]
on = "blade{i}"
root = [0, 0, 0]
tip = [{RADIUS}, 0, 0]
chord = {CHORD}
density = {DENSITY}
incidence = "theta"
wind = [0, 0, "-climb"]
inflow = "disc"
"""
    return text


def of_blade(omega):
    """Thrust of a section per r, downwash and length."""
    return 0.5 * DENSITY * CHORD * 2 * np.pi * omega


def mean_inflow(omega, theta, climb):
    """2 rho A |V + v| v = N integral of the thrust; of its roots the one of the momentum theory."""
    k = BLADES * of_blade(omega)
    sign = -1.0 if climb < 0 else 1.0
    slope, thrust = k * np.cos(theta) * RADIUS**2 / 2, k * omega * RADIUS**3 * np.sin(theta) / 3
    roots = np.roots([sign * 2 * DENSITY * AREA, sign * 2 * DENSITY * AREA * climb + slope, slope * climb - thrust])
    return max(roots) if sign > 0 else min(roots)


def inflow_eigenvalues(omega, theta, climb):
    v, k = mean_inflow(omega, theta, climb), BLADES * of_blade(omega) * np.cos(theta)
    flow = abs(climb + 2 * v)
    mean = (2 * DENSITY * AREA * flow + k * RADIUS**2 / 2) / (DENSITY * AREA * RADIUS * 8 / (3 * np.pi))
    cyclic = (DENSITY * AREA * flow / 2 + k * RADIUS**2 / 8) / (DENSITY * AREA * RADIUS * 16 / (45 * np.pi))
    return np.array([-mean, -cyclic + 1j * omega])


class Inflow(RotorTest):
    def mean(self, file):
        with h5py.File(file) as loci:
            names = [name.decode() for name in loci["coordinate"][:]]
            return loci[loci.attrs["parameter"]][:], loci["equilibrium"][:, names.index("disc.mean")]

    def check(self, text, omega, theta, climb):
        """`omega`, `theta` and `climb` by the value of the traced parameter."""
        file = self.trace_text(text, tolerance=1e-10)
        p, found = self.mean(file)
        np.testing.assert_allclose(found, [mean_inflow(omega(q), theta(q), climb(q)) for q in p], rtol=1e-10)
        name = text.split('parameter = "')[1].split('"')[0]
        self.assert_follows(file, lambda q: inflow_eigenvalues(omega(q), theta(q), climb(q)), name,
                            np.linspace(p[0], p[-1], 20), tolerance=1e-9)

    def traced(self, parameter, begin, end, **values):
        return edited(edited(edited(rotor(**values), 'parameter = "theta"', f'parameter = "{parameter}"'),
                             "from = 0.05", f"from = {begin}"), "to = 0.25", f"to = {end}")

    def test_hover(self):
        self.check(rotor(), lambda q: 30.0, lambda q: q, lambda q: 0.0)

    def test_speed_of_the_rotor(self):
        self.check(self.traced("omega", 5.0, 40.0), lambda q: q, lambda q: 0.1, lambda q: 0.0)

    def test_climb(self):
        self.check(self.traced("climb", 0.0, 5.0), lambda q: 30.0, lambda q: 0.1, lambda q: q)

    def test_turbine(self):
        """The wind blows along the axis and turns the sign of the flow."""
        self.check(self.traced("climb", -9.0, -7.0, omega=10.0, theta=-0.02), lambda q: 10.0, lambda q: -0.02, lambda q: q)

    def test_axis_of_the_rotor_may_be_any(self):
        text = rotor().replace('[0, 0, "omega"]', '["omega", 0, 0]').replace('[0, 0, "-climb"]', '["-climb", 0, 0]')
        text = edited(text, "density = 1.2\nwind", "axis = [1, 0, 0]\ndensity = 1.2\nwind")
        for i in range(BLADES):
            text = edited(text, f'euler = {{ sequence = "zyx", angles = ["{i}*2*pi/3", 0, 0] }}',
                          f'x_axis = [0, "cos({i}*2*pi/3)", "sin({i}*2*pi/3)"]\nz_axis = [1, 0, 0]')
        self.check(text, lambda q: 30.0, lambda q: q, lambda q: 0.0)

    def test_uniform_inflow_of_one_blade_for_all(self):
        file = self.trace_text(rotor("uniform", blades=1), tolerance=1e-10)
        self.assert_follows(file, lambda q: inflow_eigenvalues(30.0, q, 0.0)[:1], "theta", np.linspace(0.05, 0.25, 20))

    def test_lift_deficiency_of_the_flap_mode(self):
        """A blade on a flap hinge with little thrust, hence little coning: the induced velocity takes some of its damping."""
        text = edited(rotor("uniform", blades=1), "[[weld]]\nfrom = [0, 0, 0]\nto = \"blade0\"",
                      "[[revolute]]\nfrom = [0, 0, 0]\nto = \"blade0\"\naxis = [0, 1, 0]")
        text = edited(edited(text, "from = 0.05", "from = 0.0005"), "to = 0.25", "to = 0.002")
        file = self.trace_text(text)
        omega, inertia, k = 30.0, 60 * RADIUS**2 / 3, of_blade(30.0)
        air = DENSITY * AREA * RADIUS * 8 / (3 * np.pi)
        # Moment and thrust of a blade by pitch, induced velocity, flap rate, and flap: a coned blade pitches as it turns.
        moment = k * np.array([omega * RADIUS**4 / 4, -RADIUS**3 / 3, -RADIUS**4 / 4, CHORD / 2 * omega * RADIUS**3 / 3])
        thrust = k * np.array([omega * RADIUS**3 / 3, -RADIUS**2 / 2, -RADIUS**3 / 3, CHORD / 2 * omega * RADIUS**2 / 2])
        def roots(theta, with_inflow=True):
            _, v = fsolve(lambda q: [inertia * omega**2 * q[0] - moment @ [theta, q[1], 0, q[0]],
                                     2 * DENSITY * AREA * q[1]**2 - BLADES * thrust @ [theta, q[1], 0, q[0]]],
                          [0.0, mean_inflow(omega, theta, 0.0)], xtol=1e-13)
            system = np.array([[0, 1, 0], [moment[3] / inertia - omega**2, moment[2] / inertia, moment[1] / inertia],
                               [BLADES * thrust[3] / air, BLADES * thrust[2] / air,
                                (BLADES * thrust[1] - 4 * DENSITY * AREA * v) / air]])
            return upper(np.linalg.eigvals(system if with_inflow else system[:2, :2]))
        self.assert_follows(file, roots, "theta", [0.0005, 0.001, 0.002], tolerance=1e-4)
        flap = lambda s: s[np.argmax(s.imag)]
        self.assertLess(flap(roots(0.001)).real / flap(roots(0.001, False)).real, 0.99)
        alone = self.trace_text(text, "--without", "inflow", output="alone.h5")
        self.assert_follows(alone, lambda q: roots(q, False), "theta", [0.0005, 0.002], tolerance=1e-4)

    def test_refusals(self):
        for old, new, message in (
                ('model = "pitt_peters"', 'model = "glauert"', '[[inflow]] 1 model: expected "uniform", "annular" or "pitt_peters"'),
                ('wind = [0, 0, "-climb"]\n[[body]]\nname = "blade0"', 'wind = [1, 0, 0]\n[[body]]\nname = "blade0"',
                 "[[inflow]] 1 wind: must be parallel to axis"),
                ("radius = 5.0", "radius = 0", "[[inflow]] 1 radius: must be positive"),
                ("radius = 5.0", "radius = 5.0\naxis = [0, 1, 0]", "must be parallel"),
                ("radius = 5.0", "radius = 5.0\nblades = 3", '[[inflow]] 1 blades: needs model = "uniform"'),
                ('name = "disc"', 'name = "disk"', "[[strips]] 1 inflow: no [[inflow]] is called 'disc'")):
            with self.subTest(new):
                self.write("bad.toml", edited(rotor(), old, new))
                run = self.run_program("explain", "bad.toml")
                self.assertEqual(run.returncode, 2)
                self.assertIn(message, run.stderr)


if __name__ == "__main__":
    unittest.main()
