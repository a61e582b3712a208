"""What there is, as tables: scenes, steppers, engines, experiments."""

from __future__ import annotations

from report.shown import Shown


def scene_rows() -> Shown:
    """Scenes with their slides and parameters."""
    from reference.scenes import comes_from, scenes

    rows = [
        [
            s.name,
            s.slides,
            _with_origin(s.summary, comes_from(s.name)),
            ", ".join(f"{key}={value}" for key, value in s.parameters.items()),
        ]
        for s in scenes().values()
    ]
    return Shown("scenes", ["scene", "slides", "what", "parameters"], rows)


def besides_rows() -> Shown:
    """The parameters that every scene has besides its own."""
    from reference.scenes import BESIDES

    return Shown("every scene", ["parameter", "what"], [[name, words] for name, words in BESIDES.items()])


def stepper_rows() -> Shown:
    """All steppers that are not engines, and the solvers that are run only where they are named."""
    from experiments.runs.steppers import all_steppers
    from reference.schemes.catalogue import comes_from, constraint_schemes, schemes, wide_schemes
    from reference.stepper import SchemeStepper

    rows = []
    for stepper in all_steppers().values():
        if stepper.kind != "engine":
            summary = stepper.scheme.summary if isinstance(stepper, SchemeStepper) else stepper.summary  # type: ignore[attr-defined]
            package = comes_from(stepper.name) if stepper.name in schemes() else ""
            rows.append([stepper.name, stepper.kind, _with_origin(summary, package)])
    rows += [
        [scheme.name, scheme.kind, _with_origin(scheme.summary, comes_from(scheme.name))]
        for scheme in {**constraint_schemes(), **wide_schemes()}.values()
    ]
    return Shown("schemes", ["stepper", "kind", "what"], rows)


def engine_rows() -> Shown:
    """Each with its version, the schemes it claims to step by, and what is recorded with its results."""
    from engines.engine import absence, precision, registry, version
    from reference.registry import origin

    rows = [
        [
            engine.name,
            _with_origin(version(engine) or "", origin(type(engine).__module__)) or f"not available: {absence(engine)}",
            ", ".join(dict.fromkeys(engine.identified_as.values())),
            engine.semantics,
            dict(engine.settings),
            precision(engine),
        ]
        for engine in registry().values()
    ]
    return Shown("engines", ["engine", "version", "known to be", "in SI units", "settings", "precision"], rows)


def experiment_rows() -> Shown:
    """Experiments with their questions."""
    from experiments.experiment import experiments

    rows = [[experiment.name, experiment.slides, experiment.question] for experiment in experiments().values()]
    return Shown("experiments", ["experiment", "slides", "question"], rows)


def _with_origin(words: str, package: str) -> str:
    """With the installed package that adds it, where one does."""
    return f"{words} (from {package})" if package and words else words
