#!/usr/bin/env bash
# Runs under wine: the unit tests, as a program for Windows that zig links, and Python tests with the
# wheel in python.org's Python: ship/test_windows.sh. Exit code 77 where wine, the compiler or this
# Python cannot be had, with the reason.
set -euo pipefail
cd "$(dirname "$0")/.."
. ship/debian.sh
. ship/python_tests.sh
target=x86_64-pc-windows-gnu
wine=$PWD/target/wine
export CARGO_TARGET_DIR=$PWD/target/ship

if [ ! -d "$wine" ]; then
    fetch_lists amd64
    rm -rf "$wine.part"
    unpack "$wine.part" wine64 libwine libz-mingw-w64 libunwind8
    libraries=$wine.part/usr/lib/x86_64-linux-gnu
    # Debian's script looks for the server in /usr; zlib is where a link from /usr would lead.
    ln -sf wineserver64 "$wine.part/usr/lib/wine/wineserver"
    cp "$wine.part/usr/x86_64-w64-mingw32/lib/zlib1.dll" "$libraries/wine/x86_64-windows/"
    rm -rf "$libraries/wine/i386-windows"
    mv "$wine.part" "$wine"
fi
run_wine() {
    LD_LIBRARY_PATH=$wine/usr/lib/x86_64-linux-gnu WINEPREFIX=$PWD/target/wine-prefix WINEDEBUG=-all \
        "$wine/usr/lib/wine/wine64" "$@"
}

system=target/wine-prefix/drive_c/windows/system32
if [ ! -e $system/bcryptprimitives.dll ]; then
    # It fails for want of its 32-bit part, after all else is done.
    run_wine wineboot -i 2>/dev/null || true
    # Wine 8 lacks the DLL from which std takes random numbers.
    cat >target/bcryptprimitives.c <<'END'
#include <windows.h>
BOOLEAN NTAPI SystemFunction036(void *, ULONG);
__declspec(dllexport) BOOL WINAPI ProcessPrng(unsigned char *data, size_t size) {
    return SystemFunction036(data, size);
}
END
    python -m ziglang cc -target x86_64-windows-gnu -shared -o $system/bcryptprimitives.dll \
        target/bcryptprimitives.c -ladvapi32
fi

program=$(ship/cross.sh tests/step.sh "Compile the unit tests for Windows" cargo-zigbuild test --lib --no-run \
    --locked --target $target -Zbuild-std=std,panic_unwind,test --message-format json |
    sed -nE 's/.*"executable":"([^"]*)".*/\1/p')
run_wine "$program" --quiet --test-threads 2 --include-ignored

root=$PWD/target/windows-python
site=$PWD/target/windows-site
compgen -G "dist/irbkin-*win_amd64.whl" >/dev/null || ship/build.sh dist $target
wheel=$(echo dist/irbkin-*win_amd64.whl)
version=$(python -c 'import sys; print("%d.%d" % sys.version_info[:2])')
# Wine 8 lacks functions of complex numbers that NumPy 2 calls.
case $version in
    3.10 | 3.11 | 3.12) ;;
    *) skip "the wheel for Windows was not tried: NumPy 1 is not for Python $version" ;;
esac
install() {
    tests/retry.sh pip "$@" --quiet --disable-pip-version-check --only-binary :all: --platform win_amd64 \
        --implementation cp --python-version "$version"
}
if [ ! -d "$root" ]; then
    install download --no-deps --dest target/panda3d panda3d==1.10.16 ||
        skip "the wheel for Windows was not tried: Panda3D cannot be downloaded"
    rm -rf "$root.part"
    python ship/windows_python.py "$root.part" target/panda3d/*.whl
    mv "$root.part" "$root"
fi
rm -rf "$site"
install install --no-warn-conflicts --target "$site" "$wheel" 'numpy<2' pytest 'hypothesis<6.141'
# Standard input and output of wine's programs must be pipes.
run_python() {
    : | PYTHONHOME=Z:$root PYTHONPATH="Z:$site;Z:$PWD/tests/python" run_wine "$root/python.exe" "$@" 2>&1 | cat
}
run_python -m pytest -c NUL --rootdir . -p no:cacheprovider --quiet -rs "${tests[@]}"
run_python -m irbkin ik UR5e --xyz 400 200 500
ship/ran.sh "$wheel" "Python tests under wine"
