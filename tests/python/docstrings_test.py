"""Runs the examples in docstrings; every public function has one, or a line of code that shows its use."""

import doctest
import importlib
import inspect
import pkgutil
import unittest

import eigentrail


class Docstrings(unittest.TestCase):
    def test_examples(self):
        for module in pkgutil.iter_modules(eigentrail.__path__):
            if module.name.startswith("_") or module.name == "plot":
                continue
            with self.subTest(module.name):
                failed, _ = doctest.testmod(importlib.import_module(f"eigentrail.{module.name}"), optionflags=doctest.ELLIPSIS)
                self.assertEqual(failed, 0)

    def test_all_that_is_public_says_what_it_does(self):
        for name in eigentrail.__all__:
            thing = getattr(eigentrail, name)
            if callable(thing):
                self.assertTrue(inspect.getdoc(thing), name)


if __name__ == "__main__":
    unittest.main()
