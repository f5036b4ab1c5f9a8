# Emogen. `make` alone lists what there is.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
ARGS ?=
# Processes that run tests, a file of tests at a time. Each has a browser and a server of its own, so more of them want
# more cores; and one thread each for algebra, or they take the cores from each other.
JOBS ?= 2
test: export OPENBLAS_NUM_THREADS = 1
test: export OMP_NUM_THREADS = 1

.DEFAULT_GOAL := help
.PHONY: help serve test check bench install screenshots rig wheel clean

help: ## list the targets
	@grep -E '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sort | awk -F ':.*## ' '{ printf "  make %-12s %s\n", $$1, $$2 }'

serve: $(VENV)/.serve ## install what is missing, migrate, make a demo study, serve, print the links
	$(BIN)/emogen serve $(ARGS)

# A page that did not come in time on a busy machine is asked for once more, and the summary names it (RERUN); nothing
# else that fails is tried again.
test: check ## install what is missing (a headless Chromium included), check, run every test
	$(BIN)/pytest -n $(JOBS) --dist loadfile --reruns 1 --only-rerun '^TimeoutError' $(ARGS)

check: $(VENV)/.test ## lint, format, types, import rules
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

bench: $(VENV)/.test ## measure drawing and turnaround on this machine
	$(BIN)/emogen bench render --json
	$(BIN)/emogen bench turnaround --json

install: $(VENV)/.serve ## install Emogen into .venv without starting it

screenshots: $(VENV)/.test ## draw docs/screenshots anew in a real browser
	$(BIN)/python -m tests.browser.screenshots docs/screenshots
	$(BIN)/python -m tests.browser.desk docs/screenshots

rig: $(VENV)/.test ## bake the bundled rig and its look anew from the CC0 sources, and draw its sheets
	$(BIN)/emogen rig build
	$(BIN)/emogen rig sheet --out docs/rig

wheel: $(VENV)/.test ## build the wheel into dist/
	$(BIN)/pip wheel --quiet --no-deps --wheel-dir dist .

clean: ## remove the virtual environment and caches; data in var/ stays
	rm -rf $(VENV) dist build .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache

$(BIN)/python:
	scripts/system_packages.sh serve
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Emogen needs Python 3.11 or later: make PYTHON=python3.12 serve")'
	$(PYTHON) -m venv $(VENV)

$(VENV)/.serve: pyproject.toml | $(BIN)/python
	scripts/system_packages.sh serve
	$(BIN)/pip install --quiet --disable-pip-version-check --editable .
	touch $@

$(VENV)/.test: pyproject.toml | $(BIN)/python
	scripts/system_packages.sh test
	$(BIN)/pip install --quiet --disable-pip-version-check --editable '.[dev]'
	touch $@ $(VENV)/.serve
