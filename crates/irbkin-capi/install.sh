#!/usr/bin/env bash
# Builds libirbkin and installs it with its headers, its pkg-config file and its CMake package:
# crates/irbkin-capi/install.sh [PREFIX], by default target/capi. The folder may be moved.
set -euo pipefail
cd "$(dirname "$0")/../.."
prefix=${1:-target/capi}
version=$(sed -nE 's/^version = "(.*)"/\1/p' crates/irbkin-capi/Cargo.toml)
target=${CARGO_TARGET_DIR:-target}
# Before 1.0, another minor version has another interface: programs load the one they were linked to.
interface=${version%.*}
# A program that links the static library must link these, too: `cargo rustc ... --print
# native-static-libs` lists it.
case $(uname -s) in
    Darwin)
        ending=dylib name=libirbkin.$interface.dylib flag=-install_name,@rpath/
        libraries="-liconv -lSystem -lc -lm"
        ;;
    *)
        ending=so name=libirbkin.so.$interface flag=-soname,
        libraries="-lgcc_s -lutil -lrt -lpthread -lm -ldl -lc"
        ;;
esac

tests/step.sh "Build libirbkin (minutes)" \
    cargo rustc --quiet --locked --release -p irbkin-capi --lib -- -C "link-arg=-Wl,$flag$name"

mkdir -p "$prefix"/{include,lib/pkgconfig,lib/cmake/irbkin}
cp crates/irbkin-capi/include/irbkin.{h,hpp} "$prefix/include"
cp "$target/release/libirbkin_c.a" "$prefix/lib/libirbkin.a"
cp "$target/release/libirbkin_c.$ending" "$prefix/lib/$name"
ln -sf "$name" "$prefix/lib/libirbkin.$ending"
for template in irbkin.pc irbkin-config.cmake irbkin-config-version.cmake; do
    case $template in *.pc) folder=lib/pkgconfig ;; *) folder=lib/cmake/irbkin ;; esac
    sed -e "s|@VERSION@|$version|" -e "s|@INTERFACE@|$interface|" -e "s|@SHARED@|$name|" \
        -e "s|@LIBRARIES@|$libraries|" "crates/irbkin-capi/$template.in" >"$prefix/$folder/$template"
done
echo "$prefix: irbkin.h, irbkin.hpp, $name ($(wc -c <"$prefix/lib/$name") bytes), libirbkin.a, pkg-config and CMake files"
