"""The processes that sections are made in, and what they begin with. Little is imported here."""

from __future__ import annotations

from engines.process.worker import FOR_SCHEMES, import_beforehand, start_beforehand

#: What every experiment's process computes and draws with.
MADE_WITH = (FOR_SCHEMES, "matplotlib.figure", "matplotlib.backends.backend_svg", "report.page.sections")


def prepare_processes(at_once: bool = False) -> None:
    """Let them begin with what all sections need, once one is asked for; or have it imported at once, beside us."""
    import_beforehand(*MADE_WITH)
    if at_once:
        start_beforehand()
