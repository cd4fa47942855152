#!/usr/bin/env bash
# Compares include/irbkin.h with what cbindgen makes of the source, or writes it:
# crates/irbkin-capi/header.sh [--write]. Exit code 77 where cbindgen cannot be had, with the reason.
set -euo pipefail
cd "$(dirname "$0")/../.."
# Other versions write other spaces.
version=0.29
folder=$PWD/target/cbindgen

# The path of a cbindgen of this version, if there is one.
fitting() {
    for path in "$(command -v cbindgen || true)" "$folder"/{usr/bin,bin}/cbindgen; do
        if [ -x "$path" ] && [[ $("$path" --version 2>/dev/null) == "cbindgen $version".* ]]; then
            echo "$path"
            return
        fi
    done
}

if [ -z "$(fitting)" ] && command -v apt-get >/dev/null && command -v dpkg >/dev/null; then
    mkdir -p "$folder"
    (cd "$folder" && apt-get download -qq cbindgen-web && dpkg -x cbindgen-web_*.deb .) >&2 || true
fi
if [ -z "$(fitting)" ]; then
    tests/step.sh "Build cbindgen" \
        cargo install --quiet --locked --root "$folder" cbindgen --version "~$version" >&2 || true
fi
cbindgen=$(fitting)
if [ -z "$cbindgen" ]; then
    echo "cbindgen $version is not installed, no package of this Debian, and cannot be built" >&2
    exit 77
fi

header=crates/irbkin-capi/include/irbkin.h
made=$(mktemp)
trap 'rm -f "$made"' EXIT
(cd crates/irbkin-capi && "$cbindgen" --quiet --config cbindgen.toml --crate irbkin-capi .) >"$made"
# Its last line has no end.
echo >>"$made"
if [ "${1:-}" = --write ]; then
    cp "$made" "$header"
elif ! diff -u "$header" "$made"; then
    echo "$header is not of this source: run crates/irbkin-capi/header.sh --write" >&2
    exit 1
fi
