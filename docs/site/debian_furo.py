"""What Debian 12's package of the Furo theme lacks: a style sheet from beside the pages, one script, and dark by preference."""
import pathlib
import re
import shutil

NORMALIZE = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")
NORMALIZE_IMPORT = "@import url(/javascript/normalize.css/normalize.css);"
SCRIPT_IMPORT = 'import Gumshoe from "./gumshoe-patched.js";'
DARK = re.compile(r'body\[data-theme="dark"\] \{\n(.*?)\}', re.DOTALL)


def edit(path, change):
    path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")


def with_dark_preference(css):
    if "prefers-color-scheme" in css:
        return css
    colours = DARK.search(css).group(1)
    return css + f'@media screen and (prefers-color-scheme: dark) {{\n  body:not([data-theme="light"]) {{\n{colours}}}\n}}\n'


def repair(app, error):
    if error is None:
        static = pathlib.Path(app.outdir) / "_static"
        shutil.copy(NORMALIZE, static / "styles")
        edit(static / "styles" / "furo.css",
             lambda css: with_dark_preference(css.replace(NORMALIZE_IMPORT, "@import url(normalize.css);")))
        # A module cannot be imported by a page that is opened as a file.
        gumshoe = (static / "scripts" / "gumshoe-patched.js").read_text(encoding="utf-8")
        edit(static / "scripts" / "furo.js", lambda script: script.replace(SCRIPT_IMPORT, gumshoe))


def setup(app):
    app.connect("build-finished", repair)
    return {"parallel_read_safe": True}
