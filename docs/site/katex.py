"""Formulas become HTML and MathML when the site is built, by Debian's KaTeX in Node.js; a reader's browser runs nothing."""
import json
import pathlib
import shutil
import subprocess

from docutils.nodes import SkipNode
from sphinx.errors import ExtensionError

KATEX = pathlib.Path("/usr/share/javascript/katex")
RENDERER = pathlib.Path(__file__).with_name("katex.js")


class Katex:
    """One process for all formulas: a line of JSON in, a line of JSON out."""

    def __init__(self):
        self.process = None

    def html(self, tex, display):
        if self.process is None:
            self.process = subprocess.Popen(["node", RENDERER, KATEX / "katex.js"], stdin=subprocess.PIPE,
                                            stdout=subprocess.PIPE, text=True, encoding="utf-8")
        self.process.stdin.write(json.dumps({"tex": tex, "display": display}) + "\n")
        self.process.stdin.flush()
        answer = json.loads(self.process.stdout.readline())
        if "error" in answer:
            raise ExtensionError(f"{answer['error']}\nin the formula {tex}")
        return answer["html"]

    def close(self, *_):
        if self.process:
            self.process.stdin.close()
            self.process.wait()


katex = Katex()


def visit_inline(self, node):
    self.body.append(katex.html(node.astext(), False))
    raise SkipNode


def visit_block(self, node):
    self.body.append(f'<div class="formula">{katex.html(node.astext(), True)}</div>')
    raise SkipNode


def copy_fonts(app, error):
    if error is None:
        target = pathlib.Path(app.outdir) / "_static" / "katex"
        target.mkdir(parents=True, exist_ok=True)
        shutil.copy(KATEX / "katex.min.css", target)
        shutil.copytree(KATEX / "fonts", target / "fonts", dirs_exist_ok=True)


def setup(app):
    app.add_html_math_renderer("katex", (visit_inline, None), (visit_block, None))
    app.config.html_math_renderer = "katex"
    app.add_css_file("katex/katex.min.css")
    app.connect("build-finished", copy_fonts)
    app.connect("build-finished", katex.close)
    return {"parallel_read_safe": True}
