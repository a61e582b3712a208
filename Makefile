# Two commands: `make report` and `make test`. Each sets up what it needs, in .venv, from the locked requirements.
PYTHON ?= python3.11
BIN := .venv/bin
READY := .venv/ready

# Programs are started by the hundred: what Python compiles them to is kept, also where it is told to leave nothing.
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := help
.PHONY: help report test soak mutants check lock clean

help:  ## What there is to make
	@awk -F ':.*## ' '/^[a-z]+:.*## /{printf "make %-8s %s\n", $$1, $$2}' Makefile

report: $(READY)  ## Run the lab's main job: every experiment, on one page in results/report
	$(BIN)/springlab report

test: $(READY)  ## Run all tests, with formatting and types
	$(BIN)/python -m pytest --numprocesses auto --dist loadfile

soak: $(READY)  ## What `make test` does in small, in full: thousands of runs and kills, all kept versions of the engines
	$(BIN)/python -m pytest tests/soak tests/reference/files/test_fuzzed_files.py tests/report/live tests/experiments/exercises \
		--full -s -p no:xdist
	$(BIN)/python -m tests.fuzz --count $(or $(COUNT),3000) --seed $(or $(SEED),0)
	$(BIN)/springlab versions --check

mutants: $(READY)  ## A hundred small mistakes in the sources, and which of them the tests near them miss; SEED=N for others
	$(BIN)/python -m tests.mutants --count $(or $(COUNT),100) --seed $(or $(SEED),0)

check: $(READY)  ## Formatting and types only
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy

lock: $(READY)  ## Renew requirements.lock from pyproject.toml
	$(PYTHON) -m venv .venv-lock && .venv-lock/bin/pip install --quiet uv
	.venv-lock/bin/uv pip compile pyproject.toml --group dev --universal --python-version 3.11 --generate-hashes \
		--no-header --no-annotate --no-emit-index-url --upgrade --output-file requirements.lock
	rm -rf .venv-lock

clean:  ## Remove the environment, the results and the caches
	rm -rf .venv results .pytest_cache .mypy_cache .ruff_cache .hypothesis

$(READY): requirements.lock pyproject.toml
	$(PYTHON) -m venv .venv
	$(BIN)/pip install --quiet --disable-pip-version-check --require-hashes --requirement requirements.lock
	$(BIN)/pip install --quiet --disable-pip-version-check --no-build-isolation --no-deps --editable .
	touch $@
