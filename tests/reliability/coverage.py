"""How much of the sources the tests run, from llvm-cov's tracefile: coverage.py FILE.lcov FOLDER

Prints the share of lines that ran for every folder of FOLDER, and all lines that raise an error and never ran.
"""

import collections
import pathlib
import re
import sys

ERROR = re.compile(r"\bthrow\b|\b(fail|damaged|refused|require\w*)\(|\b(InputError|Hdf5Error)\(")


def lines_run(tracefile):
    """{file: {line: times}} of a tracefile; a line of several instances counts all of them."""
    counts = collections.defaultdict(collections.Counter)
    for entry in tracefile.read_text().splitlines():
        if entry.startswith("SF:"):
            file = pathlib.Path(entry[3:])
        elif entry.startswith("DA:"):
            line, times = entry[3:].split(",")[:2]
            counts[file][int(line)] += int(times)
    return counts


def print_shares(counts, root):
    folders = collections.defaultdict(lambda: [0, 0])
    for file, lines in counts.items():
        for name in (file.relative_to(root).parts[0], "all"):
            folders[name][0] += sum(times > 0 for times in lines.values())
            folders[name][1] += len(lines)
    for name, (run, lines) in sorted(folders.items(), key=lambda item: (item[0] == "all", item[0])):
        print(f"  {name:<16}{run:>7} of {lines:>6} lines  {100 * run / lines:5.1f} %")


def print_errors_not_met(counts, root):
    print("\nlines that raise errors and never ran:")
    for file, lines in sorted(counts.items()):
        text = file.read_text().splitlines()
        for line, times in sorted(lines.items()):
            if times == 0 and ERROR.search(text[line - 1]):
                print(f"  {file.relative_to(root.parent)}:{line}: {text[line - 1].strip()}")


def main():
    root = pathlib.Path(sys.argv[2]).resolve()
    counts = {file: lines for file, lines in lines_run(pathlib.Path(sys.argv[1])).items() if root in file.parents}
    print_shares(counts, root)
    print_errors_not_met(counts, root)


if __name__ == "__main__":
    main()
