"""Links between the documents also work on a code host: the files and the headings that they name exist."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"\]\(([^()\s]+)\)|src=\"([^\"]+)\"")
CODE = re.compile(r"^(`{3,}).*?^\1|`[^`\n]*`", re.MULTILINE | re.DOTALL)
HEADING = re.compile(r"^#+ +(.*)", re.MULTILINE)


def anchors(path):
    """Places of a document as code hosts name them: "A study, yours" is a-study-yours."""
    words = (re.sub(r"[^\w\- ]", "", heading.lower()) for heading in HEADING.findall(path.read_text(encoding="utf-8")))
    return {heading.strip().replace(" ", "-") for heading in words}


def is_broken(document, link):
    path, _, place = link.partition("#")
    target = (document.parent / path).resolve() if path else document
    return not target.exists() or (place and place not in anchors(target))


class Links(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for document in [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]:
            text = CODE.sub("", document.read_text(encoding="utf-8"))
            links = [first or second for first, second in LINK.findall(text)]
            inside = [link for link in links if not link.startswith(("http:", "https:"))]
            with self.subTest(document.relative_to(ROOT)):
                self.assertEqual([link for link in inside if is_broken(document, link)], [])


if __name__ == "__main__":
    unittest.main()
