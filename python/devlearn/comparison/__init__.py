"""Agents side by side, as one page: ``devlearn compare``."""
