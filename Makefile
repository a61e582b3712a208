# Two commands: `make report` and `make test`. Each sets up what it needs, in .venv, from the locked requirements.
# PYTHON=... is the Python to set up with: 3.11 or later; without it the first of those below that is there. 3.11 comes
# first, as Bullet's wheels are for that. VENV=... is another folder than .venv.
PYTHONS := python3.11 python3.12 python3.13 python3.14 python3 python
PYTHON ?= $(or $(shell for p in $(PYTHONS); do $$p -c $(IS_RIGHT) 2>/dev/null && echo $$p && break; done),python3.11)
IS_RIGHT := 'import sys, ensurepip, venv; sys.exit(sys.version_info < (3, 11))'
VERSION := 'import sys; print("%d.%d" % sys.version_info[:2])'
VENV ?= .venv
BIN := $(VENV)/bin
READY := $(VENV)/ready

# Programs are started by the hundred: what Python compiles them to is kept, also where it is told to leave nothing.
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := help
.PHONY: help setup report test docs soak mutants check lock clean

help:  ## What there is to make
	@awk -F ':.*## ' '/^[a-z]+:.*## /{printf "make %-8s %s\n", $$1, $$2}' Makefile

setup: $(READY)  ## Install everything, and run nothing
	@echo "Ready: $(BIN)/springlab --help; $(BIN)/springlab list says which engines are there"

report: $(READY)  ## Run the lab's main job: every experiment, on one page in results/report
	$(BIN)/springlab report

test: $(READY)  ## Run all tests, with formatting and types
	$(BIN)/python -m pytest --numprocesses auto --dist loadfile --no-loadscope-reorder

docs: $(READY)  ## Write the documentation as a site, results/docs/index.html
	$(BIN)/python -m report.site

soak: $(READY)  ## What `make test` does in small, in full: thousands of runs and kills, all kept versions of the engines
	$(BIN)/python -m pytest tests/soak tests/reference/files/test_fuzzed_files.py tests/report/live tests/experiments/exercises \
		tests/test_recipes.py tests/reference/scenes/test_drape.py --full -s -p no:xdist
	$(BIN)/python -m pytest -m rotating --full -p no:xdist
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
	.venv-lock/bin/uv pip compile pyproject.toml --group dev --group docs --universal --python-version 3.11 --generate-hashes \
		--no-header --no-annotate --no-emit-index-url --upgrade --output-file requirements.lock
	rm -rf .venv-lock

clean:  ## Remove the environment, the results and the caches
	rm -rf $(VENV) results .pytest_cache .mypy_cache .ruff_cache .hypothesis

# Where another Python is asked for than the environment is of, it is made anew.
ifneq ($(filter command environment,$(firstword $(origin PYTHON))),)
ifneq ($(shell $(PYTHON) -c $(VERSION) 2>/dev/null),$(shell $(BIN)/python -c $(VERSION) 2>/dev/null))
.PHONY: $(READY)
endif
endif

$(READY): requirements.lock pyproject.toml
	@$(PYTHON) -c $(IS_RIGHT) 2>/dev/null || { echo "springlab needs Python 3.11 or later, with venv (on Debian and \
	Ubuntu: apt install python3-venv): $(PYTHON) is none; make PYTHON=/path/to/python3 takes another" >&2; exit 1; }
	$(PYTHON) -m venv --clear $(VENV)
	$(BIN)/pip install --quiet --disable-pip-version-check --require-hashes --requirement requirements.lock
	$(BIN)/pip install --quiet --disable-pip-version-check --no-build-isolation --no-deps --editable .
	touch $@
