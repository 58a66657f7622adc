"""The site builds without a warning, needs no network, and works in a browser: links, formulas, phones, light and dark."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest
from html.parser import HTMLParser
from urllib.parse import unquote, urljoin, urlsplit

import browser

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCREENSHOTS = pathlib.Path(os.environ["EIGENTRAIL_SCREENSHOTS"])
PICTURED = ["index.html", "first-trace.html", "how-it-works.html", "scenes/README.html", "scene.html", "cpp.html",
            "developers/method.html", "api/index.html"]
LOADED = "return performance.getEntriesByType('resource').map((entry) => entry.name)"
BACKGROUND = "return getComputedStyle(document.body).backgroundColor"
OVERHANG = "return document.documentElement.scrollWidth - document.documentElement.clientWidth"
REQUESTS = ("src", "srcset", "data", "poster")
DOXYGENS_OWN = "#nested-classes"  # it links to a list of private classes that it does not show


class Page(HTMLParser):
    """What a page links to, what it loads, and the places in it that links may name."""

    def __init__(self, path):
        super().__init__()
        self.links, self.loads, self.places = [], [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = {key: value or "" for key, value in attributes}
        self.places |= {given[key] for key in ("id", "name") if key in given}
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        elif tag == "link":
            self.loads.append(given["href"])
        self.loads += [given[key] for key in REQUESTS if key in given]


def is_outside(address):
    return address.startswith(("http:", "https:", "//"))


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="eigentrail-site-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name).resolve()
        cls.build = subprocess.run([ROOT / "docs" / "site" / "build", cls.folder], capture_output=True, text=True, check=False)
        cls.pages = {path: Page(path) for path in cls.folder.rglob("*.html")}
        cls.driver = browser.start()
        cls.addClassCleanup(cls.driver.quit)

    def name(self, path):
        return str(path.relative_to(self.folder))

    def guide(self):
        return sorted(path for path in self.pages if "api" not in path.relative_to(self.folder).parts)

    def open(self, path, size=browser.DESKTOP):
        browser.resize(self.driver, size)
        self.driver.get(path.as_uri())

    def prefer(self, scheme):
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def test_it_is_built_without_a_word(self):
        self.assertEqual((self.build.returncode, self.build.stdout + self.build.stderr), (0, ""))

    def test_every_document_is_a_page(self):
        documents = [path.relative_to(ROOT / "docs") for path in (ROOT / "docs").rglob("*.md")]
        for document in documents:
            if document.parts[0] != "site":
                self.assertIn(self.folder / document.with_suffix(".html"), self.pages)

    def test_links_lead_somewhere(self):
        broken = []
        for path, page in self.pages.items():
            for link in page.links:
                address = urlsplit(urljoin(path.as_uri(), link))
                target = pathlib.Path(unquote(address.path))
                if address.scheme != "file" or link.startswith("javascript:"):
                    continue
                place = unquote(address.fragment)
                missing = place and target in self.pages and place not in self.pages[target].places
                if link != DOXYGENS_OWN and (missing or not target.is_file()):
                    broken.append((self.name(path), link))
        self.assertEqual(broken, [])

    def test_nothing_is_loaded_from_elsewhere(self):
        outside = [(self.name(path), address) for path, page in self.pages.items() for address in page.loads if is_outside(address)]
        for path in self.folder.rglob("*.css"):
            addresses = re.findall(r"""(?:url\(|@import\s+)["']?([^"')\s]+)""", path.read_text(encoding="utf-8"))
            outside += [(self.name(path), address) for address in addresses if is_outside(address)]
        self.assertEqual(outside, [])

    def test_pages_load_what_they_need_and_fit_a_phone(self):
        for path in [*self.guide(), self.folder / "api" / "index.html", self.folder / "api" / "trace_8hpp.html"]:
            with self.subTest(self.name(path)):
                self.open(path, browser.PHONE)
                self.assertEqual(browser.messages(self.driver), [])
                self.assertEqual([name for name in self.driver.execute_script(LOADED) if not name.startswith(("file:", "data:"))], [])
                self.assertEqual(self.driver.execute_script(OVERHANG), 0)

    def test_dark_is_dark(self):
        for page in ("index.html", "api/index.html"):
            backgrounds = []
            for scheme in ("light", "dark"):
                self.prefer(scheme)
                self.open(self.folder / page)
                backgrounds.append(self.driver.execute_script(BACKGROUND))
            self.assertEqual(backgrounds, ["rgb(255, 255, 255)", "rgb(19, 20, 22)"], page)
        self.prefer("light")

    def test_formulas_are_set(self):
        self.open(self.folder / "developers" / "method.html")
        self.assertGreater(self.driver.execute_script("return document.querySelectorAll('.formula .katex').length"), 5)
        self.assertNotIn("$$", self.driver.execute_script("return document.body.innerText"))
        self.assertTrue(self.driver.execute_script("return document.fonts.check('16px KaTeX_Main')"))

    def test_search_finds_a_page(self):
        self.open(self.folder / "search.html")
        self.driver.get((self.folder / "search.html").as_uri() + "?q=flutter")
        found = "return document.querySelectorAll('#search-results li a').length"
        browser.WebDriverWait(self.driver, browser.TIMEOUT).until(lambda driver: driver.execute_script(found) > 3)

    def test_pictures_of_the_main_pages(self):
        for scheme, size in (("light", browser.DESKTOP), ("dark", browser.PHONE)):
            self.prefer(scheme)
            for page in PICTURED:
                self.open(self.folder / page, size)
                browser.screenshot(self.driver, SCREENSHOTS / f"{page.replace('/', '_').removesuffix('.html')}_{scheme}.png")
        self.prefer("light")


if __name__ == "__main__":
    unittest.main()
