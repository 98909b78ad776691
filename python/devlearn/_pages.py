"""Pages of HTML that need nothing else: their templates, and pictures inside them."""

from __future__ import annotations

import base64
from pathlib import Path

from .errors import MissingExtra

try:
    import jinja2
except ModuleNotFoundError as error:
    raise MissingExtra("a report", "jinja2", "experiments") from error


def environment(folder: Path) -> jinja2.Environment:
    """Where the templates in ``folder`` are rendered: text is escaped, what is missing refused."""
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


def data_uri(picture: bytes) -> str:
    """A picture, the content of a PNG file, as the source of an image."""
    return "data:image/png;base64," + base64.b64encode(picture).decode()
