"""The command `eigentrail report`: its output, its errors, and that texts of a file do not become markup."""

import re
import unittest

import h5py

from command_test_case import CommandTest
from program import BLADE, edited
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

    def test_force_replaces_no_other_page(self):
        self.trace(BLADE)
        self.write("notes.html", "<!DOCTYPE html>\n<p>mine</p>")
        self.refused("loci.h5", "-o", "notes.html", "--force", fragments=["notes.html: is no readable report"])

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
