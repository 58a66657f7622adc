"""Notebooks become pages with their text, code and stored outputs."""
import base64
import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "site"))
from notebooks import markdown


def notebook(*cells):
    return json.dumps({"cells": list(cells), "metadata": {}, "nbformat": 4, "nbformat_minor": 5})


def code(source, *outputs):
    return {"cell_type": "code", "source": source, "outputs": list(outputs)}


class Notebooks(unittest.TestCase):
    def test_text_stays_text(self):
        self.assertEqual(markdown(notebook({"cell_type": "markdown", "source": ["# Title\n", "words"]})), "# Title\nwords\n")

    def test_code_is_shown_with_what_it_printed(self):
        page = markdown(notebook(code(["print(1)"], {"output_type": "stream", "text": ["1\n"]})))
        self.assertEqual(page, "````python\nprint(1)\n````\n\n````text\n1\n````\n")

    def test_pictures_are_in_the_page(self):
        image = base64.b64encode(b"png").decode()
        page = markdown(notebook(code("plot()", {"output_type": "display_data", "data": {"image/png": image + "\n", "text/plain": "x"}})))
        self.assertIn(f"](data:image/png;base64,{image})", page)
        self.assertNotIn("text\nx", page)

    def test_what_is_empty_is_left_out(self):
        self.assertEqual(markdown(notebook(code(""), code("x = 1", {"output_type": "stream", "text": " \n"}))).strip(), "````python\nx = 1\n````")


if __name__ == "__main__":
    unittest.main()
