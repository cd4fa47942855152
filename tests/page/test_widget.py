"""The page as a widget of a notebook, in JupyterLab and a real Chromium: both ways."""

import json
import os
import shutil
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import irbkin
import numpy as np
import pytest

playwright = pytest.importorskip("playwright.sync_api")
pytest.importorskip("jupyterlab")
pytest.importorskip("anywidget")

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
PORT = 18899
ADDRESS = f"http://127.0.0.1:{PORT}"
CELLS = (
    "import irbkin, numpy as np, json\n"
    'robot = irbkin.Robot("IRB 2600-12/1.65")\n'
    "view = irbkin.scene.of(robot, q=[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]).view()\n"
    "view",
    "view.q = [0.3, 0.1, 0.2, 0.1, 0.7, 0.0]",
    'json.dump({"q": view.q, "T": view.T.tolist()}, open("seen.json", "w"))',
)


def notebook():
    empty = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    cells = [{**empty, "source": text} for text in CELLS]
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3"}}
    return {"cells": cells, "metadata": kernel, "nbformat": 4, "nbformat_minor": 4}


@pytest.fixture
def lab(tmp_path):
    """JupyterLab in a folder with the notebook."""
    (tmp_path / "view.ipynb").write_text(json.dumps(notebook()))
    options = [f"--port={PORT}", "--no-browser", "--IdentityProvider.token=", "--allow-root"]
    command = [sys.executable, "-m", "jupyterlab", *options, "--ServerApp.disable_check_xsrf=True"]
    environment = {**os.environ, "HOME": str(tmp_path), "JUPYTER_CONFIG_DIR": str(tmp_path / "c")}
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    server = subprocess.Popen(command, cwd=tmp_path, env=environment, **quiet)
    for _ in range(120):
        try:
            urllib.request.urlopen(f"{ADDRESS}/api").close()
            break
        except OSError:
            time.sleep(0.5)
    yield tmp_path
    server.terminate()
    server.wait()


@pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium")
def test_the_widget_and_python_move_the_same_joints(lab):
    robot = irbkin.Robot("IRB 2600-12/1.65")
    with playwright.sync_playwright() as started:
        arguments = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        browser = started.chromium.launch(executable_path=CHROMIUM, args=arguments)
        page = browser.new_page(viewport={"width": 1400, "height": 1000})
        page.goto(f"{ADDRESS}/lab/tree/view.ipynb")
        page.wait_for_selector(".jp-Notebook .jp-Cell", timeout=60_000)
        # Until its kernel is there, the notebook asks which one.
        page.get_by_text("| Idle").wait_for(timeout=60_000)
        page.locator(".jp-Notebook .jp-Cell").first.click()
        page.keyboard.press("Shift+Enter")
        page.wait_for_selector("[data-ready] canvas", timeout=60_000)
        joint = page.locator('.joint input[aria-label="J1"]').first
        assert float(joint.input_value()) == pytest.approx(np.degrees(0.1), abs=1e-3)
        page.keyboard.press("Shift+Enter")
        page.wait_for_function(
            "() => Math.abs(document.querySelector('.joint input').value - 17.189) < 0.01"
        )
        field = page.get_by_label("z", exact=True).first
        height = float(field.input_value())
        field.fill(f"{height - 50:.2f}")
        page.wait_for_timeout(500)
        page.locator(".jp-Notebook .jp-Cell").nth(2).click()
        page.keyboard.press("Shift+Enter")
        for _ in range(50):
            if (lab / "seen.json").exists():
                break
            page.wait_for_timeout(100)
        page.screenshot(path=lab / "notebook.png")
        browser.close()
    seen = json.loads((lab / "seen.json").read_text())
    T = np.array(seen["T"])
    assert T[2, 3] == pytest.approx((height - 50) / 1e3, abs=1e-5)
    np.testing.assert_allclose(robot.fk(seen["q"]), T, atol=1e-9)
    assert Path(lab / "notebook.png").stat().st_size > 10_000
