# Every target makes the environment it needs: make demo works in a fresh clone.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help

PYTHON ?= python3
UV := $(shell command -v uv 2>/dev/null || echo .uv/bin/uv)
RUN := .venv/bin
READY := .venv/.ready
FIGURES := fig1 fig2 fig3 fig4 fig5 fig6 fig7

.PHONY: help setup demo test test-full check bench results figures $(FIGURES) video7 view clean

help: ## list the targets
	@grep -hE '^[a-z0-9 -]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:[^#]*## /|/' | awk -F'|' '{printf "  make %-26s %s\n", $$1, $$2}'

setup: $(READY) ## make the environment in .venv

$(READY): uv.lock pyproject.toml .python-version
	@if ! command -v $(UV) >/dev/null; then \
	  echo "uv is not installed: putting it into .uv"; \
	  $(PYTHON) -m venv .uv || { echo "python3 -m venv failed: install Python 3 with venv (on Debian: apt install python3-venv), or uv"; exit 2; }; \
	  .uv/bin/python -m pip install --quiet --disable-pip-version-check uv; \
	fi
	@$(UV) sync --frozen --quiet || { echo "the environment could not be made: it needs Python 3.11 (PyBullet has no wheels for later ones); 'uv python install 3.11' fetches it"; exit 2; }
	@touch $@

demo: $(READY) ## learn, reach, mimic, replay, draw all figures with few seeds; under 5 minutes
	$(RUN)/python -m cli.demo

test: $(READY) ## the tests, under 5 minutes
	$(RUN)/pytest -n 2 --dist worksteal -q

test-full: $(READY) ## the slow tests too
	$(RUN)/pytest -n 2 --dist worksteal -q -m ""

check: $(READY) ## ruff, mypy, who imports whom
	$(RUN)/ruff check .
	$(RUN)/ruff format --check .
	$(RUN)/mypy
	$(RUN)/pytest -q tests/test_import_rule.py

bench: $(READY) ## ratios of speed and memory against their bounds, into data/bench.json
	$(RUN)/python -m tests.benchmarks

results: $(READY) ## the numbers of docs/results.md over 20 untuned seeds; about an hour
	$(RUN)/python -m cli.results

fig1 fig2 fig4 fig5 fig6 fig7: $(READY) ## a figure of the paper with its claims, all seeds
	$(RUN)/imitate figure $@

fig3: $(READY) ## both panels of Fig. 3
	@failed=0; for name in fig3a fig3b; do $(RUN)/imitate figure $$name || failed=1; done; exit $$failed

figures: $(READY) ## all figures; exit code 1 when a claim fails
	@failed=0; for name in fig1 fig2 fig3a fig3b fig4 fig5 fig6 fig7; do \
	  $(RUN)/imitate figure $$name || failed=1; done; exit $$failed

video7: $(READY) ## the film that accompanies Fig. 7
	$(RUN)/python -m cli.video7

view: $(READY) ## open the newest run in Rerun
	$(RUN)/imitate view "$$(ls -td data/runs/*/*/ | head -n 1)"

clean: ## remove the environment and caches; data/ stays
	rm -rf .venv .uv .mypy_cache .ruff_cache .pytest_cache .hypothesis
