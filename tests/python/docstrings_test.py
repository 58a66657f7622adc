"""Runs the examples in docstrings; every public function has one, or a line of code that shows its use."""

import doctest
import importlib
import inspect
import pkgutil
import unittest

import eigentrail


# Constants, errors, and what needs files or rotors: other tests run them.
WITHOUT_EXAMPLE = {"__version__", "Error", "NotProjected", "NotResolved", "SceneError", "TraceError", "Imported", "Eigentrail",
                   "from_files", "from_openfast", "from_ross", "open"}


class Docstrings(unittest.TestCase):
    def test_examples(self):
        scope = {}  # all examples have the scene of that of `trace`
        for example in doctest.DocTestParser().get_examples(eigentrail.trace.__doc__)[:2]:
            exec(example.source, scope)
        for module in pkgutil.iter_modules(eigentrail.__path__):
            if module.name.startswith("_") or module.name == "plot":
                continue
            with self.subTest(module.name):
                failed, _ = doctest.testmod(importlib.import_module(f"eigentrail.{module.name}"), extraglobs=scope, optionflags=doctest.ELLIPSIS)
                self.assertEqual(failed, 0)

    def test_all_that_is_public_says_what_it_does(self):
        for name in eigentrail.__all__:
            thing = getattr(eigentrail, name)
            if callable(thing):
                self.assertTrue(inspect.getdoc(thing), name)

    def test_functions_have_examples(self):
        for name in set(eigentrail.__all__) - WITHOUT_EXAMPLE:
            with self.subTest(name):
                self.assertIn(">>>", inspect.getdoc(getattr(eigentrail, name)))


if __name__ == "__main__":
    unittest.main()
