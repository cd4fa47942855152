#!/usr/bin/env bash
# Unpacks a compiler for WebAssembly into target/wasm-toolchain, about 100 MB of Debian packages:
# page/toolchain.sh. Nothing is installed, and root is not needed. Exit code 77 where the packages
# cannot be had, with the reason.
#
# rustc-web and its sources are of one version, so that std can be built for wasm32: an installed
# toolchain without the target and without rust-src does not serve.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$PWD/target/wasm-toolchain

skip() {
    echo "The WebAssembly toolchain: $1" >&2
    exit 77
}

command -v apt-get >/dev/null && command -v dpkg >/dev/null ||
    skip "it comes from Debian's packages, and there is no apt-get or no dpkg"
rm -rf "$folder.part"
mkdir -p "$folder.part/lists/partial" "$folder.part/packages"
cd "$folder.part/packages"
# Lists of its own: those of the system may be old, and only root may renew them. _apt, to which root
# changes for downloads, may not write here.
apt=(-o "Dir::State::Lists=$folder.part/lists" -o "Dir::Cache::pkgcache=" -o "Dir::Cache::srcpkgcache="
    -o "APT::Sandbox::User=$(id -un)" -qq)
retry=$OLDPWD/tests/retry.sh
"$retry" apt-get "${apt[@]}" update || skip "apt-get update failed"

# The names that a package depends on and that begin with $2.
depends() {
    apt-cache "${apt[@]}" depends "$1" 2>/dev/null | sed -nE "s/^ *Depends: ($2.*)/\1/p"
}
std=$(depends libstd-rust-web-dev libstd-rust-web-)
llvm=$(depends "${std:-none}" libllvm)
[ -n "$std" ] && [ -n "$llvm" ] || skip "this Debian has no rustc-web"
packages=(rustc-web rust-web-src libstd-rust-web-dev "$std" "$llvm" "lld-${llvm#libllvm}")
# Libraries of LLVM that not every system has.
packages+=($(depends "$llvm" 'lib(z3|edit|xml)'))
"$retry" apt-get "${apt[@]}" download "${packages[@]}" ||
    skip "these packages cannot be downloaded: ${packages[*]}"
for package in *.deb; do
    dpkg -x "$package" "$folder.part"
done
cd "$folder.part"
rm -rf packages lists
# One name for linker and libraries, whatever the version.
ln -s "usr/lib/llvm-${llvm#libllvm}/bin/wasm-ld" wasm-ld
export LD_LIBRARY_PATH=$PWD/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || echo x86_64-linux-gnu)
usr/bin/rustc --version && ./wasm-ld --version || skip "the unpacked compiler does not start"
rm -rf "$folder"
mv "$folder.part" "$folder"
