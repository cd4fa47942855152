#!/usr/bin/env bash
# Runs Python tests with the wheel for aarch64 under qemu: ship/test_aarch64.sh. These tests start
# no process: without binfmt, qemu runs only the Python that it is given. Exit code 77 where qemu or
# Debian's packages for arm64 cannot be had, with the reason.
set -euo pipefail
cd "$(dirname "$0")/.."
. ship/debian.sh
. ship/python_tests.sh
root=$PWD/target/aarch64
site=$PWD/target/aarch64-site
compgen -G "dist/irbkin-*_aarch64.whl" >/dev/null || ship/build.sh dist aarch64-unknown-linux-gnu
wheel=$(echo dist/irbkin-*_aarch64.whl)

if [ ! -d "$root" ]; then
    fetch_lists "$(dpkg --print-architecture 2>/dev/null || echo amd64)"
    unpack "$root.part" qemu-user-static
    fetch_lists arm64
    # shellcheck disable=SC2046
    unpack "$root.part" $(with_dependencies python3 libstdc++6)
    rm -rf "$root"
    mv "$root.part" "$root"
fi
version=$(basename "$(echo "$root"/usr/bin/python3.?? | cut -d' ' -f1)")
rm -rf "$site"
tests/retry.sh pip install --quiet --disable-pip-version-check --target "$site" --only-binary :all: \
    --platform manylinux_2_17_aarch64 --platform manylinux_2_27_aarch64 --platform manylinux_2_28_aarch64 \
    --platform any --implementation cp --python-version "${version#python}" \
    "$wheel" numpy pytest 'hypothesis<6.141'
PYTHONPATH=$site:tests/python tests/step.sh "Python tests under qemu aarch64" \
    "$root/usr/bin/qemu-aarch64-static" -L "$root" "$root/usr/bin/$version" -m pytest -c /dev/null --rootdir . \
    -p no:cacheprovider --quiet -rs "${tests[@]}"
ship/ran.sh "$wheel" "Python tests under qemu"
