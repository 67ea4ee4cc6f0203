# `make` lists the targets. Everything happens in .venv, from the locks; nothing else needs to be installed first
# but Python 3.11 or newer and, for some tests, a package manager that has Chromium and strace.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
MAKEFLAGS += --no-builtin-rules --no-print-directory
.DELETE_ON_ERROR:

PYTHON ?= python3
BIN := .venv/bin
PIP := $(BIN)/python -m pip -qq --disable-pip-version-check
PYTEST_ARGS ?=

# mypy refuses a folder without Python files, so folders count from their first one.
TYPED := $(patsubst %/,%,$(sort $(dir $(wildcard benchmarks/*.py tools/*.py)))) leaderboard tests

##@ Use
.PHONY: help
help: ## list the targets
	@awk 'BEGIN {FS = ":.*## "} /^##@/ {printf "\n%s\n", substr($$0, 5)} /^[a-z-]+:.*## / {printf "  make %-8s %s\n", $$1, $$2}' Makefile

.PHONY: demo
demo: .venv/.runtime ## validate, grade, rank and publish the submissions in this repository
	@bash tools/demo.sh

##@ Develop
.PHONY: dev
dev: .venv/.dev ## make .venv with everything for development

.PHONY: test
test: .venv/.dev browser checker tracer ## run all tests in parallel, with coverage (PYTEST_ARGS="-k name" adds arguments)
	@$(BIN)/python -m pytest --cov $(PYTEST_ARGS)

.PHONY: campaign
campaign: .venv/.dev ## hours of hostile input, kills, failing disks and mutants: docs/security.md (CAMPAIGN=kills: one)
	@nice -n 19 $(BIN)/python -m benchmarks.campaigns $(CAMPAIGN)

.PHONY: browser
browser: ## make sure that Chromium is there for the browser tests
	@bash tools/install-program.sh chromium "nothing will open the built website"

.PHONY: tracer
tracer: ## make sure that strace is there for the test in which calls of the system fail
	@bash tools/install-program.sh strace "no call of the system will be made to fail"

.PHONY: checker
checker: .venv/.made ## make sure that the HTML checker is there for its test
	@bash tools/install-html-checker.sh

.PHONY: check
check: lint types imports ## lint, types and imports: all that CI checks besides the tests

.PHONY: lint
lint: .venv/.dev ## ruff: rules and format
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .

.PHONY: format
format: .venv/.dev ## ruff: mend what it can
	@$(BIN)/ruff check --fix .
	@$(BIN)/ruff format .

.PHONY: types
types: .venv/.dev ## mypy, strict
	@$(BIN)/mypy $(TYPED)

.PHONY: imports
imports: .venv/.dev ## import-linter: the floors of the house
	@$(BIN)/lint-imports --no-cache

##@ Maintain
COMPILE = CUSTOM_COMPILE_COMMAND="make lock" $(BIN)/pip-compile --quiet --generate-hashes --strip-extras --allow-unsafe \
	--no-emit-index-url --no-emit-trusted-host --no-emit-find-links --no-emit-options --no-header --newline lf

.PHONY: lock
lock: .venv/.dev ## write both locks anew for pyproject.toml (UPGRADE=1: newest versions)
	@$(BIN)/python -c 'import sys; sys.version_info[:2] == (3, 11) or sys.exit("make lock needs Python 3.11, the oldest supported: make clean, then make lock PYTHON=python3.11")'
	$(COMPILE) $(if $(UPGRADE),--upgrade) --build-deps-for editable --output-file requirements.lock pyproject.toml
	$(COMPILE) $(if $(UPGRADE),--upgrade) --build-deps-for editable --extra dev --constraint requirements.lock --output-file requirements-dev.lock pyproject.toml

.PHONY: vendor
vendor: .venv/.runtime ## copy what tools/vendor/package-lock.json holds from npm into the website
	@$(BIN)/python tools/vendor_site.py

.PHONY: examples
examples: .venv/.runtime ## write the embedded reference's baselines and simulated systems anew
	@$(BIN)/leaderboard baselines
	@$(BIN)/python tools/simulate_examples.py

.PHONY: clean
clean: ## remove .venv, caches and what was built
	rm -rf .venv .mypy_cache .pytest_cache .ruff_cache .import_linter_cache .hypothesis .coverage .coverage.* htmlcov build dist site/dist
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# Stamps: a second run finds everything in place.
.venv/.made:
	@$(PYTHON) -c 'import sys; sys.version_info >= (3, 11) or sys.exit("Python 3.11 or newer is needed, found " + sys.version.split()[0] + ": make PYTHON=python3.11 ...")'
	@echo "Making .venv ..." >&2
	@$(PYTHON) -m venv .venv
	@touch $@

.venv/.runtime: .venv/.made requirements.lock pyproject.toml leaderboard/__init__.py
	@echo "Installing what requirements.lock holds ..." >&2
	@$(PIP) install --require-hashes -r requirements.lock
	@$(PIP) install --no-deps --no-build-isolation --no-index -e .
	@touch $@

.venv/.dev: .venv/.runtime requirements-dev.lock
	@echo "Installing what requirements-dev.lock holds ..." >&2
	@$(PIP) install --require-hashes -r requirements-dev.lock
	@touch $@
