# irbkin's one gate. `make help` lists what there is.
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
# A recipe for each instruction set of this processor; ends with `; done`. The shell's -e stops at the first that fails.
ON_EACH_SET := sets=$$(cargo run --quiet --example instruction_sets); for set in $$sets; do export IRBKIN_INSTRUCTION_SET=$$set;

.PHONY: help run test check catalogue bench bench-peers instructions stages ulp million configurations hardsets fuzz wheel clean toolchains

help: ## List the targets
	@grep -E '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 14

toolchains:
	@command -v cargo >/dev/null || { echo "cargo is missing: install a Rust toolchain (1.89 or newer), https://rustup.rs"; exit 1; }
	@command -v $(PYTHON) >/dev/null || { echo "$(PYTHON) is missing: install Python 3.10 or newer, or set PYTHON="; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10))' || { echo "$(PYTHON) is older than 3.10: set PYTHON="; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' || { echo "$(PYTHON) has no venv: install it (Debian: python3-venv)"; exit 1; }

$(VENV)/.made: | toolchains
	@echo "Setting up $(VENV)"
	@$(PYTHON) -m venv $(VENV)
	@$(BIN)/pip install --quiet --disable-pip-version-check --upgrade 'pip>=25.1'
	@$(BIN)/pip install --quiet 'maturin>=1.9,<2' 'numpy>=1.23'
	@touch $@

$(BUILT): $(VENV)/.made $(RUST_SOURCES) pyproject.toml | toolchains
	@echo "Building irbkin into $(VENV) (about a minute)"
	@VIRTUAL_ENV=$(abspath $(VENV)) $(BIN)/maturin develop --release >$(VENV)/build.log 2>&1 || { cat $(VENV)/build.log; exit 1; }
	@touch $@

$(VENV)/.groups: $(VENV)/.made pyproject.toml
	@echo "Installing the tests' tools and oracles into $(VENV)"
	@$(BIN)/pip install --quiet --group test --group check
	@touch $@

run: $(BUILT) ## Solve a real IRB 2600 pose and show every solution
	@$(BIN)/python examples/01_solve_a_pose.py

test: $(BUILT) $(VENV)/.groups ## Run all tests, Rust's and Python's
	cargo test --quiet
	$(ON_EACH_SET) cargo test --quiet --test laws --test laws_three_parallel --test recall --test hardsets --test hardsets_three_parallel --test reach_and_paths; done
	cargo test --quiet $(NO_STD),rapid --lib --test rapid --test rapid_calc
	cargo test --quiet $(NO_STD) --lib --test laws --test laws_three_parallel --test coupled --test configuration --test allocation
	$(BIN)/python -m pytest --quiet

check: $(BUILT) $(VENV)/.groups ## Format, lints for each feature set, types, stubs, docs, benches that run
	cargo fmt --check
	cargo clippy --quiet --all-targets -- -D warnings
	cargo clippy --quiet --all-targets --features serde -- -D warnings
	cargo clippy --quiet --lib --features python -- -D warnings
	cargo clippy --quiet --lib $(NO_STD) -- -D warnings
	cargo clippy --quiet --lib $(NO_STD),rapid -- -D warnings
	cargo clippy --quiet --all-targets --no-default-features --features std,urdf -- -D warnings
	RUSTDOCFLAGS='-D warnings' cargo doc --quiet --no-deps --features serde
	cargo bench --quiet --bench one_pose --bench batch --bench instructions -- --test
	$(BIN)/python benches/python_calls.py >/dev/null
	TARGETS=1000 $(BIN)/python benches/rapid_module.py >/dev/null
	$(BIN)/python -m benches.peers --quick >/dev/null
	$(BIN)/python benches/instructions.py >/dev/null
	for example in examples/*.rs; do cargo run --quiet --release --example "$$(basename "$$example" .rs)" >/dev/null; done
	$(BIN)/ruff check --quiet .
	$(BIN)/ruff format --check --quiet .
	$(BIN)/mypy --no-error-summary
	$(BIN)/python -m mypy.stubtest irbkin --concise
	for example in examples/*.py; do $(BIN)/python "$$example" >/dev/null; done

bench: $(BUILT) ## Time one pose and batches in Rust on each instruction set, Python's calls and a RAPID module against yardsticks
	cargo bench --bench one_pose --bench batch
	$(BIN)/python benches/python_calls.py
	$(BIN)/python benches/rapid_module.py

# One at a time: a peer that has no wheel for this Python does not keep the others out.
$(PEERS)/.made: benches/peers/requirements.txt | toolchains
	@echo "Installing the peers into $(PEERS)"
	@$(PYTHON) -m venv --clear $(PEERS)
	@$(PEERS)/bin/pip install --quiet --disable-pip-version-check --upgrade 'pip>=25.1'
	@$(PEERS)/bin/pip install --quiet 'maturin>=1.9,<2' 'numpy>=1.23'
	@while read -r peer; do \
		$(PEERS)/bin/pip install --quiet "$$peer" </dev/null || echo "$$peer does not install: left out"; \
	done <$<
	@touch $@

$(PEERS)/.irbkin-built: $(PEERS)/.made $(RUST_SOURCES) $(wildcard python/irbkin/*) pyproject.toml | toolchains
	@echo "Building irbkin's wheel for $(PEERS) (about a minute)"
	@rm -rf $(PEERS)/wheel
	@$(PEERS)/bin/maturin build --release --quiet --out $(PEERS)/wheel
	@$(PEERS)/bin/pip install --quiet --force-reinstall --no-deps $(PEERS)/wheel/irbkin-*.whl
	@touch $@

bench-peers: $(PEERS)/.irbkin-built ## Compare with other packages: solutions lost, times; WRITE=1 writes docs/benchmarks.md
	$(PEERS)/bin/python -m benches.peers $(if $(QUICK),--quick) $(if $(WRITE),--write)

instructions: | toolchains ## Count a call's instructions with valgrind, against benches/instructions.md; WRITE=1 records them there
	@$(PYTHON) benches/instructions.py $(if $(WRITE),--write)

stages: | toolchains ## Show where the time of a pose goes, by stages, with Linux's perf; SETS="avx2 avx512" chooses
	@$(PYTHON) benches/stages.py $(SETS)

ulp: | toolchains ## Hold the lanes' arc tangent, sine and cosine against correctly rounded ones, at ten million points
	IRBKIN_POINTS=10000000 cargo test --quiet --release --lib lanes::functions -- --nocapture --test-threads=1

million: | toolchains ## Solve a million random poses of each of fourteen arms on each instruction set; count what is lost, wrong or twice
	$(ON_EACH_SET) IRBKIN_POSES=1000000 cargo test --quiet --release --test recall -- --nocapture --test-threads=1; done

configurations: | toolchains ## Hold a hundred thousand poses of every ABB arm against the rules of its confdata
	IRBKIN_POSES=100000 cargo test --quiet --release --test configuration -- --nocapture --test-threads=1

hardsets: | toolchains ## Solve poses at and next to every singularity, pairs and triples of them, and follow paths through
	$(ON_EACH_SET) IRBKIN_POSES=2000 cargo test --quiet --release --test hardsets --test hardsets_three_parallel --test reach_and_paths --test follow -- --nocapture --test-threads=1; done
	IRBKIN_POSES=200000 cargo test --quiet --release --lib spherical_shoulder -- --nocapture --test-threads=1
	IRBKIN_POSES=20 cargo test --quiet --release --test redundancy -- --nocapture --test-threads=1

catalogue: | toolchains ## Write the tables of docs/catalogue.md from the catalogue
	IRBKIN_WRITE=1 cargo test --quiet --test catalogue_page

fuzz: | toolchains ## Read millions of broken RAPID texts: none panics, what is read is written and read again, in linear time
	IRBKIN_INPUTS=1000000 cargo test --quiet --release --test rapid_fuzz -- --nocapture --test-threads=1

wheel: $(VENV)/.made ## Build the wheel and try it in an environment of its own
	$(BIN)/maturin build --release --quiet --out dist
	rm -rf dist/venv && $(PYTHON) -m venv dist/venv
	dist/venv/bin/pip install --quiet --disable-pip-version-check dist/irbkin-*.whl
	cd dist && venv/bin/python ../examples/01_solve_a_pose.py >/dev/null
	ls -l dist/*.whl

clean: ## Remove what was built
	rm -rf $(VENV) $(PEERS) target dist
