#!/usr/bin/env bash
# Builds sdist and wheel of the last commit twice, in clones of different depth and with two cargo
# homes, and compares them byte by byte: ship/environment.sh ship/reproducible.sh
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
home=${CARGO_HOME:-$HOME/.cargo}
commit=$(git rev-parse HEAD)
for clone in "$folder/one" "$folder/two/is/deeper"; do
    git clone --quiet . "$clone"
    git -C "$clone" checkout --quiet --detach "$commit"
    # A home of its own for the unpacked crates; the archives are the normal one's.
    mkdir -p "$clone.cargo/registry"
    ln -s "$home"/registry/{cache,index} "$clone.cargo/registry/"
    for config in "$home"/config*; do
        [ ! -e "$config" ] || cp "$config" "$clone.cargo/"
    done
    env CARGO_HOME="$clone.cargo" CARGO_TARGET_DIR="$clone.target" \
        make --no-print-directory -C "$clone" ship TARGETS=x86_64-unknown-linux-gnu VENV="$VENV"
    rm -rf "$clone.target"
done
cd "$folder/one/dist"
for file in *; do
    cmp "$file" "$folder/two/is/deeper/dist/$file" ||
        { echo "FAILED: two builds of $file differ" >&2; exit 1; }
done
echo "Two builds are equal byte by byte:"
sha256sum -- *
