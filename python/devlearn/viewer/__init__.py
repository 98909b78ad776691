"""To look at what was run: pages that play a record, and films."""

from .page import page, write_page

__all__ = ["page", "write_page"]
