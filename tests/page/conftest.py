"""A real Chromium, and pages in it."""

import shutil

import pytest

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
WIDE = {"width": 1280, "height": 900}


@pytest.fixture(scope="module")
def browser():
    playwright = pytest.importorskip("playwright.sync_api")
    if CHROMIUM is None:
        pytest.skip("there is no Chromium")
    with playwright.sync_playwright() as started:
        arguments = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        browser = started.chromium.launch(executable_path=CHROMIUM, args=arguments)
        yield browser
        browser.close()


@pytest.fixture
def opened(browser):
    """Open an address; no error may be on the console in the end, but what `passes`."""
    errors, contexts = [], []

    def open_page(address, viewport=WIDE, scheme="light", script="", passes=None):
        def hear(text):
            if passes is None or passes not in text:
                errors.append(text)

        context = browser.new_context(viewport=viewport, color_scheme=scheme)
        contexts.append(context)
        page = context.new_page()
        page.add_init_script(script)
        page.on("console", lambda it: hear(it.text) if it.type == "error" else None)
        page.on("pageerror", lambda it: hear(str(it)))
        page.goto(address)
        page.wait_for_selector("html[data-ready]")
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert errors == []
