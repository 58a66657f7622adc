"""The order of the pages. Pages that are not named here are listed at the end, so that none is lost."""
import pathlib
import re

CONTENTS = {
    "Start": ["first-trace", "commands", "scenes/README"],
    "Describe a system": ["scene", "scene-tables"],
    "Ask it": ["events", "boundaries", "stability-map", "report"],
    "Use the results": ["loci-file", "python", "notebooks/*", "cpp"],
    "Trust it": ["how-it-works", "accuracy", "hard_cases", "performance", "reliability"],
    "Extend it": ["adding-an-effect"],
}
ROOT = "index"
GALLERY = "scenes/README"


def pages_of(patterns, known):
    """Pages that exist, in the order of the patterns."""
    return [page for pattern in patterns for page in sorted(known) if pathlib.PurePath(page).match(pattern)]


def toctree(pages, caption=""):
    lines = ["", "```{toctree}", ":hidden:"] + ([f":caption: {caption}"] if caption else []) + ["", *pages, "```", ""]
    return "\n".join(lines)


def contents(known):
    gallery = {page for page in known if page.startswith("scenes/")} - {GALLERY}
    left = set(known) - gallery - {ROOT}
    for caption, patterns in CONTENTS.items():
        pages = pages_of(patterns, left)
        left -= set(pages)
        if pages:
            yield toctree(pages, caption)
    if left:
        yield toctree(sorted(left), "More")


def add_contents(app, page, source):
    known = app.env.found_docs
    if page == ROOT:
        source[0] += "".join(contents(known))
    elif page == GALLERY:
        named = re.findall(r"\]\((\w+)\.md\)", source[0])
        source[0] += toctree(dict.fromkeys(name for name in named if f"scenes/{name}" in known))


def leave_out_headings(app, page, template, context, tree):
    """The start page has no headings to list beside it."""
    context["furo_hide_toc"] = context.get("furo_hide_toc", False) or page == ROOT


def setup(app):
    app.connect("source-read", add_contents)
    app.connect("html-page-context", leave_out_headings, priority=900)
    return {"parallel_read_safe": True}
