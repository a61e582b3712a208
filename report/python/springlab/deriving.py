"""What a stepper computes, derived from the outside."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

from springlab.plot import Plot
from springlab.steppers import AnyStepper, stepper_of

if TYPE_CHECKING:
    from reference.derivation.explanation import Explanation
    from reference.stepper import Stepper


@dataclass(frozen=True)
class Explained:
    """What was derived of a stepper, name or no name."""

    _found: Explanation
    _stepper: Stepper

    @property
    def stepper(self) -> str:
        """Its name."""
        return self._found.stepper

    @property
    def identified_as(self) -> str | None:
        """The scheme that reproduces it on a string; None where there is none."""
        return self._found.identification.identified_as

    @property
    def order(self) -> int | None:
        """Of accuracy; None where it cannot be told."""
        return self._found.order

    @property
    def explicit(self) -> bool | None:
        """Whether a step is had without solving equations; None where it cannot be told."""
        return self._found.explicit

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why something cannot be told."""
        return self._found.reasons

    @property
    def forces_taken(self) -> tuple[dict[str, str], ...]:
        """Where a stepper that only steps takes forces of springs: c, b and beta of each (`str` has them as formulas).

        F is taken `at` c h v, and is in v' with h b F/m (`in_velocity`), in x' with h^2 beta F/m (`in_position`).
        """
        return tuple(force.text() for force in self._found.seen.taken)

    @property
    def multistep(self) -> dict[str, list[str]] | None:
        """Of one that solves equations: alpha of y0, y-1, ..., beta of h f(y1), h f(y0), ...; None of others."""
        found = self._found.seen.multistep
        return found.text() if found else None

    @property
    def document(self) -> dict[str, Any]:
        """As `springlab explain --json` prints it: matrix, formulas, tableau, and what follows."""
        return self._found.document

    def plot(self) -> Plot:
        """Its stability region, with measured points."""
        from report.figures.explain import draw

        return Plot(draw(self._found, self._stepper))

    def __str__(self) -> str:
        from report.derived import name_line, sections

        parts = [f"{title}\n" + "\n".join(lines) for title, lines in sections(self._found)]
        return "\n\n".join([f"{name_line(self._found)}.", *parts])

    def _repr_html_(self) -> str:
        return f"<pre>{escape(str(self))}</pre>"


def explain(stepper: AnyStepper) -> Explained:
    """Derive, from the outside only, what a stepper computes in a step, and what follows from it.

    >>> import springlab as lab
    >>> found = lab.explain("heun")
    >>> found.order, found.explicit
    (2, True)

    Args:
        stepper: the name of a scheme or engine, or a file or function of your own.

    Raises:
        InputError: for an unknown name, or a file that cannot be used.
    """
    from reference.derivation import explanation

    found = stepper_of(stepper)
    return Explained(explanation.explain(found, lambda _: None), found)
