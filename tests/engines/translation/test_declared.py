"""What translations say of themselves, held against what they do."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import pytest

from engines.translation.translation import Spring, Stepping, Translation, translations
from tests.reference.systems import label

DT = 0.01


@pytest.mark.parametrize("translation", translations().values(), ids=label)
@pytest.mark.parametrize("what", ["substeps", "iterations"])
def test_who_has_them_is_another_scheme_with_more(
    translation: Translation, what: Literal["substeps", "iterations"]
) -> None:
    """Sub-steps and iterations that can be set stand in the scheme's parameters; those that cannot, do not."""
    as_it_is = translation.scheme(Stepping(DT))
    with_more = translation.scheme(Stepping(DT, substeps=37) if what == "substeps" else Stepping(DT, iterations=37))
    assert (with_more != as_it_is) == getattr(translation, what)
    assert ("37" in with_more) == getattr(translation, what)


@pytest.mark.parametrize("translation", translations().values(), ids=label)
def test_what_is_typed_for_a_spring_means_that_spring(translation: Translation) -> None:
    """Back and forth, between unequal masses: k and c again, to rounding; c is none where no damping can be typed."""
    spring, stepping = Spring(90.0, 0.7, mass=0.5, other=2.0), Stepping(DT)
    typed = translation.settings(spring, stepping)
    has_damping = typed != translation.settings(replace(spring, damping=0.0), stepping)
    meant = translation.meaning(translation.typed(typed), replace(spring, stiffness=1.0, damping=0.0), stepping)
    assert meant.stiffness == pytest.approx(90.0, rel=1e-12)
    assert meant.damping == pytest.approx(0.7 if has_damping else 0.0, rel=1e-12)
