#!/usr/bin/env bash
# Compares what README's first example prints with README,
# with the wheel for musl: ship/test_musl.sh. Debian has no Python on
# musl: its sources are compiled with zig, once, about five minutes. Exit code 77 where Debian's
# packages or sources cannot be had, with the reason.
set -euo pipefail
cd "$(dirname "$0")/.."
. ship/debian.sh
root=$PWD/target/musl
site=$PWD/target/musl-site
compgen -G "dist/irbkin-*musllinux*x86_64.whl" >/dev/null || ship/build.sh dist x86_64-unknown-linux-musl
wheel=$(echo dist/irbkin-*musllinux*x86_64.whl)

if [ ! -x "$root/python/python" ]; then
    fetch_lists amd64
    unpack "$root" musl
    python=$(depends python3 'python3\.')
    apt-get "${apt[@]}" indextargets --format 'deb-src $(REPO_URI) $(RELEASE) $(COMPONENT)' \
        'Created-By: Packages' 'Origin: Debian' | sort -u >"$root/sources.list"
    sources=("${apt[@]}" -o "Dir::Etc::sourcelist=$root/sources.list" -o Dir::Etc::sourceparts=/dev/null)
    tests/retry.sh apt-get "${sources[@]}" update || skip "apt-get update of the sources failed"
    rm -rf "$root/python" && mkdir -p "$root/python"
    (cd "$root" && ../../tests/retry.sh apt-get "${sources[@]}" source --download-only --tar-only "$python") ||
        skip "the sources of $python cannot be downloaded"
    tar xf "$root/${python}"_*.orig.tar.* --strip-components 1 -C "$root/python"
    cat >"$root/cc" <<END
#!/bin/sh
exec $(command -v python) -m ziglang cc -target x86_64-linux-musl -dynamic \
    -Wl,--dynamic-linker=$root/lib/ld-musl-x86_64.so.1 "\$@"
END
    chmod +x "$root/cc"
    (
        cd "$root/python"
        # zig's musl has functions that the oldest one of the tag lacks. pkg-config names libraries of
        # glibc; modules that need one of those fail, and --keep-going leaves them out.
        CC=$root/cc PKG_CONFIG=false ac_cv_func_preadv2=no ac_cv_func_pwritev2=no ./configure --quiet \
            --build x86_64-linux-musl --disable-ipv6 --disable-test-modules --with-ensurepip=no \
            OPT="-O1 -Wno-date-time"
        make --silent --keep-going
    ) >"$root/build.log" 2>&1 || true
    [ -x "$root/python/python" ] || { tail -n 20 "$root/build.log" >&2; exit 1; }
fi
version=$("$root/python/python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
rm -rf "$site"
# Later wheels of numpy need musl 1.2.4.
tests/retry.sh pip install --quiet --disable-pip-version-check --no-warn-conflicts --target "$site" --only-binary :all: \
    --platform musllinux_1_1_x86_64 --platform musllinux_1_2_x86_64 --implementation cp \
    --python-version "$version" "$wheel" 'numpy<2'
# The first block of a language in README.
block() {
    awk -v fence="^\`\`\`$1\$" '/^```/ && inside { exit } inside; $0 ~ fence { inside = 1 }' README.md
}
mkdir -p target/ship
block python >target/ship/readme.py
diff <(block text) <(PYTHONPATH=$site "$root/python/python" target/ship/readme.py) >&2 ||
    { echo "FAILED: on musl README's example prints what is marked >" >&2; exit 1; }
echo "musl: README's example prints what README shows"
ship/ran.sh "$wheel" "README's example on musl"
