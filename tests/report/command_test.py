"""The command `eigentrail report`: its output, its errors, and that texts of a file do not become markup."""

import re
import unittest

import h5py

from command_test_case import CommandTest
from program import BLADE, EXIT_BAD_INPUT, edited
from report_page import page_data

HOSTILE = '</script><script>alert(1)</script><img src=x onerror=alert(2)>\'"&'


class ReportCommand(CommandTest):
    def refused(self, *arguments, fragments):
        before = self.contents()
        self.assert_refused(self.run_program("report", *arguments), fragments)
        self.assertEqual(self.contents(), before)

    def test_page_is_one_file_that_asks_for_nothing(self):
        self.trace(BLADE)
        before = set(self.contents())
        said = self.run_well("report", "loci.h5", "-o", "page.html")
        self.assertRegex(said, r"^wrote page\.html \([\d.]+ MB\)")
        self.assertEqual(set(self.contents()) - before, {(self.folder / "page.html").relative_to(self.folder)})
        text = (self.folder / "page.html").read_text(encoding="utf-8")
        markup = re.sub(r"<(script|style)\b[^>]*>.*?</\1>", "", text, flags=re.S)
        self.assertNotRegex(markup, r"\ssrc=|href=\"(?!data:)|@import")
        self.assertIn("default-src 'none'", markup)

    def test_existing_page_is_replaced_with_force_only(self):
        self.trace(BLADE)
        self.run_well("report", "loci.h5", "-o", "page.html")
        self.refused("loci.h5", "-o", "page.html", fragments=["page.html: exists already", "--force"])
        self.run_well("report", "loci.h5", "-o", "page.html", "--force")

    def test_force_replaces_nothing_else(self):
        self.trace(BLADE)
        self.write("notes.html", "<!DOCTYPE html>\n<p>mine</p>")
        for name in ("notes.html", "loci.h5", "scene.toml"):
            self.refused("loci.h5", "-o", name, "--force", fragments=[f"{name}: is no readable report"])

    def test_folder_and_missing_folder_are_refused(self):
        self.trace(BLADE)
        (self.folder / "folder").mkdir()
        self.refused("loci.h5", "-o", "folder", fragments=["folder: is a folder"])
        self.refused("loci.h5", "-o", "nowhere/page.html", fragments=["the folder nowhere does not exist"])

    def test_files_that_are_not_ours_are_refused(self):
        self.write("scene.toml", BLADE)
        with h5py.File(self.folder / "foreign.h5", "w") as file:
            file["x"] = 1.0
        for name, fragment in (("missing.h5", "no such file"), ("scene.toml", "is a scene, no result; trace it first"), ("foreign.h5", "none of eigentrail")):
            self.refused(name, "-o", "page.html", fragments=[f"{name}: ", fragment])

    def test_file_that_does_not_fit_itself_is_refused(self):
        self.trace(BLADE)
        with h5py.File(self.folder / "loci.h5", "r+") as file:
            del file["mode_block"]
        self.refused("loci.h5", "-o", "page.html", fragments=["loci.h5: ", "mode_block"])

    def test_one_bad_file_of_several_writes_nothing(self):
        self.trace(BLADE)
        self.refused("loci.h5", "missing.h5", "-o", "page.html", fragments=["missing.h5"])

    def test_arguments_are_asked_for(self):
        for arguments in ((), ("loci.h5",), ("-o", "page.html")):
            run = self.run_program("report", *arguments)
            self.assertEqual((run.returncode, run.stdout), (EXIT_BAD_INPUT, ""))

    def test_texts_of_a_file_never_become_markup(self):
        self.trace(BLADE)
        with h5py.File(self.folder / "loci.h5", "r+") as file:
            file.attrs["title"] = file.attrs["scene"] = file.attrs["notes"] = HOSTILE
            for name in ("mode", "mode_name", "coordinate"):
                file[name][...] = [HOSTILE] * len(file[name])
        self.run_well("report", "loci.h5", "-o", "page.html")
        text = (self.folder / "page.html").read_text(encoding="utf-8")
        self.assertNotIn("alert(1)</script>", text)
        self.assertNotIn("<img", text.split('id="data">')[1].split("</script>")[0])
        file, = page_data(self.folder / "page.html")["files"]
        self.assertEqual([file["title"], file["scene"], file["modes"][0]["name"]], [HOSTILE] * 3)

    def test_scene_that_cannot_be_read_any_more_costs_the_figure_only(self):
        self.trace(edited(BLADE, 'title = "Blade"', 'title = "Blade"'))
        with h5py.File(self.folder / "loci.h5", "r+") as file:
            file.attrs["scene"] = "no TOML ["
        self.run_well("report", "loci.h5", "-o", "page.html")
        file, = page_data(self.folder / "page.html")["files"]
        self.assertIsNone(file["shapes"]["geometry"])
        self.assertIsNone(file["excitation"])


if __name__ == "__main__":
    unittest.main()
