# What a developer runs, and what CI runs: `make help` lists it.
# Each step leaves a stamp in .venv/stamps and is done again only where something that it depends on has changed.

# The Python that makes .venv: the first one on the PATH that is new enough, or the one that `make PYTHON=... demo` names.
PYTHON ?=
VENV   := .venv
BIN    := $(VENV)/bin
STAMPS := $(VENV)/stamps
EXAMPLE := examples/trifilar_pendulum.py

RUST := $(shell find crates -name '*.rs' -o -name Cargo.toml) Cargo.toml Cargo.lock
PYTHON_SOURCES := $(shell find python -name '*.py' 2>/dev/null)

# CI runs everything, the rivals of the benchmarks too, and lets no lock file change; on a desk the slow tests wait.
LOCKED := $(if $(CI),--locked)
SELECT := $(if $(CI),,-m "not slow")
unexport PYTHONDONTWRITEBYTECODE  # hundreds of tests start programs, and each would compile the package anew
RIVALS := $(if $(CI),$(STAMPS)/bench)
PYTEST := $(BIN)/python -m pytest --numprocesses=2 --dist=worksteal

# What the system's package manager has is installed where that is allowed; `make INSTALL=no test` leaves the system as it is.
override INSTALL := $(if $(filter n no 0 false off,$(shell echo '$(INSTALL)' | tr '[:upper:]' '[:lower:]')),no,yes)
OPTIONS := $(if $(filter no,$(INSTALL)),--no-install)
TOOLS   := $(BIN)/python scripts/tools.py $(OPTIONS)
SYSTEM_PYTHON := PYTHON='$(PYTHON)' INSTALL=$(INSTALL) sh scripts/python.sh

# The description of Python that maturin gives PyO3: with another one, PyO3 would be compiled again.
AS_MATURIN = PYO3_BUILD_EXTENSION_MODULE=1 PYO3_CONFIG_FILE="$$(ls $(CURDIR)/target/maturin/pyo3-config-*.txt)"

# A lint whose tool could not be installed is left out; in CI, $(STAMPS)/tools-lint has failed before.
cargo-lint = @if cargo $(firstword $(2)) --version >/dev/null 2>&1; \
  then set -x; cargo $(2); else echo "Skipped: $(1) not found: cargo $(2)"; fi

say = @printf '\n\033[1m== %s\033[0m\n' "$(1)"

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help demo build test test-rust test-python lint lint-rust lint-python format bench docs clean

help:  ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 24

demo: out/.demo  ## derive, generate, simulate and draw the trifilar pendulum; results in out/
	@printf '\nThe results are in out/: open out/trifilar_motion.html in a browser. Once more: %s %s\n' $(BIN)/python $(EXAMPLE)

out/.demo: $(STAMPS)/build $(PYTHON_SOURCES) $(EXAMPLE)
	$(call say,Running $(EXAMPLE))
	@mkdir -p out
	$(BIN)/python $(EXAMPLE)
	@touch $@

build: $(STAMPS)/build  ## build the Rust extension (release) into .venv and install the package there

test: lint test-rust test-python  ## everything that is tested, lints included
	@$(TOOLS) --no-install lint

test-rust:
	$(call say,Rust tests)
	cargo test --release --config crates/checked.toml --workspace $(LOCKED)

test-python: $(STAMPS)/tools-test $(STAMPS)/build $(STAMPS)/develop $(RIVALS)
	$(call say,Python tests: laws$(,) references$(,) doctests$(,) documents$(,) examples$(,) benchmarks)
	$(PYTEST) $(SELECT)

lint: lint-rust lint-python  ## formats, lints, types and layers

lint-rust: $(STAMPS)/tools-lint $(if $(CI),$(STAMPS)/build)
	$(call say,Rust lints)
	$(call cargo-lint,rustfmt,fmt --all --check)
ifdef CI    # with the crates of others that the build has compiled, instead of reading them all anew
	PATH="$(abspath $(BIN)):$$PATH" RUSTC_WORKSPACE_WRAPPER=$(abspath scripts/lint_crate.py) $(AS_MATURIN) \
	  cargo build --release --config crates/lint.toml --workspace --all-targets $(LOCKED)
else
	$(call cargo-lint,clippy,clippy --release --workspace --all-targets $(LOCKED) -- --deny warnings)
	cargo --config 'build.rustdocflags="--deny warnings"' doc --release --no-deps --document-private-items --workspace $(LOCKED)
endif

# Stubtest is before mypy, since it leaves its own options in the cache with which the tests begin to check types.
lint-python: $(STAMPS)/build $(STAMPS)/develop
	$(call say,Python lints: format$(,) lint$(,) types$(,) layers)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/python -m mypy.stubtest symbody.symbolic._core
	$(BIN)/mypy
	$(BIN)/lint-imports --no-cache
	$(call say,Sizes: a report$(,) no lint)
	@$(BIN)/python scripts/sizes.py

format: $(STAMPS)/develop  ## put the sources into the project's format, and README.md into that of an index
	cargo fmt --all
	$(BIN)/ruff check --fix --exit-zero .
	$(BIN)/ruff format .
	$(BIN)/python scripts/index_page.py

bench: $(STAMPS)/build $(STAMPS)/bench  ## measure against the rivals (a quarter of an hour), write docs/benchmarks/
	$(BIN)/python -m benchmarks.derive.run
	$(BIN)/python -m benchmarks.lower.run
	$(BIN)/python -m benchmarks.evaluate.run
	$(BIN)/python -m benchmarks.simulate.run
	$(BIN)/python -m benchmarks.singular.run
	$(BIN)/python -m benchmarks.linear.small_variables
	$(BIN)/python -m benchmarks.linear.run
	$(BIN)/python -m benchmarks.sensitivity.run
	$(BIN)/python -m benchmarks.worksheet.run
	$(BIN)/python -m benchmarks.models.run

docs: $(STAMPS)/build $(STAMPS)/docs $(STAMPS)/develop  ## check the documents, write the API reference into site/
	$(PYTEST) tests/test_documents.py
	$(BIN)/pdoc --docformat google --math --output-directory site symbody

clean:  ## remove all that was made
	rm -rf $(VENV) target site build dist out
	find python -name '*.so' -delete

# --- the order -------------------------------------------------------------------------------------------------------

# `CI=true make test` does two steps at a time: Rust is compiled beside what downloads, then its lints and tests are
# beside the lints of Python. Rust, pip and the system's package manager have one step at a time each, and the tests of
# Python are alone. The lints of Rust follow the build, whose crates of others they take.
ifneq ($(and $(CI),$(filter test,$(MAKECMDGOALS))),)
MAKEFLAGS += --jobs=2
unexport MAKEFLAGS MFLAGS  # not for the tests: they run make, cargo and compilers, whose words they read
$(STAMPS)/extension: | $(STAMPS)/tools-lint
$(STAMPS)/bench: | $(STAMPS)/develop
$(STAMPS)/build: | $(STAMPS)/extension $(STAMPS)/bench
$(STAMPS)/tools-test: | $(STAMPS)/tools-lint
lint-rust: | $(STAMPS)/build
test-rust: | lint-rust
test-python: | lint-python test-rust
else
.NOTPARALLEL:
endif

# --- the steps -------------------------------------------------------------------------------------------------------

, := ,

$(STAMPS)/venv: scripts/environment.py
	$(call say,Making $(VENV))
	@$(SYSTEM_PYTHON) scripts/tools.py $(OPTIONS) build
	@$(SYSTEM_PYTHON) $< $(VENV)
	$(BIN)/pip install --quiet "maturin>=1.9.4,<2"
	@mkdir -p $(STAMPS) && touch $@

# In CI, the compiler runs beside pip, and this installs the package afterwards.
$(STAMPS)/extension: $(STAMPS)/venv $(RUST) pyproject.toml
	$(call say,Building the Rust extension)
	VIRTUAL_ENV=$(abspath $(VENV)) $(BIN)/maturin develop --release --skip-install $(LOCKED)
	@touch $@

$(STAMPS)/build: $(STAMPS)/venv $(RUST) pyproject.toml
	$(call say,Building the Rust extension and installing the package (some two minutes the first time))
	VIRTUAL_ENV=$(abspath $(VENV)) $(BIN)/maturin develop --release $(LOCKED)
	@touch $@

# The package manager is asked once; a tool that comes later by another way is found all the same.
$(STAMPS)/tools-lint $(STAMPS)/tools-test: $(STAMPS)/tools-%: $(STAMPS)/venv scripts/tools.py
	$(call say,Looking for the tools that $* needs)
	$(TOOLS) $*
	@touch $@

# The other packages of Python come from the groups of pyproject.toml, pinned there.
$(STAMPS)/develop $(STAMPS)/bench $(STAMPS)/docs: $(STAMPS)/venv pyproject.toml
	$(call say,Installing the tools to $(@F))
	$(BIN)/pip install --quiet --group $(@F)
	@touch $@
