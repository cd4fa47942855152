#!/usr/bin/env bash
# Tests the wheels of other platforms: ship/environment.sh ship/test_platforms.sh. Exit code 77 if one
# was skipped.
set -euo pipefail
exec ship/each.sh ship/test_windows.sh ship/test_aarch64.sh ship/test_musl.sh
