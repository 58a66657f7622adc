"""The guide: Sphinx over the Markdown of docs/, for `docs/site/build`.

The pages are written for a code host and know nothing of Sphinx: what only the site needs is in this folder.
"""
import pathlib
import re
import sys

SITE = pathlib.Path(__file__).resolve().parent
DOCS = SITE.parent
ROOT = DOCS.parent
sys.path.insert(0, str(SITE))

project = "eigentrail"
version = re.search(r"VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)
release = version

extensions = ["myst_parser", "contents", "debian_furo", "katex", "listings", "notebooks"]
source_suffix = {".md": "markdown"}
root_doc = "index"
exclude_patterns = ["site"]
myst_enable_extensions = ["dollarmath", "html_image"]
myst_heading_anchors = 4

html_theme = "furo"
html_title = "eigentrail"
html_static_path = ["static"]
html_css_files = ["guide.css"]
html_copy_source = False
html_show_sphinx = False
templates_path = ["templates"]
html_sidebars = {"**": ["sidebar/brand.html", "sidebar/search.html", "sidebar/scroll-start.html", "sidebar/navigation.html",
                        "api_link.html", "sidebar/scroll-end.html"]}
pygments_style = "friendly"
pygments_dark_style = "native"
highlight_language = "none"
html_show_copyright = False
