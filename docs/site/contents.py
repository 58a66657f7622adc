"""The order of the pages. Pages that are not named here are listed at the end, so that none is lost."""
import pathlib
import re

CONTENTS = {
    "Start": ["install", "first-trace", "commands", "glossary"],
    "Describe a system": ["scene", "rotor", "scene-tables", "scenes/README"],
    "Models of other programs": ["bring-your-own-matrices", "large-models", "sampled-families", "state-space", "openfast",
                                 "coming-from-ross", "coming-from-matlab"],
    "Read the results": ["events", "boundaries", "stability-map", "many-machines", "report", "plots"],
    "Use the numbers": ["loci-file", "python", "notebooks/*", "cpp"],
    "Trust them": ["how-it-works", "accuracy", "reliability"],
    "For developers": ["developers/README"],
}
ROOT = "index"
# Pages of these folders are listed by the folder's own page, in the order of its links.
FOLDERS = {"scenes/README": "scenes/", "developers/README": "developers/"}


def pages_of(patterns, known):
    """Pages that exist, in the order of the patterns."""
    return [page for pattern in patterns for page in sorted(known) if pathlib.PurePath("/", page).match(f"/{pattern}")]


def toctree(pages, caption=""):
    lines = ["", "```{toctree}", ":hidden:"] + ([f":caption: {caption}"] if caption else []) + ["", *pages, "```", ""]
    return "\n".join(lines)


def contents(known):
    within = {page for page in known if page.startswith(tuple(FOLDERS.values()))} - set(FOLDERS)
    left = set(known) - within - {ROOT}
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
    elif page in FOLDERS:
        named = re.findall(r"\]\(([\w-]+)\.md\)", source[0])
        source[0] += toctree(dict.fromkeys(name for name in named if FOLDERS[page] + name in known))


def leave_out_headings(app, page, template, context, tree):
    """The start page has no headings to list beside it."""
    context["furo_hide_toc"] = context.get("furo_hide_toc", False) or page == ROOT


def setup(app):
    app.connect("source-read", add_contents)
    app.connect("html-page-context", leave_out_headings, priority=900)
    return {"parallel_read_safe": True}
