"""Tests of the live lab: first without a page, then in the browser."""
