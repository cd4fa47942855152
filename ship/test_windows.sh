#!/usr/bin/env bash
# Runs the unit tests as a program for Windows, under wine: ship/test_windows.sh. zig links it and
# has the C library. Exit code 77 where wine or the compiler cannot be had, with the reason.
set -euo pipefail
cd "$(dirname "$0")/.."
. ship/debian.sh
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
run_wine "$program" --quiet --test-threads 2
