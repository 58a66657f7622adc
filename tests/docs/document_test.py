"""Runs what a document shows: document_test.py FILE. Every block is run, checked, or listed with the reason why not."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from blocks import blocks, commands
from printed import DOTS, first_missing

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ["EIGENTRAIL"]).resolve()
# Ends a command that hangs; builds with sanitizers are slower.
TIME_LIMIT = 60.0 * float(os.environ.get("EIGENTRAIL_SLOWDOWN", "1"))


class Mistake(Exception):
    """The document and the program do not agree."""


def prepare(folder):
    """The files and programs that a reader has: scenes, documents, test data, and the program as built or on the path."""
    for name in ("data", "docs", "tests"):
        (folder / name).symlink_to(ROOT / name)
    for place in (folder / "build" / "release" / "apps", folder / "bin"):
        place.mkdir(parents=True)
        (place / "eigentrail").symlink_to(PROGRAM)


def full_scene(block):
    if "replaces" not in block.notes:
        rest = block.notes.get("completed by", "")
        return (ROOT / rest).read_text(encoding="utf-8") + block.text if rest.endswith(".toml") else f"{block.text}\n{rest}"
    table, source = block.notes["replaces"].split(" in ")
    scene = (ROOT / source).read_text(encoding="utf-8")
    full, count = re.subn(rf"^{re.escape(table)}.*\n(?:[^\[\n].*\n)*", lambda _: block.text + "\n", scene, flags=re.MULTILINE)
    if count != 1:
        raise Mistake(f"{source} has no table {table}, or several")
    return full


class Reader:
    """Runs the blocks of a document in a folder of its own."""

    def __init__(self, folder):
        self.folder, self.last_output = folder, None
        self.environment = os.environ | {"PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "MPLBACKEND": "agg",
                                         "OPENBLAS_NUM_THREADS": "1"}

    def run(self, command, expected=0):
        try:
            run = subprocess.run(command, cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL, capture_output=True,
                                 text=True, timeout=TIME_LIMIT, check=False)
        except subprocess.TimeoutExpired as hangs:
            raise Mistake(f"{command[-1]}: takes more than {TIME_LIMIT:.0f} s") from hangs
        if run.returncode != expected:
            raise Mistake(f"{command[-1]}: exit code {run.returncode}, not {expected}\n{run.stdout}{run.stderr}")
        return run.stdout.splitlines()

    def compare(self, shown, printed):
        missing = first_missing(shown, printed)
        if missing is not None:
            raise Mistake(f"it does not print\n{missing}\nbut\n" + "\n".join(printed))
        return f", {sum(line.strip() != DOTS for line in shown)} lines as shown" if shown else ""

    def shell(self, block):
        if "with" in block.notes:
            source, name = block.notes["with"].split(" as ")
            (self.folder / name).write_bytes((ROOT / source).read_bytes())
        compared, lines = "", commands(block.text)
        for command, shown in lines:
            if "eigentrail" not in command.split()[0]:
                raise Mistake(f"{command}: no command of eigentrail; say why it is not run")
            self.last_output = self.run(["bash", "-c", command], int(block.notes.get("exit code", 0)))
            if "output not compared" not in block.notes:
                compared += self.compare(shown, self.last_output)
        return f"{len(lines)} run{compared}"

    def scene(self, block):
        name = block.notes.get("as", f"scene_{block.line}.toml")
        (self.folder / name).write_text(full_scene(block), encoding="utf-8")
        self.run(["eigentrail", "explain", name])
        self.run(["eigentrail", "trace", name, "-o", f"traced_{block.line}.h5", "--quiet"])
        return "completed and traced" if block.notes.keys() & {"completed by", "replaces"} else "traced"

    def python(self, block):
        self.run(["/usr/bin/python3", "-c", block.text])
        return "run"

    def excerpt(self, block):
        source = (ROOT / block.notes["from"]).read_text(encoding="utf-8")
        at = 0
        for piece in block.text.split(f"\n{DOTS}\n"):
            at = source.find(piece, at)
            if at < 0:
                raise Mistake(f"{block.notes['from']} does not have\n{piece}")
        return f"as in {block.notes['from']}"

    def text(self, block):
        if not block.follows or "output not compared" in block.notes:
            return "figure" if not block.follows else f"not compared: {block.notes['output not compared']}"
        return "printed" + self.compare(block.text.split("\n"), self.last_output)

    def read(self, block):
        """What was done with a block."""
        if "not run" in block.notes:
            return f"not run: {block.notes['not run']}"
        if "from" in block.notes:
            return self.excerpt(block)
        if block.language == "cpp":
            raise Mistake("C++ that no compiler sees: name its source, or put programs into docs/examples, which are built")
        kinds = {"sh": self.shell, "toml": self.scene, "python": self.python, "text": self.text}
        if block.language not in kinds:
            raise Mistake(f"nobody knows how to test {block.language}; say why it is not run")
        return kinds[block.language](block)


def read_document(path, folder):
    """Prints the result for every block; returns the number of errors."""
    prepare(folder)
    reader, mistakes = Reader(folder), 0
    for block in blocks(path.read_text(encoding="utf-8")):
        where = f"{path.relative_to(ROOT)}:{block.line}"
        try:
            print(f"{where}: {block.language}: {reader.read(block)}")
        except Mistake as mistake:
            mistakes += 1
            print(f"{where}: {block.language}: FAILED\n{mistake}")
    return mistakes


def main():
    with tempfile.TemporaryDirectory(prefix="eigentrail-docs-") as folder:
        return min(read_document(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(folder)), 1)


if __name__ == "__main__":
    sys.exit(main())
