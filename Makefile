# The targets of irbkin. `make help` lists them.
SHELL := bash
.SHELLFLAGS := -eu -o pipefail -c
.DELETE_ON_ERROR:

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
RUST_SOURCES := $(shell find src -name '*.rs') Cargo.toml
BUILT := $(VENV)/.irbkin-built
PEERS := .venv-peers
NO_STD := --no-default-features --features libm
# A recipe for each instruction set of this processor; ends with `; done`. The shell's -e stops at
# the first that fails. The widest set is the default.
ON_EACH_SET := sets=$$(cargo run --quiet --example instruction_sets); \
	for set in $$sets; do export IRBKIN_INSTRUCTION_SET=$$set;
ON_EACH_NARROWER_SET := \
	sets=$$($(BIN)/python -c 'from irbkin import _core; print(*_core.instruction_sets()[:-1])'); \
	for set in $$sets; do export IRBKIN_INSTRUCTION_SET=$$set;
# Run a command under a name; if it takes long, print the name and the seconds.
STEP := @tests/step.sh
# A download that breaks off is no reason to fail.
PIP_INSTALL := tests/retry.sh $(BIN)/pip install --quiet --disable-pip-version-check
SKIPPED := target/skipped.txt
# Panic messages name source files: without the folders of this machine, and those of the toolchain
# as in a toolchain without its sources. The compiler adds no path of this crate: its are relative.
REMAPPED = --remap-path-prefix=$${CARGO_HOME:-$$HOME/.cargo}/registry/src/= \
	--remap-path-prefix=$$(rustc --print sysroot)/lib/rustlib/src/rust=/rustc
# The same flags for the environment and for the wheel: one build serves both.
EXTENSION_FLAGS = RUSTFLAGS="$${RUSTFLAGS:-} $(REMAPPED)"

.PHONY: help run test test-recipes test-ros ros-starts check stubs catalog bench bench-peers instructions stages ulp million general offset-wrists plans configurations hardsets fuzz wheel packages clean toolchains

help: ## List the targets
	@grep -E '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 18

toolchains:
	@command -v cargo >/dev/null || { echo "cargo is missing: install a Rust toolchain (1.89 or newer), https://rustup.rs"; exit 1; }
	@command -v $(PYTHON) >/dev/null || { echo "$(PYTHON) is missing: install Python 3.10 or newer, or set PYTHON="; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10))' || { echo "$(PYTHON) is older than 3.10: set PYTHON="; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' || { echo "$(PYTHON) has no venv: install it (Debian: python3-venv)"; exit 1; }

$(VENV)/.made: | toolchains
	$(STEP) "Set up $(VENV)" $(PYTHON) -m venv $(VENV)
	@$(PIP_INSTALL) --upgrade 'pip>=25.1'
	@$(PIP_INSTALL) 'maturin>=1.9,<2' 'numpy>=1.23'
	@touch $@

$(BUILT): $(VENV)/.made $(RUST_SOURCES) pyproject.toml | toolchains
	$(STEP) "Build irbkin into $(VENV) (about a minute)" env VIRTUAL_ENV=$(abspath $(VENV)) $(EXTENSION_FLAGS) \
		bash -c '$(BIN)/maturin develop --release >$(VENV)/build.log 2>&1 || { cat $(VENV)/build.log; exit 1; }'
	@touch $@

$(VENV)/.groups: $(VENV)/.made pyproject.toml
	$(STEP) "Install test tools and reference packages into $(VENV)" $(PIP_INSTALL) --group test --group check
	@touch $@

run: $(BUILT) ## Solve a pose of an IRB 2600 and show all solutions
	@$(BIN)/python examples/01_solve_a_pose.py

test: $(BUILT) $(VENV)/.groups ## Run all tests, in Rust and Python
	@mkdir -p target && rm -f $(SKIPPED)
	$(STEP) "Compile the Rust tests" cargo test --lib --tests --no-run
	$(STEP) "Rust tests" env IRBKIN_SKIPPED=$(abspath $(SKIPPED)) cargo test --lib --tests
	$(STEP) "Rust documentation tests" cargo test --doc
	@$(ON_EACH_NARROWER_SET) tests/step.sh "Laws on $$set" cargo test --test suite -- laws:: recall:: hard_sets:: reach_and_paths::; done
	$(STEP) "Compile without std" cargo test $(NO_STD),rapid --lib --test suite --no-run
	$(STEP) "Rust unit tests without std" cargo test $(NO_STD),rapid --lib
	$(STEP) "Laws without std" cargo test $(NO_STD),rapid --test suite -- laws:: coupled:: configuration:: allocation:: rapid:: rapid_calc::
	@if [ -e $(SKIPPED) ]; then sort $(SKIPPED); fi; echo "Skipped in Rust: $$(cat $(SKIPPED) 2>/dev/null | wc -l)"
	$(STEP) "Python tests" $(BIN)/python -m pytest

test-recipes: $(BUILT) $(VENV)/.groups ## Install JAX, Polars and xarray, run docs/recipes.md
	@if tests/step.sh "Install what docs/recipes.md needs" $(PIP_INSTALL) --group recipes; then \
		tests/step.sh "Recipes" $(BIN)/python -m pytest --quiet tests/python/test_documents.py -k recipes; \
	else \
		echo "SKIPPED: docs/recipes.md was not run: its packages cannot be installed (the reason is above)"; \
	fi

# In a ROS of its own each; only where one cannot be installed it is skipped, with the reason.
test-ros: $(BUILT) ## Install ROS 1 and ROS 2, build the workspace, check both nodes
	@tests/ros/test.sh $(abspath $(BIN)/python)

ros-starts: $(BUILT) ## End COUNT (200) nodes of each ROS with SIGTERM: none may hang
	@tests/ros/test.sh --starts $(or $(COUNT),200) $(abspath $(BIN)/python)

check: $(BUILT) $(VENV)/.groups ## Check format, lints, types, stubs, docs, benches and examples
	cargo fmt --check
	$(STEP) "clippy" cargo clippy --all-targets -- -D warnings
	$(STEP) "clippy with serde" cargo clippy --lib --features serde -- -D warnings
	$(STEP) "clippy with python" cargo clippy --lib --features python -- -D warnings
	$(STEP) "clippy without std" cargo clippy --lib $(NO_STD) -- -D warnings
	$(STEP) "clippy without std, with rapid" cargo clippy --lib $(NO_STD),rapid -- -D warnings
	$(STEP) "clippy without rapid" cargo clippy --all-targets --no-default-features --features std,urdf -- -D warnings
	$(STEP) "Rust documentation" env RUSTDOCFLAGS='-D warnings' cargo doc --no-deps --features serde
	$(STEP) "benches run" cargo test --bench one_pose --bench batch --bench instructions -- --test
	$(STEP) "examples in Rust run" bash -eu -c 'for example in examples/*.rs; do cargo run --quiet --example "$$(basename "$$example" .rs)" >/dev/null; done'
	$(STEP) "benches in Python run" $(BIN)/python benches/python_calls.py >/dev/null
	$(STEP) "the bench of structured poses runs" env QUICK=1 $(BIN)/python benches/structured_poses.py >/dev/null
	$(STEP) "the bench of motion runs" env MOVES=1000 $(BIN)/python benches/motion.py >/dev/null
	$(STEP) "the bench of limits runs" env TRAJECTORIES=200 LINES=10 $(BIN)/python benches/motion_limits.py >/dev/null
	$(STEP) "the bench of plans runs" env QUICK=1 $(BIN)/python benches/plan.py >/dev/null
	$(STEP) "the bench of maps runs" env QUICK=1 $(BIN)/python benches/reach_map.py >/dev/null
	$(STEP) "the bench of a module runs" env TARGETS=1000 $(BIN)/python benches/rapid_module.py >/dev/null
	$(STEP) "the bench of a check runs" env MOVES=1000 $(BIN)/python benches/rapid_check.py >/dev/null
	$(STEP) "the bench of the command runs" env CALLS=1 $(BIN)/python benches/command.py >/dev/null
	$(STEP) "peers are compared" $(BIN)/python -m benches.peers --quick >/dev/null
	$(STEP) "instructions are counted" env CARGO_PROFILE_BENCH_LTO=off CARGO_PROFILE_BENCH_CODEGEN_UNITS=16 \
		$(BIN)/python benches/instructions.py >/dev/null
	$(BIN)/ruff check --quiet .
	$(BIN)/ruff format --check --quiet .
	$(STEP) "mypy" $(BIN)/mypy --no-error-summary
	$(STEP) "stubs" $(BIN)/python -m mypy.stubtest irbkin --concise --allowlist tests/python/stubtest_allow.txt
	$(STEP) "examples in Python run" bash -eu -c 'for example in examples/*.py; do $(BIN)/python "$$example" >/dev/null; done'

bench: $(BUILT) ## Time single poses, batches, Python's calls and a RAPID module
	cargo bench --bench one_pose --bench batch
	$(BIN)/python benches/python_calls.py
	$(BIN)/python benches/structured_poses.py
	$(BIN)/python benches/motion.py
	$(BIN)/python benches/motion_limits.py
	$(BIN)/python benches/plan.py
	$(BIN)/python benches/reach_map.py
	$(BIN)/python benches/rapid_module.py
	$(BIN)/python benches/rapid_check.py
	$(BIN)/python benches/command.py

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

bench-peers: $(PEERS)/.irbkin-built ## Compare with other packages; WRITE=1 writes docs/benchmarks.md
	$(PEERS)/bin/python -m benches.peers $(if $(QUICK),--quick) $(if $(WRITE),--write)

instructions: | toolchains ## Count instructions with valgrind; WRITE=1 records them
	@$(PYTHON) benches/instructions.py $(if $(WRITE),--write)

stages: | toolchains ## Show the time of a pose by stages, with perf; SETS="avx2 avx512"
	@$(PYTHON) benches/stages.py $(SETS)

ulp: | toolchains ## Compare arc tangent, sine and cosine with correctly rounded ones
	IRBKIN_POINTS=10000000 cargo test --quiet --release --lib lanes::functions -- --nocapture --test-threads=1

offset-wrists: | toolchains ## Count what is found of arms with an offset wrist; JOINT_VECTORS (1000) of each set
	JOINT_VECTORS=$(or $(JOINT_VECTORS),1000) cargo test --release --lib offset_wrist::tests::each_arm -- --nocapture

million: | toolchains ## Solve a million poses of each arm; count missed and incorrect ones
	$(ON_EACH_SET) IRBKIN_POSES=1000000 cargo test --quiet --release --test suite -- recall:: --nocapture --test-threads=1; done

plans: $(BUILT) $(VENV)/.groups ## Plan 100,000 random lines, halve each step of each plan
	IRBKIN_PLANS=50000 $(BIN)/python -m pytest --quiet -s -k hides_a_jump tests/python/test_plan.py

general: | toolchains ## Solve POSES (20,000) poses of 20 arms without a closed form; count what is lost
	IRBKIN_POSES=$(or $(POSES),20000) cargo test --quiet --release --test suite -- recall::general recall::offset_wrist --nocapture --test-threads=1
	IRBKIN_POSES=$(or $(POSES),20000) cargo test --quiet --release --lib structure::general -- --nocapture --test-threads=1

configurations: | toolchains ## Check confdata at 100,000 poses of every ABB arm
	IRBKIN_POSES=100000 cargo test --quiet --release --test suite -- configuration:: --nocapture --test-threads=1

hardsets: | toolchains ## Solve poses and follow paths at and near every singularity
	$(ON_EACH_SET) IRBKIN_POSES=2000 cargo test --quiet --release --test suite -- hard_sets:: follow:: --nocapture --test-threads=1; done
	$(ON_EACH_SET) IRBKIN_POSES=200 cargo test --quiet --release --test suite -- reach_and_paths:: --nocapture --test-threads=1; done
	IRBKIN_POSES=1000 cargo test --quiet --release --lib spherical_shoulder -- --nocapture --test-threads=1
	IRBKIN_POSES=20 cargo test --quiet --release --test suite -- redundancy:: nearest:: --nocapture --test-threads=1

stubs: $(BUILT) ## Write the docstrings of the type stubs from those of the extension
	$(BIN)/python tests/python/stub_docs.py

catalog: | toolchains ## Write the tables of docs/catalog.md
	IRBKIN_WRITE=1 cargo test --quiet --test suite -- catalog_page::

fuzz: | toolchains ## Read four million invalid RAPID texts: no panic, linear time
	IRBKIN_INPUTS=1000000 cargo test --quiet --release --test suite -- rapid_fuzz:: --nocapture --test-threads=1

wheel: $(VENV)/.made ## Build the wheel, check its size and paths, and try it
	rm -rf dist/venv dist/irbkin-*.whl
	$(EXTENSION_FLAGS) $(BIN)/maturin build --release --quiet \
		--compression-level 9 --out dist
	$(BIN)/python tests/check_wheel.py dist/irbkin-*.whl
	$(PYTHON) -m venv dist/venv
	tests/retry.sh dist/venv/bin/pip install --quiet --disable-pip-version-check dist/irbkin-*.whl
	cd dist && venv/bin/python ../examples/01_solve_a_pose.py >/dev/null
	dist/venv/bin/irbkin ik "IRB 2600-12/1.65" --xyz 850 320 640 >/dev/null

packages: $(VENV)/.made ## Build the crate and the sdist, and run their unpacked examples
	@tests/packages.sh $(abspath $(BIN))

clean: ## Remove all build products
	rm -rf $(VENV) $(PEERS) .venv-ros2 target dist
