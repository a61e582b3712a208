"""The runner of mutants itself, on a project of three functions: what is tested is killed, and what is not survives."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from tests.mutants import near, verdicts
from tests.mutants.__main__ import ROOMS, ROOT, main, sample
from tests.mutants.equivalent import FIELDS, KEPT, entry_of, equivalents, is_meant
from tests.mutants.kinds import KINDS
from tests.mutants.mutations import Mutant, mutants
from tests.mutants.near import Imports, engines_of, judged_here
from tests.mutants.verdicts import Judge

SOURCE = '''"""Springs, from 0 on."""

from __future__ import annotations


def force(stiffness: float, stretch: float = 0.0) -> float:
    """The force [N] < 1."""
    return stiffness * stretch


def steps(duration: float, dt: float) -> int:
    """How many."""
    count = 0
    while count * dt < duration:
        count += 1
    return count
'''

TEST = """from reference.springs import force, steps


def test_force():
    assert force(3.0, 2.0) == 6.0


def test_steps():
    assert steps(0.5, 0.1) == 5
"""

#: The option that cases which take turns are all run with.
CONFTEST = """
def pytest_addoption(parser):
    parser.addoption("--all-cases", action="store_true")
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A room with a source and its mirrored test, and a room with a source that has none."""
    for folder in ("reference", "engines", "tests/reference"):
        (tmp_path / folder).mkdir(parents=True)
    # a package, as the lab's own of this name is one
    (tmp_path / "reference" / "__init__.py").touch()
    (tmp_path / "reference" / "springs.py").write_text(SOURCE)
    (tmp_path / "tests" / "reference" / "test_springs.py").write_text(TEST)
    (tmp_path / "tests" / "conftest.py").write_text(CONFTEST)
    (tmp_path / "engines" / "alone.py").write_text("answer = 6 * 7\n")
    return tmp_path


def made(source: str, file: str = "a.py") -> dict[str, Mutant]:
    """All mutants of a text by what becomes of their lines."""
    return {mutant.after: mutant for mutant in mutants(file, source)}


@pytest.mark.rotating(3)
def test_each_is_killed_or_survives_as_it_deserves(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A wrong product; a count that no test begins elsewhere; a loop without end; and where there is no test."""
    monkeypatch.setattr(verdicts, "TIMES", 1.0)
    monkeypatch.setattr(verdicts, "BESIDES", 1.0)
    springs = made(SOURCE, "reference/springs.py")
    (alone, *_) = mutants("engines/alone.py", "answer = 6 * 7\n")
    expected = {
        springs["return stiffness / stretch"]: "killed",
        springs["while count * dt <= duration:"]: "killed",
        springs["count = 1"]: "survived",
        springs["count -= 1"]: "timed out",
        alone: "not covered",
    }
    told: list[tuple[Mutant, str]] = []
    judge = Judge(project)
    found = judge.verdicts(list(expected), 2, lambda *said: told.append(said))
    assert found == list(expected.values())
    assert dict(told) == expected
    assert judge.failing == {}
    assert (project / "reference" / "springs.py").read_text() == SOURCE


@pytest.mark.rotating(5)
def test_a_test_that_fails_without_any_mutant_judges_nothing(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It is left out, and said; and there being no other, nothing is covered."""
    (project / "tests" / "reference" / "test_springs.py").write_text("def test_nothing():\n    assert 0\n")
    assert main(["--file", "reference/springs.py", "--count", "1"], project) == 1
    said = capsys.readouterr().out
    assert "not covered 1" in said
    assert "test_springs.py fails without any mutant" in said


def test_a_sample_is_the_same_for_a_seed_and_without_equivalents(project: Path) -> None:
    """And without more than there are."""
    everything = sample(project, ROOMS, 1000, 0)
    assert sample(project, ROOMS, 5, 1) == sample(project, ROOMS, 5, 1)
    assert sample(project, ROOMS, 5, 1) != sample(project, ROOMS, 5, 2)
    assert {mutant.file for mutant in sample(project, ["engines"], 1000, 0)} == {"engines/alone.py"}
    (project / KEPT).parent.mkdir(parents=True)
    (project / KEPT).write_text(entry_of(everything[0]) + '\nreason = "none"\n')
    assert [is_meant(entry, mutant) for entry in equivalents(project) for mutant in everything[:2]] == [True, False]
    assert {*sample(project, ROOMS, 1000, 0)} == {*everything[1:]}
    with (project / KEPT).open("a") as file:
        file.write('[[equivalent]]\nfile = "reference/springs.py"\nkind = "comparison"\nreason = "none"\n')
    assert {m.kind for m in sample(project, ["reference"], 1000, 0)} == {"arithmetic", "factor", "whole number"}


@pytest.mark.rotating(3)
def test_a_sample_has_all_kinds_alike() -> None:
    """Whole numbers are as many as all others together, and would be what is looked at."""
    kinds = Counter(mutant.kind for mutant in sample(ROOT, ["reference"], 3 * len(KINDS), 0))
    assert kinds.keys() == KINDS.keys()
    rare = {"unstable sort", "unit", "dropped copy"}
    assert max(kinds.values()) - min(kinds[kind] for kind in KINDS.keys() - rare) <= 1


def test_files_of_engines_that_are_not_installed_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing can be said of them; of a file that is no engine's something always can."""
    assert judged_here("engines/pymunk/springs.py")
    monkeypatch.setattr(near, "version", lambda engine: None)
    assert not judged_here("engines/pymunk/springs.py")
    assert judged_here("reference/forces.py")
    assert not sample(ROOT, ["engines/pymunk"], 1000, 0)
    assert sample(ROOT, ["engines/own"], 1000, 0)


def test_list_shows_the_sample_and_runs_nothing(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Each with its place, its line before and after."""
    assert main(["--list", "--file", "engines/alone.py"], project) == 0
    said = capsys.readouterr().out
    assert said.count("engines/alone.py:1  ") == 5
    assert "    - answer = 6 * 7\n    + answer = 6 / 7\n" in said
    with pytest.raises(SystemExit) as refused:
        main(["--list", "--file", "engines/nowhere.py"], project)
    assert refused.value.code == 2


@pytest.mark.parametrize(
    ("kind", "line", "after"),
    [
        ("comparison", "a < b", ["a <= b", "a >= b"]),
        ("comparison", "a is not b", ["a is b"]),
        ("comparison", "0 <= a <= b", ["0 < a <= b", "0 > a <= b", "0 <= a < b", "0 <= a > b"]),
        ("arithmetic", "a - b * c", ["a + b * c", "a - b / c"]),
        ("arithmetic", "a += b", ["a -= b"]),
        ("arithmetic", "-a", ["a"]),
        ("arithmetic", "a * b**c", ["a / b ** c", "a * (b * c)"]),
        ("arithmetic", "'a' + b + [c]", []),
        ("whole number", "a[1]", ["a[2]", "a[0]"]),
        ("factor", "a * 0.5", ["a * 5.0", "a * -0.5"]),
        ("factor", "a = 0.0", ["a = 1.0"]),
        ("swapped arguments", "f(a, b, 1, x.c, x.d, x.d)", ["f(b, a, 1, x.c, x.d, x.d)", "f(a, b, 1, x.d, x.c, x.d)"]),
        ("swapped arguments", "max(a, b) + np.hypot(a, b)", []),
        ("whole number", "a.reshape(-1, 2)", ["a.reshape(-1, 3)", "a.reshape(-1, 1)"]),
        ("swapped elements", "(a, b)", ["(b, a)"]),
        ("swapped elements", "a[:, b, c]", []),
        ("and or", "a and b or c", ["((a and b) and c)", "(a or b) or c"]),
        ("negation", "not a", ["a"]),
        ("negation", "~a & b", ["a & b"]),
        ("negation", "b if a else c", ["b if (not a) else c"]),
        ("dropped copy", "a.b.copy()", ["a.b"]),
        ("unstable sort", "sort(a, kind='stable')", ["sort(a)"]),
        ("opposite", "np.minimum(max(a), b)", ["np.maximum(max(a), b)", "np.minimum(min(a), b)"]),
        ("first last", "a[0] + b[-1] + c[i]", ["a[-1] + b[-1] + c[i]", "a[0] + b[0] + c[i]", "a[0] + b[-1] + c[0]"]),
        ("truth", "f(a=True)", ["f(a=False)"]),
        ("unit", "a = 'time [s]'", ["a = 'time [ms]'"]),
        ("unit", "f'{a} over dt [s]'", ["f'{a} over dt [ms]'"]),
    ],
)
def test_a_line_has_these_mutants_of_a_kind(kind: str, line: str, after: list[str]) -> None:
    """By hand."""
    found = [mutant.after for mutant in mutants("a.py", line + "\n") if mutant.kind == kind]
    assert sorted(found) == sorted(after)


@pytest.mark.parametrize(
    "text",
    [
        '"""From 0 to 1 [s]."""',
        'def f(a: "int | float" = None) -> tuple[int, float]:\n    """A < b."""',
        'raise ValueError(f"{a + 1} < 0.5 [s]")',
        "assert a < 1",
        "if TYPE_CHECKING:\n    a = 1",
        'def __repr__(self):\n    return "[s]" * 2',
        "@dataclass(frozen=True)\nclass A:\n    a: dict[str, int]",
        "zip(a, strict=True)",
        "Kind = int | None",
        "def f(*, mass=0.02, length=3): ...",
        "a, b = c",
        "f'{a + 1:.3f}'",
    ],
)
def test_what_no_test_should_hold_has_no_mutant(text: str) -> None:
    """Docstrings, types, the words of errors and what only people look at."""
    assert mutants("a.py", text + "\n") == []


@pytest.mark.rotating(4)
def test_every_mutant_of_the_project_is_a_program_with_another_line() -> None:
    """A random sample of a hundred; each changes the lines it says and no others."""
    for mutant in sample(ROOT, ROOMS, 100, 1):
        source = (ROOT / mutant.file).read_text(encoding="utf-8")
        changed = mutant.applied(source)
        compile(changed, mutant.file, "exec")
        above, below = source.splitlines()[: mutant.line - 1], changed.splitlines()
        assert below[: mutant.line - 1] == above
        assert mutant.before != mutant.after


@pytest.mark.rotating(3)
def test_the_tests_near_a_file_are_its_mirror_and_then_its_users() -> None:
    """Of an engine also the suite that every engine goes through, for the engines in question."""
    near = Imports(ROOT).near
    assert near("reference/forces.py")[0] == "tests/reference/test_forces.py"
    assert near("reference/axes.py")[0] == "tests/reference/test_obstacle_kinds.py"
    assert "tests/conformance/test_default_string.py" in near("engines/mujoco/tendons.py")
    assert near("report/figures/stability.py")[0].startswith("tests/report/figures/")
    assert near("report/figures/stability.py")[1] == "tests/test_habits.py"
    assert engines_of("engines/bullet/mesh.py") == ["bullet_softbody"]
    assert "mujoco_rope" not in engines_of("engines/mujoco/tendons.py")
    assert engines_of("reference/forces.py") == []


def test_equivalent_mutants_are_still_mutants() -> None:
    """Where a line has changed its entry is of no more use; and each says why nobody can notice it."""
    for entry in equivalents(ROOT):
        source = (ROOT / entry["file"]).read_text(encoding="utf-8")
        assert any(is_meant(entry, mutant) for mutant in mutants(entry["file"], source)), entry
        assert len(entry["reason"]) > 20
        assert entry.keys() <= {*FIELDS, "reason"}
