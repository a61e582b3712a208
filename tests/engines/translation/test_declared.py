"""What translations say of themselves, held against what they do."""

from __future__ import annotations

from typing import Literal

import pytest

from engines.translation.translation import Stepping, Translation, translations
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
