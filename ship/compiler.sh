#!/usr/bin/env bash
# Unpacks a compiler for other platforms, with the sources of its standard library, into
# target/compiler, about 100 MB of Debian packages: ship/compiler.sh. Exit code 77 where they cannot
# be had, with the reason.
#
# rustc-web and its sources are of one version, so that std can be built for any target. An
# installed toolchain without the target and without rust-src does not serve.
set -euo pipefail
cd "$(dirname "$0")/.."
. ship/debian.sh
folder=$PWD/target/compiler
fetch_lists "$(dpkg --print-architecture 2>/dev/null || echo amd64)"
std=$(depends libstd-rust-web-dev libstd-rust-web-)
llvm=$(depends "${std:-none}" libllvm)
[ -n "$std" ] && [ -n "$llvm" ] || skip "this Debian has no rustc-web"
rm -rf "$folder.part"
# And the libraries of LLVM that not every system has.
# shellcheck disable=SC2046
unpack "$folder.part" rustc-web rust-web-src libstd-rust-web-dev "$std" "$llvm" "lld-${llvm#libllvm}" \
    $(depends "$llvm" 'lib(z3|edit|xml)')
cd "$folder.part"
# One name for linker and libraries, whatever the version.
ln -s "usr/lib/llvm-${llvm#libllvm}/bin/wasm-ld" wasm-ld
# For Windows it names two libraries of gcc whose functions are in zig's own.
mkdir empty
for library in ssp ssp_nonshared; do printf '!<arch>\n' >empty/lib$library.a; done
export LD_LIBRARY_PATH=$PWD/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || echo x86_64-linux-gnu)
usr/bin/rustc --version && ./wasm-ld --version || skip "the unpacked compiler does not start"
rm -rf "$folder"
mv "$folder.part" "$folder"
