#!/usr/bin/env bash
# Runs the tests of crates/irbkin-capi, and tests the C interface as a user has it: the header, the
# installed library in C and C++, plain, in valgrind and with gcc's address sanitizer, and the
# examples. What is missing is skipped with the reason.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$PWD prefix=$PWD/target/capi work=$PWD/target/capi-test
urdf=$root/tests/data/ur5e.urdf

fail() {
    echo "$1" >&2
    exit 1
}

# With the laws' crate, which has no library, the core has their features: their build serves.
with_laws=(-p irbkin-capi -p irbkin-tests)
tests/step.sh "Tests of crates/irbkin-capi" cargo test --quiet "${with_laws[@]}" --lib
code=0
tests/step.sh "irbkin.h is of the source" crates/irbkin-capi/header.sh || code=$?
case $code in
    0) ;;
    77) echo "SKIPPED: irbkin.h was not compared with the source (the reason is above)" ;;
    *) exit "$code" ;;
esac

if ! command -v gcc >/dev/null || ! command -v g++ >/dev/null; then
    echo "SKIPPED: the C interface was not run: there is no gcc or no g++"
    exit
fi
mkdir -p "$work"
tests/step.sh "The answers of the Rust crate" \
    cargo build --quiet "${with_laws[@]}" --example expected
"${CARGO_TARGET_DIR:-target}/debug/examples/expected" >"$work/expected.h"
cd "$work"

if command -v pkg-config >/dev/null; then
    export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
    flags=$(pkg-config --cflags irbkin) shared=$(pkg-config --libs irbkin)
    static=$(pkg-config --static --libs irbkin)
else
    echo "SKIPPED: irbkin.pc was not read: there is no pkg-config"
    flags=-I$prefix/include shared="-L$prefix/lib -lirbkin"
    static="$shared $(sed -n 's/^Libs.private: //p' "$prefix/lib/pkgconfig/irbkin.pc")"
fi
shared="$shared -Wl,-rpath,$prefix/lib -lm"
# The static library stands before what it needs.
static="$prefix/lib/libirbkin.a ${static/-lirbkin/} -lm"
sanitized="-fsanitize=address,undefined -fno-sanitize-recover=all"
strict="-Wall -Wextra -Werror -pedantic -g -I$work -I$root/tests/capi $flags"

compile() { # NAME SOURCE FLAGS...
    local name=$1 source=$2
    shift 2
    case $source in
        *.c) gcc -std=c11 $strict "$source" "$@" -o "$name" ;;
        *) g++ -std=c++17 $strict "$source" "$@" -o "$name" ;;
    esac
}

for source in laws.c wrapper.cpp; do
    name=${source%.*}
    compile "$name" "$root/tests/capi/$source" $shared
    "./$name" "$urdf"
    compile "$name-static" "$root/tests/capi/$source" $static
    "./$name-static" "$urdf"
    compile "$name-sanitized" "$root/tests/capi/$source" $sanitized $static
    echo "With -fsanitize=address,undefined: $("./$name-sanitized" "$urdf")"
done
for source in "$root"/crates/irbkin-capi/examples/one_pose.{c,cpp}; do
    name=example-${source##*.}
    compile "$name" "$source" $shared
    "./$name"
done
cmp <(./example-c) <(./example-cpp) || fail "one_pose.c and one_pose.cpp print different lines"

# The blocks of the page are whole programs.
for language in c cpp; do
    sed -n "/^\`\`\`$language\$/,/^\`\`\`\$/p" "$root/docs/guide/c.md" | sed '/^```/d' >"page.$language"
    [ -s "page.$language" ] || fail "docs/guide/c.md has no block of $language"
    compile "page-$language" "page.$language" $shared
    while IFS= read -r line; do
        grep -qxF -- "$line" "$root/docs/guide/c.md" || fail "docs/guide/c.md does not show: $line"
    done < <("./page-$language")
done

if ! command -v valgrind >/dev/null; then
    "$root/tests/retry.sh" apt-get install -y -qq --no-install-recommends valgrind || true
fi
if command -v valgrind >/dev/null; then
    # Threads that wait for the next batch are there at the end, as is meant.
    for program in laws wrapper example-c example-cpp; do
        arguments=$(case $program in example*) ;; *) echo "$urdf" ;; esac)
        echo "In valgrind:"
        valgrind --quiet --leak-check=full --show-leak-kinds=definite \
            --errors-for-leak-kinds=definite --error-exitcode=9 "./$program" $arguments
    done
else
    echo "SKIPPED: the C interface was not run in valgrind: it cannot be installed"
fi

if command -v cmake >/dev/null; then
    "$root/tests/step.sh" "The CMake package" \
        cmake -S "$root/tests/capi" -B cmake -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
    cmake --build cmake >/dev/null
    for program in shared static; do
        cmp <("cmake/$program") <(./example-cpp)
    done
else
    echo "SKIPPED: the CMake package was not used: there is no cmake"
fi
echo "The C interface holds"
