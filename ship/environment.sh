#!/usr/bin/env bash
# Runs a command with the tools of VENV and with what determines the bytes of a release:
# ship/environment.sh COMMAND... The extension in VENV and the wheel have the same flags: one build
# serves both. The C library, too, names no folders of this machine.
set -euo pipefail
cd "$(dirname "$0")/.."
VENV=${VENV:-.venv}
[[ $VENV = /* ]] || VENV=$PWD/$VENV
export VENV VIRTUAL_ENV=$VENV PATH=$VENV/bin:$PATH

# Panic messages name source files: without the folders of this machine, and those of the toolchain
# as in a toolchain without its sources. The compiler adds no path of this crate: its are relative.
RUSTFLAGS="${RUSTFLAGS:-} --remap-path-prefix=${CARGO_HOME:-$HOME/.cargo}/registry/src/="
RUSTFLAGS+=" --remap-path-prefix=$(rustc --print sysroot)/lib/rustlib/src/rust=/rustc"

# A generic function is compiled in the first crate that uses it, not in each: 13 % of the wheel. The
# flag asks for leave.
export RUSTC_BOOTSTRAP=1
RUSTFLAGS+=" -Zshare-generics=y"
export RUSTFLAGS

# Files have the time of the commit: two builds have the same bytes.
if time=$(git log -1 --format=%ct 2>/dev/null); then
    export SOURCE_DATE_EPOCH=$time
fi
exec "$@"
