"""Tests of the tests of documents: which lines count as printed, and what a document must not omit."""
import unittest

from blocks import blocks, commands
from printed import first_missing


class Printed(unittest.TestCase):
    def assert_missing(self, shown, printed, missing):
        self.assertEqual(first_missing([shown], [printed]), shown if missing else None)

    def test_digits_that_are_shown_count(self):
        self.assert_missing("omega = 4.35 rad/s", "omega = 4.3468399592253 rad/s", False)
        self.assert_missing("omega = 4.37 rad/s", "omega = 4.3468399592253 rad/s", True)
        self.assert_missing("s = 1.00000000001", "s = 1.00000000002", False)  # machines round differently

    def test_complex_numbers_count_as_one(self):
        self.assert_missing("-5.9e-30 + 2.99j", "1.2e-18 + 2.9901j", False)
        self.assert_missing("0 + 2.99j", "0.6 + 2.99j", True)
        self.assert_missing("0.5 + 2.99j", "0.7 + 2.99j", True)

    def test_words_count_and_spaces_do_not(self):
        self.assert_missing("mode 1   stable", "  mode 1 stable  ", False)
        self.assert_missing("mode 1 stable", "mode 1 marginal", True)

    def test_times_do_not_count(self):
        self.assert_missing("time  0.07 s: equilibrium 3 %", "time  0.02 s: equilibrium 9 %", False)
        self.assert_missing("0 steps tried again, 0.14 s", "0 steps tried again, 1.5 s", False)
        self.assert_missing("0 steps tried again, 0.14 s", "1 steps tried again, 1.5 s", True)

    def test_order_counts_and_gaps_do_not(self):
        self.assertIsNone(first_missing(["a", "...", "c"], ["a", "b", "c"]))
        self.assertEqual(first_missing(["c", "a"], ["a", "b", "c"]), "a")


class Blocks(unittest.TestCase):
    def test_commands_and_what_they_print(self):
        [block] = blocks("Text\n\n    eigentrail trace a\n    eigentrail eval b\n\n    printed\n\nText")
        self.assertEqual(block.language, "sh")
        self.assertEqual(commands(block.text), [("eigentrail trace a", []), ("eigentrail eval b", ["printed"])])

    def test_output_follows_its_command_directly(self):
        shell, output, figure = blocks("```sh\neigentrail a\n```\n\n```text\nx\n```\n\nText\n\n    x = y\n")
        self.assertEqual((shell.follows, output.follows, figure.follows), (False, True, False))

    def test_comment_belongs_to_the_next_block(self):
        first, second = blocks("<!-- test: not run: long -->\n\n    ctest a\n\nText\n\n    ctest b\n")
        self.assertEqual((first.notes, second.notes), ({"not run": "long"}, {}))

    def test_comment_of_several_lines(self):
        [block] = blocks("<!-- test: completed by\n[trace]\n\nfrom = 1\n-->\n```toml\nx\n```")
        self.assertEqual(block.notes, {"completed by": "[trace]\n\nfrom = 1"})

    def test_comment_without_a_block_or_a_meaning_is_refused(self):
        for text in ("<!-- test: not run: long -->\n\nText\n\n    ctest a", "<!-- test: skip -->\n\n    ctest a",
                     "    ctest a\n\n<!-- test: not run: long -->\n"):
            with self.assertRaises(ValueError):
                blocks(text)


if __name__ == "__main__":
    unittest.main()
