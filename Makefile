# `make demo` runs a first crack, `make test` runs the checks. Both need only make and Python >= 3.11.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
JOBS ?= 2
export PIP_DISABLE_PIP_VERSION_CHECK := 1

.PHONY: help demo test test-newest test-oldest lock verify soak lint format docs html clean
.DEFAULT_GOAL := help

help:  ## what can be made
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:[^#]*##/\t/'

# What `make demo` and `make test` install is in a lock: the same on every machine, today and later.
LOCK := locks/dev.txt
NEEDS_3_11 := import sys; sys.exit(sys.version_info < (3, 11))
# hatchling and what it needs are in the lists as well, so that nothing is fetched to build cramp
INSTALL := -m pip install --quiet --only-binary :all:
CRAMP := -m pip install --quiet --no-deps --no-build-isolation --no-index --editable .

# Made once; again when the packages it needs change.
$(READY): pyproject.toml $(LOCK)
	@$(PYTHON) -c '$(NEEDS_3_11)' || \
	  { echo "cramp needs Python 3.11 or newer: make PYTHON=python3.12 ..." >&2; exit 1; }
	$(PYTHON) -m venv --clear $(VENV)
	$(BIN)/python $(INSTALL) --require-hashes --requirement $(LOCK)
	$(BIN)/python $(CRAMP)
	@touch $@

demo: $(READY)  ## run a double cantilever beam and compare its J and K_I with a reference
	$(BIN)/cramp run inputs/dcb.yaml -o dcb.run --overwrite
	@echo
	@echo "Reference (NairnMPM, J by contour at 1.5 ms):   336 | 5.797e+05 |"
	$(BIN)/cramp report dcb.run
	@echo "All samples: dcb.run/cracks.csv. To look at it: open dcb.run/report.html in a browser,"
	@echo "or dcb.run/particles.xdmf and dcb.run/cracks.xdmf in ParaView."

test: lint  ## lint and the fast tests (layer rule included)
	$(BIN)/python -m pytest -n $(JOBS) -q -m "not slow and not soak"

# Beside the lock: what pyproject.toml allows. Each of these makes its environment anew.
UV := $(VENV)-tools/bin/uv
RESOLVE = $(UV) pip compile --quiet --no-header --extra dev pyproject.toml
TESTED = -m pytest -n $(JOBS) -q -m "not slow and not soak"
OLDEST_PYTHON ?= python3.11

$(UV): locks/tools.txt
	$(PYTHON) -m venv --clear $(VENV)-tools
	$(VENV)-tools/bin/python $(INSTALL) --require-hashes --requirement locks/tools.txt
	@touch $@

lock: $(UV)  ## write locks/: the newest releases for Python 3.11 and later, with their hashes
	$(RESOLVE) --upgrade --universal --python-version 3.11 --generate-hashes -o $(LOCK)
	echo uv | $(UV) pip compile --quiet --no-header --upgrade --universal --python-version 3.11 \
	  --generate-hashes -o locks/tools.txt -

test-newest:  ## the fast tests with the newest releases of all packages, without the lock
	$(PYTHON) -m venv --clear $(VENV)-newest
	$(VENV)-newest/bin/python -m pip install --quiet --editable ".[dev]"
	$(VENV)-newest/bin/python $(TESTED)

test-oldest: $(UV)  ## the fast tests with the oldest releases that pyproject.toml allows
	$(OLDEST_PYTHON) -m venv --clear $(VENV)-oldest
	$(RESOLVE) --resolution lowest-direct --python $(VENV)-oldest -o $(VENV)-oldest/list.txt
	$(VENV)-oldest/bin/python $(INSTALL) --requirement $(VENV)-oldest/list.txt
	$(VENV)-oldest/bin/python $(CRAMP)
	$(VENV)-oldest/bin/python $(TESTED)

verify: $(READY)  ## decks and long tests against theory and papers; writes docs/verification.md, convergence.md, growing.md
	$(BIN)/cramp verify --full --report docs/verification.md
	$(BIN)/python tests/verification/convergence.py > docs/convergence.md
	$(BIN)/python tests/verification/growing.py > docs/growing.md
	$(BIN)/python -m pytest -n $(JOBS) -q -m "(slow or verification) and not soak"

soak: $(READY)  ## kills, full disks and fuzzed decks by the hundred: half an hour
	$(BIN)/python -m pytest -q -m soak

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

format: $(READY)  ## put the sources into shape
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

html: $(READY)  ## the pages of docs/ for a browser: docs/_build/html/index.html
	$(BIN)/python -m sphinx -E -W --keep-going -q docs docs/_build/html

docs: $(READY)  ## write docs/decks.md and the JSON schema of a deck for editors
	$(BIN)/python -c "from cramp_cli.deck import reference as r; print(r.deck_reference(), end='')" \
	  > docs/decks.md
	$(BIN)/cramp schema > docs/deck.schema.json

clean:  ## remove what these targets made
	rm -rf $(VENV) $(VENV)-tools $(VENV)-newest $(VENV)-oldest dcb.run build dist docs/_build .pytest_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
