"""What tests of pages share: programs that run them, and what is in them."""

import base64
import json
import re
import shutil
import subprocess
import zlib
from pathlib import Path

import devlearn.viewer
import pytest

PARTS = Path(devlearn.viewer.__file__).with_name("parts")
TITLE = re.compile(r"<title>(.*?)</title>", re.DOTALL)


def program(name):
    """The path of a program that scripts/setup --dev installs."""
    path = shutil.which(name)
    if path is None:
        pytest.skip(f"there is no {name}")
    return path


def data_of(page):
    """The packed data in a page, inflated."""
    text = re.search(r'<script id="data" type="text/plain">(.*?)</script>', page)[1]
    return zlib.decompress(base64.b64decode(text), -zlib.MAX_WBITS)


def header_of(page):
    """The header in a page's data."""
    data = data_of(page)
    return json.loads(data[4 : 4 + int.from_bytes(data[:4], "little")])


def in_node(page, script):
    """What a script returns that is run after the page's own, which draw nothing, on its data.

    ``run`` is the page's Run.
    """
    parts = [(PARTS / name).read_text() for name in ("unpack.js", "learner.js", "run.js")]
    driver = f"""
        import {{ readFileSync }} from "node:fs";
        const run = new Run(contentsOf(new Uint8Array(readFileSync(0))));
        const returned = (() => {{ {script} }})();
        process.stdout.write(JSON.stringify(returned));
    """
    node = [program("node"), "--input-type=module", "--eval", "\n".join([*parts, driver])]
    done = subprocess.run(node, input=data_of(page), capture_output=True, timeout=60)
    assert done.returncode == 0, done.stderr.decode()
    return json.loads(done.stdout)
