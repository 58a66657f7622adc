"""A link to an example that stands alone on its line is followed by the example itself."""
import re

ALONE = re.compile(r"^\[[^\]]+\]\((examples/[^)]+)\)$", re.MULTILINE)


def show_examples(app, page, source):
    source[0] = ALONE.sub(lambda link: f"{link.group()}\n\n```{{literalinclude}} {link.group(1)}\n:language: cpp\n```", source[0])


def setup(app):
    app.connect("source-read", show_examples)
    return {"parallel_read_safe": True}
