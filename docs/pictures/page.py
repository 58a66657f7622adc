"""Draws a picture of a report page: python3 docs/pictures/page.py PAGE.html PICTURE.png [LAST]

The page is 1400 px wide in headless Chromium, the picture 1000 px. LAST is the heading before which the picture ends. docs/report.png is the page of
data/scenes/two_disc_rotor.toml with `operating_range = [3000, 4000]`, up to "Events"; lamp_report.png the one of docs/first-trace.md, whole tables.
"""
import io
import pathlib
import sys

from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "report"))

import browser

WIDTH = 1000
TOP = "const heads = [...document.querySelectorAll('h2, h3')].filter((h) => h.textContent === arguments[0]); return heads.length ? heads[0].getBoundingClientRect().top : null"


def main():
    page, picture = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    driver = browser.start()
    browser.show(driver, page)
    browser.screenshot(driver, picture)
    end = driver.execute_script(TOP, sys.argv[3]) if len(sys.argv) > 3 else None
    driver.quit()
    image = Image.open(io.BytesIO(picture.read_bytes())).convert("RGB")
    image = image.crop((0, 0, image.width, round(end) - 12 if end else image.height))
    image = image.resize((WIDTH, round(image.height * WIDTH / image.width)), Image.LANCZOS)
    image.quantize(256, method=Image.Quantize.MAXCOVERAGE, kmeans=2, dither=Image.Dither.NONE).save(picture, optimize=True)


if __name__ == "__main__":
    main()
