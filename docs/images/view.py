"""Takes the picture of docs/viewing.md.

python docs/images/view.py
"""

import io
import tempfile
from pathlib import Path

import devlearn
from devlearn.viewer import write_page
from PIL import Image
from playwright.sync_api import sync_playwright

trial = devlearn.Trial(devlearn.World.load("paper"), seed=3)
phases = [trial.free_learning(10_000), trial.free_learning(10_000), trial.path_learning(300)]
with tempfile.TemporaryDirectory() as folder, sync_playwright() as driver:
    path = Path(folder) / "page.html"
    write_page(path, devlearn.Record.concatenate(phases))
    browser = driver.chromium.launch(executable_path="/usr/bin/chromium", args=["--no-sandbox"])
    page = browser.new_page(viewport={"width": 1280, "height": 860})
    page.goto(path.as_uri())
    page.wait_for_selector("html[data-ready]", state="attached")
    page.evaluate("devlearn.goTo(75_100)")
    picture = Image.open(io.BytesIO(page.screenshot()))
    picture = picture.convert("RGB").quantize(256, kmeans=3)
    picture.save(Path(__file__).with_name("view.png"), optimize=True)
    browser.close()
