"""Checks the dependences in src/continuation: no file calls into another that calls back.

    calls_test.py SOURCES [OBJECTS]

SOURCES is the folder src/continuation. Files with one name, x.hpp and x.cpp, are one unit; a public header
eigentrail/continuation/x.hpp belongs to the unit x, too. Two graphs must have no cycle: that of the includes, and,
where OBJECTS (the folder of the compiled files) is given, that of the symbols which a unit uses and another one
defines. No class there may have more than 25 member functions.
"""
import pathlib
import re
import subprocess
import sys
import unittest

SOURCES = pathlib.Path(sys.argv[1])
OBJECTS = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
KNOWN_CYCLES = []  # empty, and to stay so
MOST_MEMBER_FUNCTIONS = 25


def units():
    return {path.stem for path in SOURCES.rglob("*.[ch]pp")}


def includes():
    graph = {}
    for path in SOURCES.rglob("*.[ch]pp"):
        used = re.findall(r'#include "(?:eigentrail/)?continuation/(?:\w+/)?(\w+)\.hpp"', path.read_text())
        graph.setdefault(path.stem, set()).update(set(used) & units() - {path.stem})
    return graph


def symbols(path, kinds):
    lines = subprocess.run(["nm", path], capture_output=True, text=True, check=True).stdout.splitlines()
    return {words[-1] for words in map(str.split, lines) if len(words) >= 2 and words[-2] in kinds}


def calls():
    objects = {path.name.split(".")[0]: path for path in OBJECTS.rglob("*.o")}
    owner = {}
    for unit, path in objects.items():
        # Functions that a file alone defines; templates and inline ones (W) may be in several.
        for symbol in symbols(path, "TDBR"):
            owner[symbol] = unit
    graph = {}
    for unit, path in objects.items():
        used = {owner[symbol] for symbol in symbols(path, "U") if symbol in owner}
        graph[unit] = used - {unit}
    return graph


def cycles(graph):
    """Strongly connected parts of more than one unit (Tarjan 1972)."""
    order, low, stack, found = {}, {}, [], []

    def visit(unit):
        order[unit] = low[unit] = len(order)
        stack.append(unit)
        for other in graph.get(unit, ()):
            if other not in order:
                visit(other)
            if other in stack:
                low[unit] = min(low[unit], low[other])
        if low[unit] == order[unit]:
            part = stack[stack.index(unit):]
            del stack[stack.index(unit):]
            if len(part) > 1:
                found.append(sorted(part))

    for unit in sorted(graph):
        if unit not in order:
            visit(unit)
    return found


def member_functions():
    """Declared member functions per class, by the shape of the text: what looks like name(...) at its own depth."""
    counts = {}
    for path in SOURCES.rglob("*.[ch]pp"):
        text = re.sub(r"//.*", "", path.read_text())
        for head in re.finditer(r"\b(?:class|struct) (\w+)(?: final)?(?: : [^{;]*)? \{", text):
            depth, at, body = 1, head.end(), ""
            while depth > 0:
                char = text[at]
                depth += (char == "{") - (char == "}")
                if depth == 1:
                    body += char
                at += 1
            declared = re.findall(r"[\w>&*\]] ?[&*]?\b(?:operator\S+|~?\w+)\([^;]*?\)[^;,(){}]*(?:;|\})", body)
            counts[head.group(1)] = len(declared)
    return counts


class Calls(unittest.TestCase):
    def test_units_are_found(self):
        self.assertGreater(len(units()), 50)
        self.assertIn("trace_loop", includes())

    def test_a_cycle_would_be_seen(self):
        self.assertEqual(cycles({"a": {"b"}, "b": {"c"}, "c": {"b"}}), [["b", "c"]])

    def test_no_file_includes_one_that_includes_it(self):
        self.assertEqual(cycles(includes()), KNOWN_CYCLES)

    @unittest.skipUnless(OBJECTS, "no compiled files given")
    def test_no_file_calls_one_that_calls_back(self):
        graph = calls()
        self.assertIn("trace_loop", graph)
        self.assertIn("step_judgement", graph["trace_loop"])
        self.assertEqual(cycles(graph), KNOWN_CYCLES)

    def test_no_class_has_grown_into_a_house(self):
        counts = member_functions()
        self.assertGreater(counts["TraceLoop"], 10)
        self.assertEqual({name: n for name, n in counts.items() if n > MOST_MEMBER_FUNCTIONS}, {})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
