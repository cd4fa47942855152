#!/usr/bin/env bash
# Runs cargo or maturin with the compiler for other platforms: ship/cross.sh COMMAND... The command
# gets `-Zbuild-std=std,panic_unwind`: this compiler has no compiled standard library of a platform.
# Exit code 77 where the compiler cannot be had, with the reason.
set -euo pipefail
compiler=$(cd "$(dirname "$0")/.." && pwd)/target/compiler
[ -d "$compiler" ] ||
    "${0%/*}/../tests/step.sh" "Download a compiler for other platforms (about 100 MB)" "${0%/*}/compiler.sh"
libraries=("$compiler"/usr/lib/*-linux-gnu)
export LD_LIBRARY_PATH=${libraries[0]} RUSTC_BOOTSTRAP=1 RUSTC=$compiler/usr/bin/rustc
export RUSTFLAGS="${RUSTFLAGS:-} -Lnative=$compiler/empty --remap-path-prefix=$compiler/usr/lib/rustlib/src/rust=/rustc"
exec "$@"
