"""A page in headless Chromium."""

import base64
import contextlib

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait

DESKTOP, PHONE = (1400, 1000), (390, 844)
ARGUMENTS = ("--headless=new", "--no-sandbox", "--disable-gpu", "--in-process-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
             "--force-device-scale-factor=1", "--force-prefers-reduced-motion")
TIMEOUT = 30.0


def start():
    options = Options()
    options.binary_location = "/usr/bin/chromium"
    for argument in ARGUMENTS:
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def resize(driver, size):
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": size[0], "height": size[1], "deviceScaleFactor": 1, "mobile": size == PHONE})


def show(driver, path, size=DESKTOP):
    """
    Opens a page and waits until all figures are drawn. Console messages of earlier pages are discarded, and the page before is
    closed first, so that it is not drawn anew in the new size.
    """
    driver.get("about:blank")
    with contextlib.suppress(Exception):
        driver.get_log("browser")
    resize(driver, size)
    driver.get(path.as_uri())
    WebDriverWait(driver, TIMEOUT, poll_frequency=0.05).until(lambda d: d.execute_script(
        "return window.report && [...document.querySelectorAll('.chart')].every((chart) => chart._fullLayout)"))


def messages(driver):
    return [entry["message"] for entry in driver.get_log("browser")]


def screenshot(driver, path):
    width, height = driver.execute_script("return [document.documentElement.scrollWidth, document.documentElement.scrollHeight]")
    clip = {"x": 0, "y": 0, "width": width, "height": min(height, 6000), "scale": 1}
    image = driver.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True, "clip": clip})
    path.write_bytes(base64.b64decode(image["data"]))
