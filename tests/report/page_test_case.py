"""Shared by the tests of the page: writes pages, opens them in a browser and reads what they draw."""

import atexit
import functools
import os
import pathlib
import shutil
import tempfile
import time

import numpy as np
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By

import browser
from command_test_case import CommandTest
from program import SCENES

SCREENSHOTS = pathlib.Path(os.environ["EIGENTRAIL_SCREENSHOTS"])
# Points of the lines of one mode in the upper or lower half of the Campbell diagram.
LINES = """
const [mode, axis] = arguments;
return document.querySelector('.campbell').data.filter((trace) => trace.meta && trace.meta.mode === mode && trace.yaxis === axis)
  .flatMap((trace) => trace.x.map((x, i) => [x, trace.y[i]])).filter(([x]) => x !== null);
"""
# Where [x, y] of the Campbell diagram is, from the middle of its element.
PIXEL = """
const [x, y] = arguments, figure = document.querySelector('.campbell'), box = figure.getBoundingClientRect();
const [px, py] = toPixels(figure, 'xaxis', 'yaxis', x, y);
return [px - Math.floor(box.width / 2), py - Math.floor(box.height / 2)];
"""

# Tables that are wider than their place.
CUT = """
return [...document.querySelectorAll('.scroll')].filter((node) => node.scrollWidth > node.clientWidth + 1).map((node) => node.getAttribute('aria-label'));
"""


@functools.cache
def the_browser():
    """One for all tests, and the folder of the page that it shows: at one address it compiles the scripts of all pages once."""
    driver, folder = browser.start(), tempfile.TemporaryDirectory(prefix="eigentrail-")
    atexit.register(driver.quit)
    return driver, folder


class PageTest(CommandTest):
    left = None  # the loci file of the page that is open, if tests have left this as they found it

    @classmethod
    def setUpClass(cls):
        cls.driver, folder = the_browser()
        cls.shown = pathlib.Path(folder.name)

    def show(self, *files, **details):
        """Writes the page of some files and opens it."""
        self.run_well("report", *files, "-o", "page.html", "--force", "--quiet")
        self.open_page(**details)

    def open_page(self, size=browser.DESKTOP, picture=None):
        """Opens the page, which asks for nothing, and looks for messages in the console."""
        PageTest.left = None
        shutil.copy(self.folder / "page.html", self.shown)
        browser.show(self.driver, self.shown / "page.html", size)
        if picture:
            time.sleep(0.3)  # for what is drawn once the layout has settled
            browser.screenshot(self.driver, SCREENSHOTS / f"{picture}.png")
        self.assertEqual(browser.messages(self.driver), [])
        self.assertEqual(self.driver.execute_script("return performance.getEntriesByType('resource').map((entry) => entry.name)"), [])

    def blade(self):
        self.trace((SCENES / "rotating_mass.toml").read_text(encoding="utf-8"))
        self.show("loci.h5")

    def same_blade(self):
        """The page of the blade for a test that leaves it as it is, or can do with what it is after such a test."""
        if not PageTest.left:
            self.blade()
            PageTest.left = (self.folder / "loci.h5").read_bytes()
        (self.folder / "loci.h5").write_bytes(PageTest.left)

    def lines(self, mode, axis="y"):
        return np.array(self.driver.execute_script(LINES, mode, axis))

    def isolated(self):
        """Modes that are drawn in colour."""
        return sorted({mode for mode in range(2) if len(self.lines(mode))})

    def pointer_to(self, x, y):
        figure = self.driver.find_element(By.CSS_SELECTOR, ".campbell")
        self.driver.execute_script("arguments[0].scrollIntoView({ block: 'start' })", figure)
        dx, dy = self.driver.execute_script(PIXEL, x, y)
        return ActionChains(self.driver).move_to_element_with_offset(figure, round(dx), round(dy))
