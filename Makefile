# Two commands do everything on a machine with python3, venv and make: `make demo` and `make test`.
# Debian's own interpreter, where it is the one that every wheel is made for: it is built with profile
# guidance, one that was compiled at home seldom is, and the control loop is a tenth faster for it.
PYTHON ?= $(shell /usr/bin/python3 -c 'import ensurepip, sys; sys.exit(sys.version_info[:2] != (3, 11))' \
  2>/dev/null && echo /usr/bin/python3 || echo python3)
BIN := .venv/bin
STAMP := .venv/.installed
LINT_STAMP := .venv/.lint-installed
PIP := $(BIN)/python -m pip --disable-pip-version-check

.PHONY: setup demo test test-can lint bench lock baselines wheel clean

setup: $(STAMP)

$(STAMP): requirements.lock pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit(None if sys.version_info >= (3, 11) else "Python 3.11 or newer is needed, found " + sys.version.split()[0])'
	test -x $(BIN)/python || $(PYTHON) -m venv .venv
	$(PIP) install --quiet --require-hashes --requirement requirements.lock
	$(PIP) install --quiet --no-deps --no-build-isolation --editable .
	touch $@

demo: setup
	$(BIN)/hil demo --out out/demo --overwrite

# As root with apt-get, first installs what kernel CAN needs (see the script); else those tests skip.
test: setup
	scripts/install-can-tools
	$(BIN)/python -m pytest -n 2 --dist worksteal

# What needs a kernel CAN bus; in User-Mode Linux where this kernel has none (`make test` does it too).
test-can: setup
	scripts/vcan $(BIN)/python -m pytest -m socketcan tests/socketcan tests/nrs tests/sensor tests/contract

lint: setup
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

bench: setup
	$(BIN)/hil bench

# torch for the CPU and stable-baselines3, for the learners dql, ac, pg and ppo.
baselines: setup
	$(PIP) install --requirement requirements-baselines.txt

# Writes the lock file anew from pyproject.toml (needs uv). Not of the extra `baselines`: on PyPI torch
# for Linux is the one for CUDA.
lock:
	uv pip compile pyproject.toml --extra test --extra lint --extra build --universal --python-version 3.11 \
	  --generate-hashes --no-emit-index-url --no-emit-find-links --output-file requirements.lock

wheel: setup
	$(PIP) wheel --no-deps --no-build-isolation --wheel-dir dist .

clean:
	rm -rf .venv build dist out *.egg-info
