"""A scene evaluates only the effects that it names, and less if an effect is left out."""
import re
import shutil
import unittest

from program import SCENES, ProgramTest

KEPT = {"point", "body", "directors"}


def formulas(explanation):
    """Formulas per linearization, by active effect, and the absent ones."""
    active = {}
    block = explanation.split("effects\n")[1].split("structure of")[0]
    for line in block.splitlines():
        row = re.match(r"\s+(\w+)\s+(\d+)\s+(\d+)\s+\S", line)
        if row:
            active[row.group(1)] = int(row.group(3))
    absent = re.search(r"absent, never evaluated: (.*)", block).group(1).split(", ")
    return active, absent


class AbsentEffectsTest(ProgramTest):
    def scenes(self):
        """Their texts by their names, those of beams with two elements."""
        texts = {path.name: re.sub(r"(?m)^elements .*", "elements = 2", path.read_text(encoding="utf-8")) for path in sorted(SCENES.glob("*.toml"))}
        return {name: text for name, text in texts.items() if not re.search(r"\[matrix_family\]|\[shaft\]", text)}

    def test_leaving_an_effect_out_takes_its_formulas_away_and_no_others(self):
        shutil.copy(SCENES / "nrel_5mw_blade.csv", self.folder)
        tried = 0
        for scene, text in self.scenes().items():
            self.write(scene, text)
            active, _ = formulas(self.run_well("explain", scene))
            for effect in active:
                result = self.run_program("explain", scene, "--without", effect)
                if "is no effect of this scene that can be left out" in result.stderr:
                    self.assertIn(effect, KEPT | set(self.constraints()))
                    continue
                with self.subTest(scene=scene, without=effect):
                    if result.returncode and "[[trim]]" in text:
                        # Its conditions need the effect, or the hub nothing else that holds it upright.
                        self.assertRegex(result.stderr, r"\[\[trim\]\]|the trim is singular|the hub '\w+' is inclined")
                        continue
                    fewer, absent = formulas(result.stdout)
                    self.assertIn(effect, absent)
                    self.assertEqual(fewer, {name: n for name, n in active.items() if name != effect})
                    tried += 1
        self.assertGreater(tried, 10)

    @staticmethod
    def constraints():
        return ["rod", "plane", "fixed", "ball", "revolute", "universal", "cylindrical", "prismatic", "weld",
                "point_on_line", "point_on_plane", "coupler", "gear"]


if __name__ == "__main__":
    unittest.main()
