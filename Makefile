# The targets of irbkin. `make help` lists them.
SHELL := bash
.SHELLFLAGS := -eu -o pipefail -c
.DELETE_ON_ERROR:
# Of make's jobs rustc would look for a server that no recipe has, and warn.
export CARGO_MAKEFLAGS :=

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
RUST_SOURCES := $(shell find src crates -name '*.rs' -o -name Cargo.toml) Cargo.toml
# Profile of the extension in .venv: develop, or release, which also serves the wheel.
PROFILE ?= develop
BUILT := $(VENV)/.irbkin-$(PROFILE)
RELEASED := $(VENV)/.irbkin-release
PEERS := .venv-peers
export BENCHES := python_calls motion motion_limits plan cells free_motion stream reach_map rapid_module rapid_check command lsp
NO_STD := --no-default-features --features libm
# Run a command under a name; if it takes long, print the name and the seconds. With -q what it
# prints is kept until it fails, and crates are counted.
STEP := @tests/step.sh
CRATES := -p irbkin -p irbkin-motion -p irbkin-abb
LAW_CRATES := cargo test -p irbkin-abb -p irbkin-tests --lib --tests
SUITE := cargo test $(CRATES) -p irbkin-tests --lib --tests
# A download that breaks off is no reason to fail.
PIP_INSTALL := tests/retry.sh $(BIN)/pip install --quiet --disable-pip-version-check
# Panic messages name source files: without the folders of this machine, and those of the toolchain
# as in a toolchain without its sources. The compiler adds no path of this crate: its are relative.
REMAPPED = --remap-path-prefix=$${CARGO_HOME:-$$HOME/.cargo}/registry/src/= \
	--remap-path-prefix=$$(rustc --print sysroot)/lib/rustlib/src/rust=/rustc
# The same flags for the environment and for the wheel: one build serves both.
EXTENSION_FLAGS = RUSTFLAGS="$${RUSTFLAGS:-} $(REMAPPED)"
# For files of a release, with the time of the commit: two builds have the same bytes.
SHIPPED = env $(EXTENSION_FLAGS) SOURCE_DATE_EPOCH="$$(git log -1 --format=%ct)" \
	VENV="$(abspath $(VENV))" PATH="$(abspath $(BIN)):$$PATH"
TARGETS := x86_64-unknown-linux-gnu aarch64-unknown-linux-gnu x86_64-unknown-linux-musl x86_64-pc-windows-gnu

# Compile a tool in Rust, unless it is there: $(call TOOL,NAME,VERSION).
TOOL = tests/step.sh "Compile $(1) (a minute or more)" \
	cargo install --quiet --locked --debug --root target/tools $(1)@$(2)
MSRV := $(shell sed -nE 's/^rust-version = "(.*)"/\1/p' Cargo.toml)

.PHONY: help run test quick test-sets test-oracles check bench bench-peers evidence soak fuzz mutants docs site test-recipes test-ros page \
	test-page capi test-capi bench-capi speed wheel packages ship test-platforms reproducible thirdparty deny \
	semver msrv clean toolchains lints package

help: ## List the targets
	@grep -E '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 16
	@echo; benches/evidence.sh

toolchains:
	@command -v cargo >/dev/null || { echo "cargo is missing: install a Rust toolchain (1.89 or newer), https://rustup.rs"; exit 1; }
	@command -v $(PYTHON) >/dev/null || { echo "$(PYTHON) is missing: install Python 3.10 or newer, or set PYTHON="; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10))' || { echo "$(PYTHON) is older than 3.10: set PYTHON="; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' || { echo "$(PYTHON) has no venv: install it (Debian: python3-venv)"; exit 1; }

$(VENV)/.made: | toolchains
	$(STEP) "Set up $(VENV)" $(PYTHON) -m venv $(VENV)
	@$(PIP_INSTALL) --upgrade 'pip>=25.1'
	@$(PIP_INSTALL) 'maturin>=1.9,<2' 'numpy>=1.23' 'rich>=13' 'rich-argparse>=1.5' 'shtab>=1.12'
	@touch $@

$(VENV)/.irbkin-%: $(VENV)/.made $(RUST_SOURCES) pyproject.toml | toolchains
	$(STEP) -q "Build irbkin into $(VENV) (three minutes on two cores)" \
		env VIRTUAL_ENV=$(abspath $(VENV)) $(EXTENSION_FLAGS) \
		$(BIN)/maturin develop --profile $*
	@rm -f $(VENV)/.irbkin-* && touch $@

$(VENV)/.test: $(VENV)/.made pyproject.toml
	$(STEP) "Install test tools into $(VENV)" $(PIP_INSTALL) --group test
	@touch $@

$(VENV)/.groups: $(VENV)/.made pyproject.toml
	$(STEP) "Install test tools and reference packages into $(VENV)" $(PIP_INSTALL) --group test --group oracles --group check
	@touch $@ $(VENV)/.test

$(VENV)/.site: $(VENV)/.made pyproject.toml
	$(STEP) "Install what builds the site into $(VENV)" $(PIP_INSTALL) --group site
	@touch $@

run: $(BUILT) ## Solve a pose of an IRB 2600 and show all solutions
	@$(BIN)/python examples/01_solve_a_pose.py
	@printf '\nnext: source $(BIN)/activate; irbkin view "IRB 2600-12/1.65"; irbkin --help\n'

# What suites of evidence need.
package: $(BUILT) $(VENV)/.groups

test: | toolchains ## Run the laws in Rust, and the tests in Python that need no extras
	@echo "Builds irbkin for development and runs its laws: about ten minutes on two cores."
	@$(MAKE) --no-print-directory $(BUILT) $(VENV)/.test
	@tests/laws.sh $(BIN)/python $(LAW_CRATES)

quick: $(VENV)/.quick-rust $(VENV)/.quick-python ## Test what changed since the last time, a tenth of the poses

$(VENV)/.quick-rust: $(BUILT) $(shell find tests -name '*.rs')
	$(STEP) "Laws in Rust" env IRBKIN_DIVISOR=10 $(LAW_CRATES) --quiet -- laws:: rapid allocation
	@touch $@

$(VENV)/.quick-python: $(BUILT) $(VENV)/.test $(shell find python tests/python -name '*.py')
	$(STEP) "Python tests" $(BIN)/python -m pytest -q -n auto --dist worksteal --failed-first \
		-m "not extra and not recipes and not evidence"
	@touch $@

test-sets: | toolchains ## Run unit tests of kinematics, and the laws on each instruction set
	$(STEP) -q "Compile the Rust tests" $(SUITE) --no-run
	$(STEP) "Unit tests of kinematics" $(filter-out --tests,$(SUITE))
	$(STEP) "Rust tests that force an instruction set" $(SUITE) -- --ignored
	$(STEP) "Laws on the baseline" env IRBKIN_INSTRUCTION_SET=baseline $(SUITE) -- laws:: hard_sets::

# Where everything can be installed, as in .ci/run, no test may be skipped.
test-oracles: $(BUILT) $(VENV)/.groups ## Install extras and reference packages; run the tests that need them
	$(STEP) "Python tests with extras and references" $(BIN)/python -m pytest -n auto --dist worksteal -m extra --no-skips

lints:
	cargo fmt --all --check
	$(STEP) "clippy" cargo clippy --quiet --workspace --all-targets -- -D warnings
	$(STEP) "clippy without std" cargo clippy --quiet -p irbkin-abb --lib $(NO_STD) -- -D warnings
	$(STEP) "clippy without urdf and serde" cargo clippy --quiet -p irbkin-motion --lib --no-default-features --features std -- -D warnings

test-recipes: $(BUILT) $(VENV)/.groups ## Install JAX, Polars, xarray, rerun; run the recipes
	@if tests/step.sh "Install what recipes need" $(PIP_INSTALL) --group recipes; then \
		tests/step.sh "Recipes" $(BIN)/python -m pytest --quiet -m recipes; \
	else \
		echo "SKIPPED: recipes were not run: their packages cannot be installed (the reason is above)"; \
	fi

# In a ROS of its own each; only where one cannot be installed it is skipped, with the reason.
test-ros: $(BUILT) ## Install ROS 1 and ROS 2, build the workspace, check both nodes
	@tests/ros/test.sh $(abspath $(BIN)/python)

# The compiler is of Debian's packages: where they cannot be had, exit code 77 and the reason.
page: $(BUILT) ## Build the page, one HTML file with irbkin as WebAssembly: target/page/irbkin.html
	@crates/irbkin-page/page/wasm.sh
	$(BIN)/python crates/irbkin-page/page/pack.py

test-page: $(BUILT) ## Test the page: crates/irbkin-page, its WebAssembly in Node, all of it in Chromium
	$(STEP) "Tests of crates/irbkin-page" cargo test --quiet -p irbkin-page
	@tests/page/test.sh $(abspath $(BIN)/python)

# With the flags of the wheel: the library names no folders of this machine.
capi: | toolchains ## Build the C library, install it with headers, pkg-config and CMake files: target/capi
	@$(EXTENSION_FLAGS) crates/irbkin-capi/install.sh

test-capi: capi ## Test the C interface: crates/irbkin-capi, C and C++ programs, in valgrind too
	$(STEP) "Tests of crates/irbkin-capi" cargo test --quiet -p irbkin-capi
	@tests/capi/test.sh

bench-capi: capi ## Compare the time of a pose in C with that in Rust
	@$(EXTENSION_FLAGS) cargo run --quiet --release -p irbkin-capi --example overhead -- target/capi/lib/libirbkin.so

# Lints and the extension are of different profiles: they compile at the same time.
check: | toolchains ## Check format, lints, types, stubs, docs, benches and examples
	@$(MAKE) --no-print-directory -j3 $(BUILT) $(VENV)/.groups lints
	$(STEP) "Rust documentation tests" env CARGO_PROFILE_DEV_OPT_LEVEL=0 CARGO_PROFILE_DEV_DEBUG=false CARGO_INCREMENTAL=0 \
		cargo test $(CRATES) -p irbkin-page --doc --features irbkin/serde
	$(STEP) "Rust documentation" env RUSTDOCFLAGS='-D warnings' cargo doc --no-deps $(CRATES) --features irbkin/serde
	$(STEP) "benches run" cargo test --bench one_pose --bench batch --bench instructions --bench microsecond -- --test
	$(STEP) "examples in Rust run" bash -eu -c 'for example in examples/*.rs; do cargo run --quiet --example "$$(basename "$$example" .rs)" >/dev/null; done'
	$(STEP) "benches in Python run" env QUICK=1 MOVES=1000 TRAJECTORIES=200 LINES=10 TARGETS=1000 CALLS=1 KEYS=3 OTHERS=3 \
		bash -eu -c 'for bench in $(BENCHES); do $(BIN)/python "benches/$$bench.py" >/dev/null; done'
	$(STEP) "the tails compile" cargo check --quiet --manifest-path benches/tails/Cargo.toml --target-dir target/tails
	$(STEP) "peers are compared" $(BIN)/python -m benches.peers --quick >/dev/null
	$(STEP) "peers are compared in brief" $(BIN)/python -m benches.peers --brief --quick >/dev/null
	$(BIN)/python tests/weight.py
	$(BIN)/python tests/names.py
	$(STEP) "licenses of the wheel" $(BIN)/python ship/thirdparty.py --check
	$(STEP) "workflows" $(BIN)/zizmor --quiet --offline --persona auditor --strict-collection .github
	$(BIN)/python ship/sbom.py --check
	$(BIN)/ruff check --quiet .
	$(BIN)/ruff format --check --quiet .
	$(STEP) "mypy" $(BIN)/mypy --no-error-summary
	$(STEP) "stubs" $(BIN)/python -m mypy.stubtest irbkin._core --concise --allowlist tests/python/stubtest_allow.txt
	$(STEP) "examples in Python run" bash -eu -c 'for example in examples/*.py; do $(BIN)/python "$$example" >/dev/null; done'

# One at a time: a peer without a wheel for this Python does not exclude the others.
$(PEERS)/.made: benches/peers/requirements.txt | toolchains
	@echo "Installing the peers into $(PEERS)"
	@$(PYTHON) -m venv --clear $(PEERS)
	@$(PEERS)/bin/pip install --quiet --disable-pip-version-check --upgrade 'pip>=25.1'
	@$(PEERS)/bin/pip install --quiet 'maturin>=1.9,<2' 'numpy>=1.23'
	@while read -r peer; do \
		$(PEERS)/bin/pip install --quiet "$$peer" </dev/null || echo "$$peer cannot be installed: left out"; \
	done <$<
	@touch $@

$(PEERS)/.irbkin-built: $(PEERS)/.made $(RUST_SOURCES) $(wildcard python/irbkin/*) pyproject.toml | toolchains
	@echo "Building irbkin's wheel for $(PEERS) (about a minute)"
	@rm -rf $(PEERS)/wheel
	@$(PEERS)/bin/maturin build --release --quiet --out $(PEERS)/wheel
	@$(PEERS)/bin/pip install --quiet --force-reinstall --no-deps $(PEERS)/wheel/irbkin-*.whl
	@touch $@

speed: | toolchains ## Criterion: every solution of a pose below 1 us; valgrind: no call by 3 % more instructions
	$(STEP) "every solution of a pose is below a microsecond" cargo bench --quiet --bench microsecond
	$(STEP) "instructions of single calls" $(PYTHON) benches/instructions.py --check

bench: speed $(PEERS)/.irbkin-built ## What is fast, against whom: ratios with bars, in two minutes once the peers are installed
	@$(PEERS)/bin/python -m benches.peers --brief $(if $(QUICK),--quick)

bench-peers: $(PEERS)/.irbkin-built ## Compare with other packages; WRITE=1 writes docs/evidence/benchmarks.md
	$(PEERS)/bin/python -m benches.peers $(if $(QUICK),--quick) $(if $(WRITE),--write)

# `evidence SUITE=hardsets` has its own numbers; that a seed is fixed is no law.
LAWS := laws:: recall:: certificates:: cell:: go:: --skip every_run_draws
soak: | toolchains ## Laws with other random numbers for SECONDS (600), on from the last seed; SEED=
	$(STEP) "Compile the Rust tests" $(SUITE) --quiet --release --no-run
	tests/seeds.sh soak $(or $(SECONDS),600) env IRBKIN_POSES=10000 PROPTEST_CASES=2000 \
		$(SUITE) --quiet --release -- $(LAWS)

fuzz: $(BUILT) $(VENV)/.groups ## INPUTS (20,000) broken files of each kind for every reader, for SECONDS as soak
	$(STEP) "Compile the Rust tests" $(SUITE) --quiet --release --no-run
	tests/seeds.sh fuzz $(or $(SECONDS),600) env IRBKIN_INPUTS=$(or $(INPUTS),20000) bash -euc ' \
		$(SUITE) --quiet --release -- rapid_fuzz::; \
		$(BIN)/python -m pytest --quiet -n 2 tests/python/test_*_fuzz.py -k broken'

# In a copy of the sources, which is built first.
mutants: | toolchains ## Change the solvers (FILES) in one place after another for SECONDS (1200): what no test sees
	$(call TOOL,cargo-mutants,27.1.0)
	@PATH=$(abspath target/tools/bin):$$PATH timeout --signal=INT $(or $(SECONDS),1200) \
		cargo mutants --shuffle --output target \
		--file '$(or $(FILES),src/kinematics/structure/**)' \
		--test-package irbkin,irbkin-tests --cargo-arg=--lib --cargo-arg=--tests -- \
		--include-ignored laws:: hard_sets:: reach_and_paths:: certificates:: follow:: structure:: solve:: || \
		case $$? in 2 | 3 | 124) ;; *) exit 1 ;; esac
	@cd target/mutants.out; echo "Seen: $$(wc -l <caught.txt). Not seen:"; cat missed.txt

evidence: | toolchains ## Run a suite of long tests or counts: SUITE=...
	@benches/evidence.sh $(SUITE)

docs: $(BUILT) $(VENV)/.groups $(VENV)/.site ## Write generated tables and transcripts, draw the pictures, build cargo doc and the site
	IRBKIN_WRITE=1 $(SUITE) --quiet -- catalog_page::
	IRBKIN_WRITE=1 $(BIN)/python -m pytest --quiet tests/python/test_documents.py -k "transcripts or notebook"
	for script in eight_solutions motion plans singularities peers free_motion stream; do $(BIN)/python docs/pictures/$$script.py; done
	RUSTDOCFLAGS="-D warnings" cargo doc --no-deps $(CRATES) --features irbkin/serde
	$(BIN)/python docs/site/build.py

site: $(BUILT) $(VENV)/.site ## Build the site of README, docs, arms and docstrings: target/site/html
	$(BIN)/python docs/site/build.py

wheel: $(VENV)/.made ## Build the wheel, check its size and paths, and try it
	rm -rf dist/venv dist/irbkin-*.whl target/wheel
	@$(SHIPPED) maturin build --release --quiet --out target/wheel
	@$(SHIPPED) ship/documented.sh target/wheel/irbkin-*.whl \
		maturin build --release --quiet --compression-level 9 --out dist
	$(BIN)/python tests/check_wheel.py dist/irbkin-*.whl
	$(PYTHON) -m venv dist/venv
	tests/retry.sh dist/venv/bin/pip install --quiet --disable-pip-version-check dist/irbkin-*.whl
	cd dist && venv/bin/python ../examples/01_solve_a_pose.py >/dev/null
	dist/venv/bin/irbkin ik "IRB 2600-12/1.65" --xyz 850 320 640 >/dev/null
	$(STEP) "the command by pip, uv and pipx" tests/install_command.sh dist/venv dist/irbkin-*.whl

$(VENV)/.ship: $(VENV)/.made pyproject.toml
	$(STEP) "Install what builds and checks a release into $(VENV)" $(PIP_INSTALL) --group ship
	@touch $@

# Where Debian packages cannot be had, a step is skipped with the reason; then the exit code is 77.
ship: $(VENV)/.ship ## Build sdist and wheels of TARGETS into dist, check them, print a table
	@$(SHIPPED) ship/ship.sh $(TARGETS)

test-platforms: $(VENV)/.ship ## Test under wine, under qemu aarch64 and on musl
	@$(SHIPPED) ship/each.sh ship/test_windows.sh ship/test_aarch64.sh ship/test_musl.sh

reproducible: $(VENV)/.ship ## Build sdist and wheel twice, in different folders: the same bytes
	@$(SHIPPED) ship/reproducible.sh

packages: $(VENV)/.made ## Build the crate and the sdist, and run their unpacked examples
	@tests/packages.sh $(abspath $(BIN))

thirdparty: | toolchains ## Write the licenses and the bill of materials of the crates in a wheel
	$(PYTHON) ship/thirdparty.py
	$(PYTHON) ship/sbom.py

# CHECKS="advisories" asks the database of advisories, which needs a network.
deny: | toolchains ## Check licenses and sources of all crates (deny.toml)
	@if $(call TOOL,cargo-deny,0.20.2); then \
		target/tools/bin/cargo-deny $(if $(CHECKS),,--offline) --workspace check $(or $(CHECKS),licenses bans sources); \
	else \
		echo "SKIPPED: licenses and sources of crates: cargo-deny cannot be compiled (the reason is above)"; \
	fi

semver: | toolchains ## Compare the Rust interface with the last tag
	@tag=$$(git describe --tags --abbrev=0 --match 'v[0-9]*' 2>/dev/null) || \
		{ echo "There is no tag v* yet: no interface to compare with"; exit 0; }; \
	$(call TOOL,cargo-semver-checks,0.51.0); \
	PATH=$$PWD/target/tools/bin:$$PATH cargo semver-checks --package irbkin --baseline-rev "$$tag" \
		--only-explicit-features --features std,urdf,serde

msrv: | toolchains ## Compile with the oldest Rust, rust-version in Cargo.toml
	@rustup toolchain list | grep -q '^$(MSRV)' || \
		{ echo "Rust $(MSRV) is missing: rustup toolchain install $(MSRV) --profile minimal"; exit 1; }
	$(STEP) "Compile with Rust $(MSRV)" rustup run $(MSRV) cargo check --quiet --locked --workspace
	$(STEP) "Compile with Rust $(MSRV), without std" rustup run $(MSRV) cargo check --quiet --locked -p irbkin-abb --lib $(NO_STD)

clean: ## Remove all build products
	rm -rf $(VENV) $(PEERS) .venv-ros2 target dist
