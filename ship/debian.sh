# Debian packages in folders of their own, to be sourced: nothing is installed, and root is not
# needed. Everything is below target/debian.
# shellcheck shell=bash

# Leave with the exit code of skipped tests, and say why.
skip() {
    echo "SKIPPED: $1" >&2
    exit 77
}

# Fetch the lists of the packages of an architecture: the system's may be old, and only root
# may renew them. The other functions use them.
fetch_lists() {
    command -v apt-get >/dev/null && command -v dpkg >/dev/null ||
        skip "it takes Debian packages, and there is no apt-get or no dpkg"
    local folder=$PWD/target/debian/$1
    mkdir -p "$folder/lists/partial"
    # _apt, to which root changes for downloads, may not write here. Nothing counts as installed.
    apt=(-o "APT::Architecture=$1" -o "Dir::State::Lists=$folder/lists" -o "Dir::State::status=/dev/null"
        -o "Dir::Cache::pkgcache=" -o "Dir::Cache::srcpkgcache=" -o "APT::Sandbox::User=$(id -un)" -qq)
    tests/retry.sh apt-get "${apt[@]}" update || skip "apt-get update failed"
}

# The names that a package depends on and that begin with $2.
depends() {
    apt-cache "${apt[@]}" depends "$1" 2>/dev/null | sed -nE "s/^ *Depends: ($2.*)/\1/p"
}

# Packages and all that they depend on.
with_dependencies() {
    apt-get "${apt[@]}" -o APT::Install-Recommends=false --simulate install "$@" | awk '/^Inst/ { print $2 }'
}

# Unpack packages into a folder.
unpack() {
    local folder=$1 packages retry=$PWD/tests/retry.sh
    shift
    packages=$(mktemp -d -p "$PWD/target/debian")
    (cd "$packages" && "$retry" apt-get "${apt[@]}" download "$@") ||
        skip "these packages cannot be downloaded: $*"
    mkdir -p "$folder"
    for package in "$packages"/*.deb; do
        dpkg -x "$package" "$folder"
    done
    rm -r "$packages"
}
