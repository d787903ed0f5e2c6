# SPDX-License-Identifier: Apache-2.0
# Everything starts from a bare `python3` (3.11 or newer): each target sets up what it needs.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check -qq
PACKAGES := $(patsubst %/setup.py,%,$(wildcard src/*/setup.py))
BUILD_FILES := $(wildcard src/*/setup.py src/*/setup.cfg src/*/package.xml)

.PHONY: setup peers demo test test-slow test-faults lint docs clean

setup: $(VENV)/.packages

# Brian2 needs another version of NumPy than everybody else, and has it to itself.
peers: setup
	$(PIP) install --no-deps --requirement requirements-peers.txt
	$(PIP) install --no-deps --upgrade --target $(VENV)/peers/brian2 --requirement requirements-brian2.txt

demo: setup
	$(BIN)/srnn demo $(ARGS)

test: setup
	$(BIN)/python -m pytest -m 'not slow' $(ARGS)

test-slow: setup
	$(BIN)/python -m pytest -m slow $(ARGS)

test-faults: setup
	$(BIN)/python -m pytest test/faults --injections 20 $(ARGS)

lint: setup
	$(BIN)/ruff check .
	$(BIN)/mypy

# Benchmarks and commands are no library; importing MuJoCo asks a process for its version.
API := $(filter-out srnn_bench srnn_bringup,$(notdir $(PACKAGES))) \
	srnn_bringup.config srnn_bringup.config_files

docs: setup
	$(PIP) install --no-deps --requirement requirements-docs.txt
	PDOC_ALLOW_EXEC=1 $(BIN)/python -W error -m pdoc --docformat google --math --output-directory build/api $(API)
	@echo 'API reference: build/api/index.html'

clean:
	rm -rf $(VENV) build install log .mypy_cache .pytest_cache .ruff_cache .hypothesis
	rm -rf src/*/build src/*/*.egg-info
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

OLDER = $(shell $(PYTHON) -c 'import sys; print("--requirement requirements-before-3.14.txt" * (sys.version_info < (3, 14)))')

$(VENV)/.requirements: requirements.lock requirements-before-3.14.txt
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Python 3.11 or newer is needed, this is " + sys.version)'
	@echo 'Setting up $(VENV), about a minute ...'
	$(PYTHON) -m venv $(VENV)
	$(PIP) install setuptools==$$(sed -n 's/^setuptools==//p' requirements.lock)
	$(PIP) install --no-deps --requirement requirements.lock $(OLDER)
	touch $@

# PEP 517 puts console scripts into the environment's bin, in spite of the setup.cfg of ROS.
$(VENV)/.packages: $(VENV)/.requirements $(BUILD_FILES)
	$(PIP) install --no-deps --no-build-isolation --use-pep517 $(addprefix --editable ./,$(PACKAGES))
	touch $@
