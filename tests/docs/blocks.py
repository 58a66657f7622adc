"""Code blocks of a Markdown document, with the instructions for testing them in the comments before them.

A comment `<!-- test: ... -->` before a block says

    not run: REASON               a command that takes long, or needs a build
    output not compared: REASON   what is printed differs from run to run
    exit code N                   of its commands
    with SOURCE as NAME           a file of the repository that the commands find under a name
    as NAME                       a scene is kept under this name for what follows
    completed by TEXT or FILE     what makes a full scene of an excerpt
    replaces [TABLE] in FILE      likewise: the excerpt stands for a table of another scene
    from FILE                     an excerpt of a file of the repository
"""
import dataclasses
import re

COMMANDS = ("eigentrail ", "build/release/", "./bootstrap", "cmake ", "ctest ", "python3 ", "export ", "OPENBLAS_NUM_THREADS=")
NOTES = ("not run", "output not compared", "exit code", "with", "as", "completed by", "replaces", "from")
FENCE = re.compile(r"(`{3,})\s*(\w*)\s*$")
NOTE = re.compile(r"<!-- test: (.*?)\s*-->", re.DOTALL)


@dataclasses.dataclass
class Block:
    line: int  # where it begins, from 1
    language: str
    text: str
    notes: dict = dataclasses.field(default_factory=dict)
    follows: bool = False  # directly behind another block, without a word between


def is_command(line):
    return line.startswith(COMMANDS)


def note(text):
    """A key and its value: "exit code" and "1"."""
    key = next((key for key in NOTES if text.startswith(key)), None)
    if key is None:
        raise ValueError(f"unknown comment '<!-- test: {text} -->'")
    return key, text[len(key):].removeprefix(":").strip()


def fenced(lines, i):
    """The block that begins with a fence at line i, and the line behind it."""
    mark, language = FENCE.match(lines[i]).groups()
    end = next(j for j in range(i + 1, len(lines)) if lines[j].startswith(mark))
    return Block(i + 1, language or "text", "\n".join(lines[i + 1:end])), end + 1


def indented(lines, i):
    end = next((j for j in range(i, len(lines)) if lines[j].strip() and not lines[j].startswith("    ")), len(lines))
    text = "\n".join(line[4:] for line in lines[i:end]).rstrip()
    return Block(i + 1, "sh" if is_command(text) else "text", text), end


def comment(lines, i):
    """The comment that begins at line i, and the line behind it."""
    end = next(j for j in range(i, len(lines)) if "-->" in lines[j]) + 1
    return "\n".join(lines[i:end]), end


def blocks(text):
    found, lines, notes, follows, i = [], text.split("\n"), {}, False, 0
    while i < len(lines):
        before_is_empty = i == 0 or not lines[i - 1].strip()
        if lines[i].startswith("<!--"):
            words, i = comment(lines, i)
            notes |= dict(note(match.group(1)) for match in [NOTE.match(words)] if match)
        elif FENCE.match(lines[i]) or (before_is_empty and lines[i].startswith("    ")):
            block, i = (fenced if FENCE.match(lines[i]) else indented)(lines, i)
            block.notes, notes = notes, {}
            block.follows, follows = follows, True
            found.append(block)
        else:
            if lines[i].strip() and notes:
                raise ValueError(f"line {i + 1}: the comment about a test is followed by no block")
            follows = follows and not lines[i].strip()
            i += 1
    if notes:
        raise ValueError("the last comment about a test is followed by no block")
    return found


def commands(text):
    """The commands of a block, each with the lines that it prints according to the document."""
    found = []
    for line in text.split("\n"):
        if is_command(line) or (line.strip() and not found):
            found.append((line, []))
        elif line.strip():
            found[-1][1].append(line)
    return found
