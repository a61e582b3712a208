"""The documentation as a site: `python -m report.site`, which is `make docs`."""
