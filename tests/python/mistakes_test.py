"""Mistakes that are made in Python on the first day: what is called, the error, and what its message must contain. No message
shows what works inside."""

import inspect
import os
import re
import tempfile
import tomllib
import unittest
from functools import partial as call

import eigentrail as et
import numpy as np
import scipy.sparse as sp

from program import BLADE, LIBRARIES

# What a message of another library, or of the inside of the package, looks like.
INSIDE = re.compile(LIBRARIES + r"|incompatible function arguments|_engine|unpack|not iterable|not a mapping|has no attribute|"
                    r"pybind|max_workers|zero-size|could not convert| at 0x")

TABLES = tomllib.loads(BLADE)
E2 = np.eye(2)
TWO = et.Family(M=E2, K=[np.diag([1.0, 2.0]), E2], parameter="p")
trace, boundary, stability, study = (call(function, BLADE) for function in (et.trace, et.boundary, et.map, et.accuracy))
spectrum, sweep, window = call(et.spectrum, BLADE), call(et.sweep, BLADE), call(et.map, BLADE, drag=(1, 2))


def point(**other):
    return {**TABLES, "point": [{**TABLES["point"][0], **other}]}


def rod(**other):
    return {**TABLES, "rod": [{**TABLES["rod"][0], **other}]}


def function_of(result):
    return call(et.trace, et.Family(lambda p: result), p=(0, 1))


# (what is called, fragments of the message); what is called with `loci` or `curves` gets a result.
SCENES = [
    (call(et.trace, None), "expected a scene: a path, a text, a dict", "found NoneType"),
    (call(et.trace, 3), "expected a scene", "found int"),
    (call(et.trace, ["scene.toml"]), "expected a scene", "found list"),
    (call(et.trace, b"abc"), "expected a scene", "found bytes"),
    (call(et.trace, E2), "expected a scene", "found ndarray"),
    (call(et.trace, ""), "no such file"),
    (call(et.trace, "scen.toml"), "scen.toml: no such file"),
    (call(et.trace, "folder"), "folder: is a folder; give the name of a file"),
    (call(et.trace, "loci.h5"), "loci.h5: is an HDF5 file, no scene", "'eigentrail info' says what it holds"),
    (call(et.trace, "page.txt"), "page.txt:1:", "not valid TOML"),
    (call(et.trace, {}), "[trace] from: is missing", "a range such as speed=(0, 400)"),
    (call(et.trace, {"trace": 3}), "trace: expected a table [trace], found a number"),
    (call(et.trace, {**TABLES, "rod": 3}), "rod: expected a table [rod], found a number"),
    (call(et.trace, {**TABLES, "rods": [{}]}), "rods: unknown key", "did you mean 'rod'?"),
    (call(et.trace, {**TABLES, 5: 3}), "5: unknown key"),
    (call(et.trace, rod(to="balde")), "[[rod]] 1 to: no point is called 'balde'; did you mean 'blade'?"),
    (call(et.trace, rod(length="2**2")), '[[rod]] 1 length: in "2**2" at character 2: powers are written with \'^\''),
    (call(et.trace, rod(length=-1)), "[[rod]] 1 length: must be positive; found -1"),
    (call(et.trace, rod(lenght=5)), "lenght: unknown key", "did you mean 'length'?"),
    (call(et.trace, point(mass=None)), "a scene holds numbers, texts, lists and dictionaries, not NoneType"),
    (call(et.trace, point(mass=1 + 2j)), "a scene holds real numbers, not (1+2j)"),
    (call(et.trace, point(mass=float("nan"))), "[[point]] 1 mass: expected a finite number"),
    (call(et.trace, point(position=[6, 0])), "[[point]] 1 position: expected three numbers", "found 2"),
    (call(et.trace, BLADE.replace('"mass"', "mass")), "put expressions and names in quotes"),
    (call(et.explain, "scen.toml"), "scen.toml: no such file"),
    (call(et.explain, BLADE, sensitvity=True), "did you mean 'sensitivity'?"),
    (call(et.explain, BLADE, sensitivity="yes"), "sensitivity: expected True or False, found 'yes'"),
]

PARAMETERS = [
    (call(trace, omega=(5,)), "omega: expected a range of two values, such as omega=(0, 400), found 1 values"),
    (call(trace, omega=np.linspace(0, 100, 5)), "omega: expected a range of two values", "found 5 values"),
    (call(trace, omega=30), "omega: is the traced parameter; give it a range, omega=(from, to)"),
    (call(trace, viscosity=2), "known: omega, mass, length"),
    (call(trace, omega=(5, 5)), "to: equals from (5): the range is empty"),
    (call(trace, omega=(np.nan, 5)), "from: expected a finite number"),
    (call(trace, omega=(0, np.inf)), "to: expected a finite number"),
    (call(trace, omega=(5, "100 furlong")), "to: unit 'furlong' is not known", "write it like"),
    (call(trace, omega=(5, "100 kg")), "100 kg does not fit omega, which is in rad/s"),
    (call(trace, omega="fast"), "omega: ", "unknown parameter 'fast'"),
    (call(trace, omega=range(5)), "omega: expected a number, a text with a unit, an expression, or a pair: a range"),
    (call(trace, omgea=(0, 5)), "omgea: is no parameter of the scene, and no keyword of trace; did you mean 'omega'?"),
    (call(trace, omega=(0, 5), drag=(1, 2)), "expected the range of one parameter, found those of omega, drag"),
    (call(trace, drag=1j), "drag: expected a number, a text with a unit", "found 1j"),
    (call(trace, drag=None), "drag: expected a number", "found None"),
    (call(trace, drag={}), "drag: expected a number", "found {}"),
    (call(trace, drag="2**2"), 'drag: in "2**2" at character 2: powers are written with \'^\''),
    (call(trace, drag="2 omga"), "drag: unit 'omga' is not known", "write it like"),
    (call(trace, drag="2*omga"), "drag: ", "unknown parameter 'omga'; did you mean 'omega'?"),
    (call(trace, drag=float("nan")), "drag: ", "unknown parameter 'nan'"),
    (call(trace, length=-1), "length: must be positive; found -1"),
    (call(trace, settings=[("drag", 3)]), "settings: expected a dict, found [('drag', 3)]"),
    (call(trace, settings={"drug": 3}), "did you mean 'drag'?"),
    (call(trace, **{"from": 3}), "from: is no parameter of the scene"),
]

OPTIONS = [
    (call(trace, tolerance="tight"), "tolerance: expected a number, found 'tight'"),
    (call(trace, tolerance=[1e-6]), "tolerance: expected a number, found [1e-06]"),
    (call(trace, tolerance=0), "tolerance: must lie between 1e-13 and 0.1; found 0"),
    (call(trace, tolerance=1), "tolerance: must lie between 1e-13 and 0.1; found 1"),
    (call(trace, tolerence=1e-8), "did you mean 'tolerance'?"),
    (call(trace, modes=0), 'modes: must be at least 1, or "all"'),
    (call(trace, modes=2.5), "modes: expected a whole number, found 2.5"),
    (call(trace, modes="many"), 'modes: expected a whole number or "all", found "many"'),
    (call(trace, modes=[1, 2]), "modes: ", "unexpected ','"),
    (call(trace, modes={"band": 3}), 'modes band: expected two frequencies, the lower one first: ["0.05 Hz", "3 Hz"]'),
    (call(trace, modes={"band": ["1 kg", "2 kg"]}), 'modes band: expected a frequency such as "3 Hz"', 'found "1 kg"'),
    (call(trace, modes={"cuont": 3}), "did you mean 'count'?"),
    (call(trace, certify="yes"), "certify: expected True or False, found 'yes'"),
    (call(trace, certify=2), "certify: expected True or False, found 2"),
    (call(trace, threads=-1), "threads: expected 0 to 1024, found -1"),
    (call(trace, threads="all"), "threads: expected a whole number, found 'all'"),
    (call(trace, threads=1.5), "threads: expected a whole number, found 1.5"),
    (call(trace, options=3), "options: expected a dict, found 3"),
    (call(trace, options={"order": 9}), 'order: must lie between 1 and 4, or be "auto"'),
    (call(trace, options={"order": "high"}), 'order: expected a whole number or "auto", found "high"'),
    (call(trace, options={"max_nodes": 1}), "max_nodes: must be at least 2"),
    (call(trace, options={"max_stp": 1}), "did you mean 'max_step'?"),
    (call(trace, options={"without": "rod"}), "without: 'rod' is no effect of this scene that can be left out", "known: frame, drag"),
    (call(trace, options={"tolerance": 1e-3}, tolerance=1e-6), "tolerance: is a keyword, and among the options; give one of them"),
    (call(trace, events=[1]), "events: expected a dict, found [1]"),
    (call(trace, events={"harmonics": "first"}), "[events] harmonics: ", "unknown parameter 'first'"),
    (call(trace, events={"harmonic": 1}), "did you mean 'harmonics'?"),
]

PLANES = [
    (boundary, "expected the ranges of two parameters, such as speed=(0, 400), damping=(500, 4000); found none"),
    (call(boundary, drag=3), "expected the ranges of two parameters"),
    (call(boundary, drug=(1, 2)), "did you mean 'drag'?"),
    (call(boundary, drag=(3, 3)), "to: equals from (3): the window is empty"),
    (call(boundary, drag=(1, np.inf)), "drag: expected finite numbers"),
    (call(boundary, drag=("1", "2")), "drag: expected finite numbers in the unit of the parameter, found '1'"),
    (call(boundary, drag=(1, 2), mass=(1, 2), length=(1, 2)), "found drag, mass, length"),
    (call(boundary, drag=(1, 2), lines=-1), "lines: must lie between 0 and 1000; found -1"),
    (call(boundary, drag=(1, 2), lines="5"), "lines: expected a whole number, found '5'"),
    (call(boundary, drag=(1, 2), damping_ratio="low"), "damping_ratio: expected a number, found 'low'"),
    (call(boundary, drag=(1, 2), damping_ratio=3), "damping_ratio: must lie between -1 and 1; found 3"),
    (call(boundary, drag=(1, 2), tolerance="x"), "tolerance: expected a number, found 'x'"),
    (call(et.boundary, TWO, p=(0, 1)), "expected the ranges of two parameters", "found p"),
    (stability, "expected the ranges of two parameters"),
    (call(window, grid=(3,)), "grid: expected a whole number or a pair of whole numbers, found (3,)"),
    (call(window, grid="5x5"), "grid: expected a whole number or a pair of whole numbers, found '5x5'"),
    (call(window, grid=2.5), "grid: expected a whole number or a pair of whole numbers, found 2.5"),
    (call(window, grid=0), "grid: expected at least 2 values of each parameter, found 0x0"),
    (call(window, grid=10**6), "grid: expected at most 10000000 cells, found 1000000x1000000"),
    (call(window, gird=3), "did you mean 'grid'?"),
    (call(window, jobs=-1), "jobs: expected 0 to 1024, found -1"),
    (call(window, jobs="all"), "jobs: expected a whole number, found 'all'"),
    (call(stability, drag=(1, 1)), "to: equals from (1): the window is empty"),
    (call(study, tolerances=1e-6), "tolerances: expected a list of numbers, found 1e-06"),
    (call(study, tolerances=["x"]), "tolerances: expected a list of numbers, found ['x']"),
    (call(study, tolerances=[]), "tolerances: expected numbers from 1e-13 to 0.1"),
    (call(study, orders=4), "orders: expected a list of whole numbers, found 4"),
    (call(study, orders=[0]), "orders: expected numbers from 1 to 4"),
    (call(study, grids=[2]), "grids: expected numbers from 5 to 1000000"),
    (call(study, samples=0), "samples: expected a number from 1 to 1000000"),
    (call(study, repeat="often"), "repeat: expected a whole number, found 'often'"),
]

POINTS = [
    (call(spectrum, at="fast"), "at: expected finite numbers in the unit of the parameter, found 'fast'"),
    (call(spectrum, at=[np.nan]), "at: expected finite numbers", "found nan"),
    (call(spectrum, at=1j), "at: expected finite numbers", "found 1j"),
    (call(spectrum, at=3, modes="x"), 'modes: expected a whole number or "all", found "x"'),
    (call(spectrum, mdoes=2), "did you mean 'modes'?"),
    (call(sweep, 3), "over: expected a dict of lists, found 3"),
    (call(sweep, {}), "expected values of at least one parameter: {'damping': [500, 1000, 2000]}"),
    (call(sweep, {"drag": 3}), "over: expected a dict of lists, found {'drag': 3}"),
    (call(sweep, {"drag": []}), "expected values of at least one parameter"),
    (call(sweep, {"drag": ["x"]}), "drag: ", "unknown parameter 'x'"),
    (call(sweep, {"drug": [1]}), "did you mean 'drag'?"),
    (call(sweep, {"omega": [1, 2]}), "omega: is the traced parameter; give it a range, omega=(from, to)"),
    (call(sweep, {"drag": [1]}, tolerence=1e-8), "did you mean 'tolerance'?"),
    (call(sweep, {"drag": [1]}, drag=3), "drag: is swept, and has a value of its own; give one of them"),
    (call(sweep, {"drag": [1]}, points=0), "points: expected the number of values of the traced parameter, 2 at least"),
    (call(sweep, {"drag": [1]}, points="x"), "points: expected the number of values", "found 'x'"),
    (call(sweep, {"drag": [1]}, jobs=-1), "jobs: expected 0 to 1024, found -1"),
]

FILES = [
    (call(et.open, 3), "path: expected a text or a path, found 3"),
    (call(et.open, "none.h5"), "none.h5"),
    (call(et.open, "folder"), "folder: is not a plain file; folders, pipes and devices are not read"),
    (call(et.open, "/dev/null"), "/dev/null: is not a plain file"),
    (call(et.open, "scene.toml"), "scene.toml: is a scene, no result; give it to eigentrail.trace"),
    (call(et.open, "page.txt"), "page.txt: cannot be read", "it is no HDF5 file, or damaged"),
    (call(et.open, "a.npz"), "a.npz: cannot be read"),
    (call(et.from_files, "numpi", "a.npz"), "did you mean 'numpy'?"),
    (call(et.from_files, 3, "a.npz"), "format: expected a text, found 3"),
    (call(et.from_files, "numpy", 3), "files: expected a text or a path or a list of texts or paths, found 3"),
    (call(et.from_files, "numpy", []), "numpy: expected one .npz file with all samples"),
    (call(et.from_files, "numpy", "none.npz"), "none.npz: no such file"),
    (call(et.from_files, "numpy", "folder"), "folder: is a folder; give the name of a file"),
    (call(et.from_files, "numpy", "page.txt"), "page.txt: cannot be read as an archive of NumPy (.npz)"),
    (call(et.from_files, "numpy", "a.npz", digits="x"), "digits: expected a whole number from 1 to 17, or all; found 'x'"),
    (call(et.from_files, "numpy", "a.npz", digit=3), "did you mean 'digits'?"),
    (call(et.from_files, "matlab", "a.npz"), "a.npz: cannot be read: is no file of MATLAB (.mat)"),
    (call(et.from_openfast, "page.txt"), "page.txt:1: no table", "is this a linearization file of OpenFAST (.lin)"),
    (call(et.from_ross, 3), "rotor: expected a Rotor of ROSS, found int"),
]

FAMILIES = [
    (call(et.trace, TWO), "[trace] from: is missing", "a range such as"),
    (call(et.trace, TWO, q=(0, 1)), "q: is no parameter of the scene", "known: p,"),
    (call(et.trace, et.Family(M=E2, K=E2)), "expected the range of one parameter, such as omega=(0, 400), or the name"),
    (call(et.Family), "expected matrices"),
    (call(et.Family, 3), "expected a function"),
    (call(et.Family, lambda p: p, M=E2, K=E2), "expected matrices"),
    (call(et.Family, M=E2), "expected K with M, C or both; found M"),
    (call(et.Family, M=E2, A=E2), "expected M, C, K or E, A; found M, A"),
    (call(et.Family, M=E2, K=E2, paramter="p"), "paramter is no keyword; did you mean 'parameter'?"),
    (call(et.Family, M=E2 * 1j, K=E2), "M: expected real numbers, found the complex 1j", "np.block"),
    (call(et.Family, M=sp.eye(2) * 1j, K=E2), "M: expected real numbers, found the complex 1j"),
    (call(et.Family, M=E2, K="matrix"), "K: expected numbers, found entries of the type"),
    (call(et.Family, M=np.ma.masked_array(E2, mask=E2), K=E2), "M: has masked entries", ".filled(0.0)"),
    (call(et.Family, M=[2.0, 1.0], K=E2), "a diagonal matrix is np.diag(M)"),
    (call(et.Family, M=E2, K=np.ones((2, 3))), "K: expected a square matrix, found an array of shape (2, 3)"),
    (call(et.Family, M=E2, K=[E2, np.eye(3)]), "K[1]: is 3 x 3, but M is 2 x 2"),
    (call(et.Family, M=E2, K=[E2, E2 * np.nan]), "K[1]: has an entry that is not finite"),
    (call(et.Family, M=E2, K=E2, names=["x"]), "names: expected 2 of them", "found 1"),
    (call(et.trace, et.Family(M=E2, K=[E2, E2], parameter="p", unit="furlong"), p=(0, 1)), "unit 'furlong' is not known"),
    (function_of(3), "the function of the family, at p = 1.0: expected a dict with matrices M, C, K or E, A; found int"),
    (function_of({"M": E2, "L": E2}), "at p = 1.0: ", "the key 'L'"),
    (function_of({"M": E2, "K": [1, 2]}), "at p = 1.0: K: expected a square matrix", "np.diag(K)"),
    (function_of({"M": E2}), "at p = 1.0: expected K with M, C or both; found M"),
    (function_of({"M": E2, "K": E2 * np.nan}), "at p = 1.0: K: has an entry that is not finite"),
    (function_of({"M": E2, "K": np.eye(3)}), "at p = 1.0: K: is 3 x 3, but M is 2 x 2"),
    (call(et.map, et.Family(lambda p: {"M": E2, "K": E2}), p=(0, 1)), "a family that a function gives can be traced only"),
    (call(et.Samples, [0, 1]), "expected samples"),
    (call(et.Samples, "x", M=E2, K=E2), "p: expected numbers"),
    (call(et.Samples, [0, 1], M=E2, K=[E2, E2], paramter="p"), "paramter is no keyword; did you mean 'parameter'?"),
    (call(et.StateSpace, [E2, E2], [0, 1], paramter="p"), "paramter is no keyword; did you mean 'parameter'?"),
    (call(et.Samples, [0, 1], M=E2, K=[E2, np.eye(3)]), "K[1]: is 3 x 3, but K[0] is 2 x 2"),
    (call(et.Samples, [0, 1], M=E2, K=[E2, sp.csr_matrix(np.diag([np.inf, 1.0]))]), "K[1]: has an entry that is not finite"),
    (call(et.Samples, [0, 1], M=E2, K=[E2]), "K: expected 2 square matrices", "found 1 matrices"),
    (call(et.trace, et.Samples([0, 1], M=E2, K=[E2, 3 * E2], parameter="p"), p=(0, 2)), "p = 2 lies outside the samples, which reach from 0 to 1"),
    (call(TWO.save, "family.h5"), "family.h5: expected the name of a scene, *.toml"),
    (call(TWO.save, "none/family.toml"), "there is no such folder"),
]

RESULTS = [
    (lambda loci, curves: et.trace(loci), "expected a scene, found a result", ".attrs['scene']"),
    (lambda loci, curves: loci.eigentrail.sel(), "expected the traced parameter, omega=..., found nothing"),
    (lambda loci, curves: loci.eigentrail.sel(omgea=50), "expected the traced parameter, omega=..., found omgea=..."),
    (lambda loci, curves: loci.eigentrail.sel(omega=500), "omega = 500 lies outside the traced range 5 ... 100 rad/s"),
    (lambda loci, curves: loci.eigentrail.sel(omega="fast"), "omega: expected numbers, found 'fast'"),
    (lambda loci, curves: loci.eigentrail.sel(omega=[[5, 6]]), "omega = an array of shape (1, 2): expected a number or a list"),
    (lambda loci, curves: loci.eigentrail.sel(omega=np.nan), "omega: expected finite numbers"),
    (lambda loci, curves: loci.eigentrail.sel(omega=50, mode="mode 9"), "mode 'mode 9': expected one of 'mode 1', 'mode 2', 'lag', 'flap'"),
    (lambda loci, curves: loci.eigentrail.save("loci.h5"), "loci.h5: exists already; give another name, or overwrite=True"),
    (lambda loci, curves: loci.eigentrail.save("none/loci.h5"), "none/loci.h5: there is no such folder"),
    (lambda loci, curves: loci.eigentrail.curve(1), "only boundary files have this; the Dataset is of the format 'eigentrail-loci'"),
    (lambda loci, curves: curves.eigentrail.events, "only loci files have this; the Dataset is of the format 'eigentrail-boundary'"),
    (lambda loci, curves: curves.eigentrail.curve(99), "curve 99: the file has 0 curves, counted from 0"),
    (lambda loci, curves: et.gradient(loci), "flutter 0: the trace has 0 flutter points"),
    (lambda loci, curves: et.gradient(loci, "fluter"), "quantity: expected one of flutter, damping_ratio", "found 'fluter'"),
    (lambda loci, curves: et.gradient(BLADE), "loci: expected a Dataset, found"),
    (lambda loci, curves: et.least_damping(loci, mode="x"), "mode 'x': expected one of 'mode 1'"),
    (lambda loci, curves: et.events(BLADE), "loci: expected a Dataset, found"),
]

TABLES_OF_MISTAKES = {name: rows for name, rows in globals().items() if name.isupper() and isinstance(rows, list)}


class Mistakes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="eigentrail-")
        cls.addClassCleanup(folder.cleanup)
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        os.mkdir("folder")
        for name, text in (("scene.toml", BLADE), ("page.txt", "hello")):
            with open(name, "w", encoding="utf-8") as file:
                file.write(text)
        np.savez("a.npz", M=E2, K=3 * E2)
        cls.results = et.trace(BLADE), et.boundary(BLADE, drag=(1, 3), lines=1)
        cls.results[0].eigentrail.save("loci.h5")

    def test_each_message_has_place_and_advice(self):
        for table, rows in TABLES_OF_MISTAKES.items():
            for number, (mistake, *fragments) in enumerate(rows):
                given = self.results if inspect.isfunction(mistake) else ()
                with self.subTest(table, number=number, fragment=fragments[0]):
                    with self.assertRaises((et.Error, TypeError, OSError)) as raised:
                        mistake(*given)
                    message = str(raised.exception)
                    for fragment in fragments:
                        self.assertIn(fragment, message)
                    self.assertNotRegex(message, INSIDE)


if __name__ == "__main__":
    unittest.main()
