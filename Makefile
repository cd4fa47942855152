# The targets of irbkin. `make help` lists them. What takes more than two lines is in a script beside
# what it is about; PYTHON, VENV, PROFILE and what make is called with are in its environment.
# Of make's jobs rustc would look for a server that no recipe has, and warn.
export CARGO_MAKEFLAGS :=

export PYTHON ?= python3
export VENV := .venv
RUN := $(VENV)/bin/python
PEERS := .venv-peers
# Profile of the extension in .venv: develop, or release, which also serves the wheel.
export PROFILE ?= develop
BUILT := $(VENV)/.irbkin-$(PROFILE)
RUST_SOURCES := $(shell find src crates -name '*.rs' -o -name Cargo.toml) Cargo.toml
# Run a command under a name, and while it takes long print the seconds.
STEP := @tests/step.sh

.PHONY: $(shell sed -nE 's/^([a-z-]+):.*/\1/p' Makefile)

help: ## List the targets
	@grep -E '^[a-z-]+:.*## ' Makefile | sed -E 's/:.*## /\t/' | expand -t 16
	@echo; benches/evidence.sh

toolchains:
	@tests/toolchains.sh

$(VENV)/.made: | toolchains
	$(STEP) "Set up $(VENV)" tests/venv.sh
	@touch $@

# A dependency group of pyproject.toml.
$(VENV)/.group-%: $(VENV)/.made pyproject.toml
	$(STEP) "Install the packages of '$*' into $(VENV)" tests/venv.sh $*
	@touch $@

$(VENV)/.irbkin-%: $(VENV)/.made $(RUST_SOURCES) pyproject.toml | toolchains
	$(STEP) -q "Build irbkin into $(VENV) (three minutes on two cores)" ship/environment.sh maturin develop --profile $*
	@rm -f $(VENV)/.irbkin-* && touch $@

run: $(BUILT) ## Solve a pose of an IRB 2600 and show all solutions
	@$(RUN) examples/01_solve_a_pose.py
	@printf '\nnext: source $(VENV)/bin/activate; irbkin view "IRB 2600-12/1.65"; irbkin --help\n'

test: | toolchains ## Run the laws in Rust, and the tests in Python that need no extras
	@echo "Builds irbkin for development and runs its laws: about ten minutes on two cores."
	@$(MAKE) --no-print-directory $(BUILT) $(VENV)/.group-test
	@tests/laws.sh all

quick: $(VENV)/.quick-rust $(VENV)/.quick-python ## Test what changed since the last time, a tenth of the poses
$(VENV)/.quick-rust: $(BUILT) $(shell find tests -name '*.rs')
$(VENV)/.quick-python: $(BUILT) $(VENV)/.group-test $(shell find python tests/python -name '*.py')
$(VENV)/.quick-%:
	@tests/laws.sh quick-$*
	@touch $@

test-sets: | toolchains ## Run unit tests of kinematics, and the laws on each instruction set
	@tests/laws.sh sets

# Where everything can be installed, as in .ci/run, no test may be skipped.
test-oracles: $(BUILT) $(VENV)/.group-check ## Install extras and reference packages; run the tests that need them
	$(STEP) "Python tests with extras and references" $(RUN) -m pytest -n auto --dist worksteal -m extra --no-skips

# What cannot be installed is skipped, with the reason.
test-recipes: $(BUILT) $(VENV)/.group-check ## Install JAX, Polars, xarray, rerun; run the recipes
test-ros: $(BUILT) ## Install ROS 1 and ROS 2, build the workspace, check both nodes
test-page: $(BUILT) ## Test the page: crates/irbkin-page, its WebAssembly in Node, all of it in Chromium
test-capi: capi ## Test the C interface: crates/irbkin-capi, C and C++ programs, in valgrind too
test-recipes test-ros test-page test-capi: test-%:
	@tests/$*/test.sh

# What is of Rust alone has another profile than the extension: they compile at the same time.
check: | toolchains ## Check format, lints, types, stubs, docs, benches and examples
	@$(MAKE) --no-print-directory -j3 $(BUILT) $(VENV)/.group-check check-rust
	@tests/check.sh python

check-rust:
	@tests/check.sh rust

speed: | toolchains ## Criterion: every solution of a pose below 1 us; valgrind: no call by 3 % more instructions
	@benches/speed.sh

$(PEERS)/.irbkin: benches/peers/requirements.txt $(RUST_SOURCES) $(wildcard python/irbkin/*) pyproject.toml | toolchains
	@benches/peers/install.sh $(PEERS)

bench: speed $(PEERS)/.irbkin ## What is fast, against whom: ratios with bars, in two minutes once the peers are installed
	@$(PEERS)/bin/python -m benches.peers --brief $(if $(QUICK),--quick)

bench-peers: $(PEERS)/.irbkin ## Compare with other packages; WRITE=1 writes docs/evidence/benchmarks.md
	$(PEERS)/bin/python -m benches.peers $(if $(QUICK),--quick) $(if $(WRITE),--write)

bench-capi: capi ## Compare the time of a pose in C with that in Rust
	@ship/environment.sh cargo run --quiet --release -p irbkin-capi --example overhead -- target/capi/lib/libirbkin.so

evidence: | toolchains ## Run a suite of long tests or counts: SUITE=...
	@benches/evidence.sh $(SUITE)

soak: ## Laws with other random numbers for SECONDS (600), on from the last seed; SEED=
fuzz: $(BUILT) $(VENV)/.group-check ## INPUTS (20,000) broken files of each kind for every reader, for SECONDS as soak
soak fuzz: | toolchains
	@tests/seeds.sh $@ $(or $(SECONDS),600)

page: $(BUILT) $(VENV)/.group-pack ## Build the page, one HTML file with irbkin as WebAssembly: target/page/irbkin.html
	@crates/irbkin-page/page/wasm.sh
	$(RUN) crates/irbkin-page/page/pack.py

capi: | toolchains ## Build the C library, install it with headers, pkg-config and CMake files: target/capi
	@ship/environment.sh crates/irbkin-capi/install.sh

docs: $(BUILT) $(VENV)/.group-check $(VENV)/.group-site ## Write generated tables and transcripts, draw the pictures, build cargo doc and the site
	@docs/write.sh

site: $(BUILT) $(VENV)/.group-site ## Build the site of README, docs, arms and docstrings: target/site/html
	$(RUN) docs/site/build.py

# The files of a release, with what determines their bytes.
wheel: $(VENV)/.made ## Build the wheel, check its size and paths, and try it
packages: $(VENV)/.made ## Build the crate and the sdist, and run their unpacked examples
ship: $(VENV)/.group-ship ## Build sdist and wheels of TARGETS into dist, check them, print a table
test-platforms: $(VENV)/.group-ship ## Test under wine, under qemu aarch64 and on musl
reproducible: $(VENV)/.group-ship ## Build sdist and wheel twice, in different folders: the same bytes
wheel packages ship test-platforms reproducible:
	@ship/environment.sh ship/$(subst -,_,$@).sh

thirdparty: ## Write the licenses and the bill of materials of the crates in a wheel
deny: ## Check licenses and sources of all crates (deny.toml)
semver: ## Compare the Rust interface with the last tag
msrv: ## Compile with the oldest Rust, rust-version in Cargo.toml
mutants: ## Change the solvers (FILES) in one place after another for SECONDS (1200): what no test sees
thirdparty deny semver msrv mutants: | toolchains
	@ship/crates.sh $@ $(SECONDS)
