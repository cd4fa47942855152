"""Pictures of the page, with a Chromium; `make page` and `make test-page` install what it needs.

docs/guide/view.md shows `page.png`; the film of a drag is target/page/drag.gif.
"""

import io
import shutil
import sys
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
MADE = ROOT / "target" / "page"
PAGE = MADE / "irbkin.html"
ARGUMENTS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
COLORS = 200
"""Colors of a picture: flat surfaces need few."""


def small(shot: bytes) -> Image.Image:
    """Return a screenshot with few colors."""
    return Image.open(io.BytesIO(shot)).convert("RGB").quantize(COLORS, dither=Image.Dither.NONE)


def main() -> None:
    """Write the pictures."""
    chromium = shutil.which("chromium")
    if chromium is None or not PAGE.exists():
        sys.exit("this needs a Chromium, and `make page` before")
    with sync_playwright() as started:
        browser = started.chromium.launch(executable_path=chromium, args=ARGUMENTS)
        page = browser.new_page(viewport={"width": 1280, "height": 760})
        page.goto(f"file://{PAGE}")
        page.wait_for_selector("html[data-ready]")
        page.set_input_files("input[type=file]", ROOT / "examples" / "pick_and_place.mod")
        page.wait_for_selector(".program tbody tr")
        page.locator(".program tbody tr").nth(4).click()
        page.evaluate("() => irbkin.view.fit()")
        page.wait_for_timeout(500)
        small(page.screenshot()).save(HERE / "page.png", optimize=True)
        film(page)
        browser.close()


def film(page) -> None:
    """Drag the tool around, and write a film of it."""
    page.reload()
    page.wait_for_selector("html[data-ready]")
    x, y, _ = page.evaluate("() => irbkin.view.camera.project(place(irbkin.state.T))")
    page.mouse.move(x, y)
    page.mouse.down()
    frames = []
    for step in range(60):
        part = step / 59
        page.mouse.move(x - 160 * part, y - 130 * (1 - (2 * part - 1) ** 2))
        page.wait_for_timeout(30)
        frames.append(small(page.screenshot()).resize((640, 380)))
    page.mouse.up()
    each = {"save_all": True, "append_images": frames[1:], "duration": 160, "loop": 0}
    frames[0].save(MADE / "drag.gif", **each)


if __name__ == "__main__":
    main()
