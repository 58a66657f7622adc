"""Matrix families with faults, in the scene and in HDF5 files."""

import h5py
import numpy as np

from good import HELD, MATRICES, TWO_SHORT_RODS, blade_with, family

ONE = np.eye(2)


def good_matrices(file):
    for name in ("M/0", "K/0", "K/1"):
        file[name] = ONE


def matrix_file(**changes):
    """Writes a good file with other datasets: M_0 stands for /M/0; None leaves it out."""
    def write(path):
        with h5py.File(path, "w") as file:
            good_matrices(file)
            for key, matrix in changes.items():
                name = key.replace("_", "/", 1)
                if name in file:
                    del file[name]
                if matrix is not None:
                    file[name] = matrix
    return write


def cut(share):
    """Writes the first part of a good file."""
    def write(path):
        matrix_file()(path)
        path.write_bytes(path.read_bytes()[:int(share * path.stat().st_size)])
    return write


def linked(link):
    """Writes a good file in which /K/0 is a link."""
    def write(path):
        matrix_file(K_0=None)(path)
        with h5py.File(path, "r+") as file:
            file["K/0"] = link
    return write


def in_raw_file(path):
    """Writes a good file whose /K/0 is stored as raw bytes in another file (external storage)."""
    matrix_file(K_0=None)(path)
    with h5py.File(path, "r+") as file:
        file.create_dataset("K/0", (2, 2), "f8", external=[("scene.toml", 0, 32)])


def virtual(path):
    """Writes a good file whose /K/0 is composed of data in another file (virtual dataset)."""
    matrix_file(K_0=None)(path)
    layout = h5py.VirtualLayout((2, 2), "f8")
    layout[:] = h5py.VirtualSource("good.h5", "K/0", (2, 2))
    with h5py.File(path, "r+") as file:
        file.create_virtual_dataset("K/0", layout)


def stored(**storage):
    """Writes a good file with /K/0 stored in another way."""
    def write(path):
        with h5py.File(path, "w") as file:
            good_matrices(file)
            del file["K/0"]
            file.create_dataset("K/0", data=ONE, **storage)
    return write


def beside_good(write):
    """Writes a good file, too, to which the first one leads."""
    def write_both(path):
        matrix_file()(path.with_name("good.h5"))
        write(path)
    return write_both


def nested(path):
    matrix_file(M_0=None)(path)
    with h5py.File(path, "r+") as file:
        file["M/0/0"] = ONE


# What scenes below name.
FILES = {
    "good.h5": matrix_file(),
    "mass.h5": matrix_file(K_0=None, K_1=None),
    "vector.h5": matrix_file(M_0=ONE[0]),
    "folder.h5": lambda path: path.mkdir(),
    "empty.h5": lambda path: path.write_bytes(b""),
    "half.h5": cut(0.5),
    "no_mass.h5": matrix_file(M_0=None),
    "number.h5": matrix_file(M_0=1.0),
    "wide.h5": matrix_file(M_0=np.ones((2, 3))),
    "large.h5": matrix_file(K_1=np.eye(3)),
    "damping.h5": matrix_file(C_0=np.eye(3)),
    "constraints.h5": matrix_file(A_0=np.ones((1, 3))),
    "constraints_of_powers.h5": matrix_file(A_0=np.ones((1, 2)), A_1=np.ones((2, 2))),
    "no_rows.h5": matrix_file(M_0=np.zeros((0, 0))),
    "texts.h5": matrix_file(K_0=np.array([[b"1", b"0"], [b"0", b"1"]])),
    "complex.h5": matrix_file(K_0=ONE.astype(complex)),
    "records.h5": matrix_file(K_0=np.zeros((2, 2), dtype=[("a", "f8"), ("b", "f8")])),
    "nan.h5": matrix_file(K_1=np.array([[1.0, np.nan], [0.0, 1.0]])),
    "power.h5": matrix_file(K_two=ONE),
    "negative.h5": matrix_file(**{"K_-1": ONE}),
    "high.h5": matrix_file(K_10000=ONE),
    "misspelt.h5": matrix_file(m_0=ONE),
    "plain.h5": matrix_file(M_0=None, M=ONE),
    "nested.h5": nested,
    "dangling.h5": linked(h5py.SoftLink("/nothing")),
    "elsewhere.h5": beside_good(linked(h5py.ExternalLink("good.h5", "/K/0"))),
    "raw.h5": in_raw_file,
    "virtual.h5": beside_good(virtual),
    "lzf.h5": stored(compression="lzf"),
    "link.h5": lambda path: path.symlink_to("/dev/null"),
    "circle.h5": lambda path: path.symlink_to("circle.h5"),
}


def write_files(folder, scene):
    """The matrix files that the scenes name."""
    for name, write in FILES.items():
        if f'"{name}"' in scene:
            write(folder / name)


def in_file(name, file, *fragments):
    """A scene with its matrices in a file."""
    return family(name, MATRICES, f'§file = "{file}"', "[matrix_family] file:", *fragments)


def unfit(name, file, *fragments):
    """A file whose matrices are no family: the message must point to the table of the family."""
    return family(name, "[matrix_family]\n" + MATRICES, f'§[matrix_family]\nfile = "{file}"', "[matrix_family]", *fragments)


def unreadable(name, file, *fragments):
    """The same, with the name of the file in the message."""
    return in_file(name, file, file, *fragments)

MODELS = [
    ("two rods too short to meet", TWO_SHORT_RODS,
     ("no equilibrium found: largest residual", "of its scale, in the constraint ", "(KINSOL stopped after")),
    blade_with("constraints that leave no freedom", HELD, "the constraints leave no freedom"),
    family("matrix without rows", "M = [[[1, 0], [0, 1]]]", "§M = [[]]", "[matrix_family] M: has 0 rows"),
    family("list of rows where a list of matrices belongs", "M = [[[1, 0], [0, 1]]]", "§M = [[1, 0], [0, 1]]",
           "[matrix_family] M: expected a list of matrices"),
    family("pencil of zeros", "M = [[[1, 0], [0, 1]]]\nK = [[[1, 0], [0, 2]], [[0, 1], [1, 0]]]",
           "M = [[[0]]]\nK = [[[0]], [[0]]]", "the pencil is singular at p = 0", "constrain it"),
    family("freedom without mass and stiffness", "M = [[[1, 0], [0, 1]]]\nK = [[[1, 0], [0, 2]], [[0, 1], [1, 0]]]",
           "M = [[[1, 0], [0, 0]]]\nK = [[[1, 0], [0, 0]], [[1, 0], [0, 0]]]", "the pencil is singular at p = 0"),
]

MATRIX_FILES = [
    family("matrix file that does not exist", MATRICES, '§file = "none.h5"',
           "[matrix_family] file:", "none.h5"),
    family("matrix file above the scene", MATRICES, '§file = "../x.h5"',
           "[matrix_family] file: expected a file in the scene's folder or below it", "../x.h5"),
    family("matrix file with an absolute path", MATRICES, '§file = "/x.h5"',
           "[matrix_family] file: expected a file in the scene's folder or below it", "/x.h5"),
    family("matrix file that is no HDF5 file", MATRICES, '§file = "scene.toml"',
           "[matrix_family] file:", "scene.toml", "/M/0"),
    family("matrix file without K", MATRICES, '§file = "mass.h5"', "[matrix_family] file:", "mass.h5", "/K/0"),
    family("matrix file with a vector", MATRICES, '§file = "vector.h5"', "dataset /M/0: expected a matrix"),
    family("matrix file and matrices", "M =", 'file = "good.h5"\n§M =', "[matrix_family] M:", "not both"),
]


def in_family(name, old, new, *fragments):
    """The message must point to the key behind "§"."""
    return family(name, old, new, "[matrix_family]", *fragments)


M, K = "M = [[[1, 0], [0, 1]]]", "K = [[[1, 0], [0, 2]], [[0, 1], [1, 0]]]"

INLINE = [
    family("family without M", M + "\n", "", "[matrix_family] M: is missing; expected a list of matrices")
    + (("[matrix_family]", "§[matrix_family]"),),
    in_family("M as a number", M, "§M = 1", "M: expected a list of matrices", "found a number"),
    in_family("no matrices", M, "§M = []", "M: expected at least one matrix"),
    in_family("matrix of empty rows", M, "§M = [[[], []]]", "M:", "0"),
    in_family("M that is not square", M, "§M = [[[1, 0, 0], [0, 1, 0]]]", "M: is 2 x 3; expected a square matrix"),
    in_family("K of another size", K, "§K = [[[1, 0, 0], [0, 1, 0], [0, 0, 1]]]", "K: is 3 x 3, M is 2 x 2"),
    in_family("C of another size", K, f"{K}\n§C = [[[1]]]", "C: is 1 x 1, M is 2 x 2"),
    in_family("constraints of another size", K, f"{K}\n§A = [[[1, 0, 0]]]", "A: is 1 x 3, M is 2 x 2"),
    in_family("constraints of other rows in another power", K, f"{K}\n§A = [[[1, 0]], [[1, 0], [0, 1]]]",
              "A: is 2 x 2", "the same rows for every power"),
    in_family("rows of different length in the second power", K, "§K = [[[1, 0], [0, 2]], [[0, 1], [1]]]",
              "K: power 1: row 2 has 1 entries, row 1 has 2"),
    in_family("empty first row", K, "§K = [[[], [0, 2]]]", "K: power 0: row 2 has 2 entries, row 1 has 0"),
    in_family("unknown parameter in an entry", K, '§K = [[["k", 0], [0, 2]]]', 'K: in "k" at character 1',
              "unknown parameter 'k'"),
    in_family("truth in an entry", K, "§K = [[[true, 0], [0, 2]]]",
              "K: expected a number or an expression, found true or false"),
    in_family("list in an entry", K, "§K = [[[[1], 0], [0, 2]]]", "K: expected a number or an expression, found an array"),
    in_family("nan in an entry", K, "§K = [[[nan, 0], [0, 2]]]", "K: expected a finite number"),
    in_family("division by zero in an entry", K, '§K = [[["1 / 0", 0], [0, 2]]]', "K: has an entry that is not finite"),
    in_family("division by zero in an entry at the end", K, '§K = [[["1 / (1 - p)", 0], [0, 2]]]', "K:", "finite"),
    in_family("powers without end", K, f"§K = [{', '.join(['[[1, 0], [0, 1]]'] * 200)}]", "K: has powers beyond"),
    family("two families", "[matrix_family]\n", "[[matrix_family]]\n", "[matrix_family]: a scene has one of these")
    + ((K, f"{K}\n\n§[[matrix_family]]\nM = [[[1]]]\nK = [[[1]]]"),),
    family("family as a number", f"[matrix_family]\n{M}\n{K}\n", "", "matrix_family: expected a table [matrix_family]")
    + (("[trace]", "§matrix_family = 3\n[trace]"),),
    family("no family", f"[matrix_family]\n{M}\n{K}\n", "matrix_family = []\n", "matrix_family")
    + (("[trace]\n", ""), ('parameter = "p"\nfrom = 0\nto = 1\n', "trace = { parameter = \"p\", from = 0, to = 1 }\n")),
    family("point beside a family", "[matrix_family]",
           '[[§point]]\nname = "x"\nmass = 1\nposition = [0, 0, 0]\n\n[matrix_family]',
           "point: unknown key in a scene with [matrix_family]"),
    family("family that does not depend on the parameter", K, "K = [[[1, 0], [0, 2]]]",
           "[parameters] p: nothing in the scene uses this parameter") + (("parameter =", "§parameter ="),),
    family("parameter of a family that is no name", '"p"', '"2p"', "2p") + (("parameter =", "§parameter ="),),
    family("effect to leave out of a family", "to = 1", 'to = 1\n§without = "gravity"', "[trace] without:", "gravity"),
    family("constraints that leave nothing", K, f"{K}\nA = [[[1, 0], [0, 1]]]", "the constraints leave no freedom"),
    family("file as a number", MATRICES, "§file = 3", "[matrix_family] file: expected a text, found a number"),
    family("file without a name", MATRICES, '§file = ""', "[matrix_family] file: expected a file in the scene's folder"),
]

HDF5 = [
    unreadable("file by a way round", "sub/../good.h5", "expected a file in the scene's folder or below it"),
    unreadable("file in a folder that does not exist", "sub/good.h5"),
    unreadable("file that is a folder", "folder.h5"),
    unreadable("file that is empty", "empty.h5"),
    unreadable("half a file", "half.h5"),
    unreadable("file without M", "no_mass.h5", "/M/0"),
    in_file("matrix of no dimensions", "number.h5", "dataset /M/0: expected a matrix"),
    unfit("matrix in a file that is not square", "wide.h5", "M: is 2 x 3; expected a square matrix"),
    unfit("matrices in a file of different size", "large.h5", "K: is 3 x 3, M is 2 x 2"),
    unfit("damping in a file of another size", "damping.h5", "C: is 3 x 3, M is 2 x 2"),
    unfit("constraints in a file of another size", "constraints.h5", "A: is 1 x 3, M is 2 x 2"),
    unfit("constraints in a file of other rows", "constraints_of_powers.h5", "A: is 2 x 2"),
    unfit("matrix in a file without rows", "no_rows.h5", "M: has 0 rows"),
    unreadable("texts in place of numbers", "texts.h5", "/K/0"),
    unreadable("complex matrix", "complex.h5", "/K/0"),
    unreadable("records in place of numbers", "records.h5", "/K/0"),
    unfit("nan in a file", "nan.h5", "K: has an entry that is not finite"),
    in_file("power in letters", "power.h5", "matrix /K/two: neither a power of the parameter"),
    in_file("negative power", "negative.h5", "dataset /K/-1: expected a power from 0 to"),
    in_file("power beyond all use", "high.h5", "dataset /K/10000: expected a power from 0 to"),
    in_file("misspelt group", "misspelt.h5", "unknown 'm' in it", "did you mean 'M'?"),
    in_file("matrix where its powers belong", "plain.h5", "/M"),
    unreadable("group where a matrix belongs", "nested.h5", "/M/0"),
    unreadable("link to nothing", "dangling.h5", "/K/0"),
    unreadable("link to another file", "elsewhere.h5", "/K/0"),
    unreadable("matrix that lies in another file as bytes", "raw.h5", "/K/0"),
    unreadable("matrix put together from another file", "virtual.h5", "/K/0"),
    unreadable("matrix compressed by LZF", "lzf.h5", "/K/0 is compressed by 'lzf'; write it with deflate"),
    unreadable("link that leads out of the folder", "link.h5", "leads out of the scene's folder"),
    unreadable("link that leads to itself", "circle.h5"),
]

SCENES = MODELS + MATRIX_FILES + INLINE + HDF5
