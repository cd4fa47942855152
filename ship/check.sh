#!/usr/bin/env bash
# Checks the files of a release in dist: ship/check.sh. ship/table.py shows what ran on each.
set -euo pipefail
mkdir -p target/ship

# Run a command; its output appears if it fails.
quietly() {
    local output
    output=$("$@" 2>&1) || fail "$*"$'\n'"$output"
}

fail() {
    echo "FAILED: $1" >&2
    exit 1
}

# A wheel in which no extension is found has no violation either.
abi3() {
    abi3audit --strict --report "$1" | grep -q '"is_abi3": true' || fail "abi3audit of $1"
}

# The C library of the wheel's tag serves.
glibc() {
    local shown
    shown=$(auditwheel show "$1")
    [[ $(tr -s '\n ' ' ' <<<"$shown") == *'platform tag: "manylinux_2_17_'* ]] || fail "auditwheel: $shown"
}

# auditwheel cannot read this wheel where the C library is glibc.
musl() {
    local needed
    python -m zipfile -e "$1" target/ship/musl
    needed=$(readelf -d target/ship/musl/irbkin/_core.abi3.so | sed -nE 's/.*\(NEEDED\).*\[(.*)\]/\1/p')
    [ "$needed" = libc.so ] || fail "$1 needs $needed, not libc.so alone"
}

for file in dist/*.whl dist/*.tar.gz; do
    quietly twine check --strict "$file"
    ran=twine
    if [[ $file == *.whl ]]; then
        quietly python tests/check_wheel.py "$file"
        quietly check-wheel-contents "$file"
        abi3 "$file"
        ran+=", check_wheel, check-wheel-contents, abi3audit"
    fi
    case $file in
        *manylinux*) glibc "$file" && ran+=", auditwheel" ;;
        *musllinux*) musl "$file" && ran+=", needs libc.so alone" ;;
    esac
    ship/ran.sh "$file" "$ran"
done
