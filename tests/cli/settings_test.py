"""--set NAME=VALUE: other values of the scene's parameters, on every command that takes a scene."""

import unittest

import numpy as np

from command_test_case import CommandTest
from program import BLADE, EXIT_DONE, FAMILY, edited

SCENE = edited(BLADE, "length = 5.0", 'length = { value = 500, unit = "cm" }  # µ before the end')


class Settings(CommandTest):
    def scene_of(self, *settings):
        """The scene that is in the file of a trace with these settings."""
        self.write("scene.toml", SCENE)
        self.run_well("trace", "scene.toml", "-q", "--force", *(word for one in settings for word in ("--set", one)))
        return self.run_well("info", "scene.h5", "--scene")

    def test_replace_the_value_in_the_scene_that_is_kept(self):
        self.assertEqual(self.scene_of("drag=20"), edited(SCENE, "drag   = 2.0", "drag   = 20"))
        self.assertEqual(self.scene_of("mass = 2*drag"), edited(SCENE, "mass   = 50.0", 'mass   = "2*drag"'))
        self.assertEqual(self.scene_of("length=4 m"), edited(SCENE, "value = 500", "value = 400"))
        self.assertEqual(self.scene_of("length=300", "drag=1", "drag=3"),
                         edited(edited(SCENE, "value = 500", "value = 300"), "drag   = 2.0", "drag   = 3"))

    def test_give_what_the_edited_scene_gives(self):
        self.write("scene.toml", SCENE)
        self.run_well("trace", "scene.toml", "-q", "--set", "drag=20", "-o", "set.h5")
        edited_file = self.trace(edited(SCENE, "drag   = 2.0", "drag   = 20"), output="edited.h5")
        np.testing.assert_array_equal(self.eval_at("set.h5", [10, 50]), self.eval_at(edited_file, [10, 50]))

    def test_serve_every_command_with_a_scene(self):
        for command in (["explain"], ["spectrum", "--at", "50"], ["trace", "-q"], ["trace", "-q", "--resume"],
                        ["boundary", "-q", "--second", "drag", "--second-from", "1", "--second-to", "2"],
                        ["map", "-q", "--second", "drag", "--second-from", "1", "--second-to", "2", "--grid", "2"],
                        ["accuracy", "-q", "--tolerances", "1e-3", "--orders", "2", "--grids", "none"]):
            with self.subTest(command[0]):
                self.write("scene.toml", SCENE)
                self.run_well(command[0], "scene.toml", *command[1:], "--set", "mass=40")

    def test_without_effect_are_warned_of(self):
        self.write("scene.toml", FAMILY)
        run = self.run_program("trace", "scene.toml", "-q", "--set", "p=1")
        self.assertEqual((run.returncode, run.stdout), (EXIT_DONE, ""))
        self.assertEqual(run.stderr, "eigentrail: warning: --set p: has no effect: its values are those of the trace\n")

    def test_of_the_traced_parameter_is_where_a_spectrum_is_and_no_trace(self):
        self.write("scene.toml", SCENE)
        run = self.run_program("trace", "scene.toml", "-q", "--set", "omega=30")
        self.assertEqual((run.returncode, run.stderr),
                         (EXIT_DONE, "eigentrail: warning: --set omega: has no effect: its values are those of the trace\n"))
        self.assertIn("omega = 30", self.run_well("spectrum", "scene.toml", "--set", "omega=30"))
        self.assertIn("omega = 40", self.run_well("spectrum", "scene.toml", "--set", "omega=30", "--at", "40"))

    def test_are_checked_like_the_scene(self):
        self.write("scene.toml", SCENE)
        for setting, *fragments in (("drag=2*dragg", "--set drag", "did you mean 'drag'?"),
                                    ("mass=-1", "scene.toml:", "mass: must not be negative; found -1"),
                                    ("mass=2*mass", "[parameters] mass: is defined through itself"),
                                    ("stiffness=1", "--set stiffness: no parameter is called 'stiffness'; known: omega, mass"),
                                    ("lenght=3", "--set lenght", "did you mean 'length'?"),
                                    ("length=3 s", "3 s does not fit length, which is in cm"),
                                    ("=3", "expected NAME=VALUE"), ("drag=", "expected NAME=VALUE")):
            with self.subTest(setting):
                self.assert_refused(self.run_program("trace", "scene.toml", "--set", setting), fragments)


if __name__ == "__main__":
    unittest.main()
