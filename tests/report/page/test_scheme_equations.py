"""The equations on the page: of the textbook's schemes, and of all that an engine was identified as."""

from __future__ import annotations

import pytest

from reference.schemes.catalogue import schemes
from report.figures.overview import Explained
from report.page import scheme_equations as shown_equations
from report.page.scheme_equations import scheme_equations
from report.site.linear_form import NotLinear


def test_schemes_of_engines_are_there_where_an_engine_is(monkeypatch: pytest.MonkeyPatch) -> None:
    """With all that are identified as it; what is no set of sums is left out."""
    textbook = [name for name, scheme in schemes().items() if scheme.kind == "scheme"]
    own, other = [name for name, scheme in schemes().items() if scheme.kind == "engine_scheme"][:2]

    def equations_of(scheme: object) -> object:
        if scheme is schemes()["rk4"]:
            raise NotLinear("no sums")
        return scheme

    monkeypatch.setattr(shown_equations, "equations_of", equations_of)
    monkeypatch.setattr(shown_equations, "of_equations", lambda scheme: f"<math>{scheme.name}</math>")
    engines = [Explained("a", own, 1.0, 1e-15), Explained("b", "heun", 1.0, 1e-15), Explained("c", own, 1.0, 1e-15)]
    shown = {one.name: one for one in scheme_equations([*engines, Explained("d", None, 1.0, 1.0)])}
    assert {*shown} == {*textbook, own} - {"rk4"}
    assert other not in shown
    assert (shown[own].engines, shown["heun"].engines, shown["euler"].engines) == (["a", "c"], ["b"], [])
    heun = schemes()["heun"]
    assert (shown["heun"].summary, shown["heun"].order) == (heun.summary, heun.order)
    assert shown["heun"].equations == "<math>heun</math>"
