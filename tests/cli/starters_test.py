"""`eigentrail new` writes valid scenes; `eigentrail reference` lists the tables and keys of scenes."""

import itertools
import re
import unittest

from program import EXIT_BAD_INPUT, SCENES, ProgramTest

STARTERS = ["blade", "pendulum", "rotor", "matrices"]


class New(ProgramTest):
    def test_every_starter_is_explained_traced_and_reported(self):
        for starter in STARTERS:
            with self.subTest(starter):
                said = self.run_well("new", f"{starter}.toml", "--starter", starter)
                self.assertEqual(said, f"wrote {starter}.toml; next: eigentrail explain {starter}.toml\n")
                self.assertIn("freedom", self.run_well("explain", f"{starter}.toml"))
                self.assertIn("certified on every step", self.run_well("trace", f"{starter}.toml", "-o", f"{starter}.h5"))

    def test_commands_in_the_comments_work(self):
        for starter in STARTERS:
            with self.subTest(starter):
                name = f"my_{starter}.toml"
                self.run_well("new", name, "--starter", starter)
                commands = re.findall(r"^#   eigentrail (.*)$", (self.folder / name).read_text(), re.MULTILINE)
                self.assertGreaterEqual(len(commands), 3)
                for line in commands:
                    command, *words = line.split()
                    arguments = itertools.takewhile(lambda word: re.fullmatch(r"-\w|\w+\.\w+", word), words)
                    self.run_well(command, *arguments)

    def test_a_rotor_takes_no_more_than_25_lines(self):
        self.run_well("new", "rotor.toml", "--starter", "rotor")
        self.assertLessEqual(len((self.folder / "rotor.toml").read_text().splitlines()), 25)
        summary = self.run_well("trace", "rotor.toml", "-o", "rotor.h5")
        self.assertRegex(summary, r"1x, forward +speed = ")
        self.assertRegex(summary, r"flutter +speed = ")

    def test_blade_is_the_one_that_is_meant_without_a_word(self):
        self.run_well("new", "scene.toml")
        self.assertIn("Hinged blade", (self.folder / "scene.toml").read_text())

    def test_no_file_is_ever_replaced(self):
        self.write("scene.toml", "mine")
        self.assert_refused(self.run_program("new", "scene.toml"), ["scene.toml: exists already", "never replaced"])
        self.assertEqual((self.folder / "scene.toml").read_text(), "mine")

    def test_bad_names_are_refused(self):
        self.assert_refused(self.run_program("new", "scene.toml", "--starter", "blades"), ["did you mean 'blade'"])
        self.assert_refused(self.run_program("new", "absent/scene.toml"), ["the folder absent does not exist"])
        self.assert_refused(self.run_program("new", ""), ["--output", "name of a file"])
        self.assertEqual(self.contents(), {})


class Reference(ProgramTest):
    def tables(self):
        """The keys of every table, as printed."""
        tables = {}
        for line in self.run_well("reference").splitlines():
            if heading := re.match(r"\[+(\w+)\]+  \S", line):
                keys = tables.setdefault(heading[1], [])
            else:
                keys.append(line.split()[0])
        return tables

    def test_tables_and_keys_are_those_the_reader_knows(self):
        """The reader calls no table of the reference unknown; `name` is allowed in every table."""
        tables = self.tables()
        self.assertGreater(len(tables), 30)
        scene = "[parameters]\nq = 1\n[trace]\nparameter = \"q\"\nfrom = 1\nto = 2\n"
        for name, keys in tables.items():
            self.assertEqual(len(keys), len(set(keys)), name)
            self.assertTrue(keys, name)
        for name in [*tables, "xxxxxxxxxxxxxxxx"]:
            heading = f"[{name}]" if name in ("trace", "events", "modes", "matrix_family", "sampled_family") else f"[[{name}]]"
            self.write("scene.toml", scene if name == "trace" else f"{scene}{heading}\n")
            self.assertEqual(f"{name}: unknown key" in self.run_program("explain", "scene.toml").stderr,
                             name == "xxxxxxxxxxxxxxxx", name)

    def test_keys_of_families_are_those_the_reader_knows(self):
        """The reader names an unknown key of a family; all others are accepted or refused for another reason."""
        tables = self.tables()
        for family in ("matrix_family", "sampled_family"):
            for key in tables[family]:
                self.write("scene.toml", f"[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[{family}]\n{key} = [[[1]]]\n")
                self.assertNotIn("unknown key", self.run_program("explain", "scene.toml").stderr, (family, key))

    def test_page_of_the_documentation_is_current(self):
        page = SCENES.parent.parent / "docs" / "scene-tables.md"
        self.assertEqual(page.read_text(encoding="utf-8"), self.run_well("reference", "--markdown"),
                         "write it again: eigentrail reference --markdown > docs/scene-tables.md")

    def test_one_table_can_be_asked_for(self):
        text = self.run_well("reference", "spring")
        self.assertTrue(text.startswith("[[spring]]  linear spring"))
        self.assertRegex(text, r"stiffness +N/m +required +force per elongation")
        self.assertRegex(text, r"preload +N +default: 0 +tension at the free length")
        self.assertNotIn("damper", text)

    def test_unknown_table_is_refused(self):
        run = self.run_program("reference", "sprong")
        self.assertEqual(run.returncode, EXIT_BAD_INPUT)
        self.assertIn("did you mean 'spring'", run.stderr)


if __name__ == "__main__":
    unittest.main()
