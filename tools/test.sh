#!/usr/bin/env bash
# From a bare machine to a passed test suite: installs the packages, builds and runs every test.
# Usage: tools/test.sh [further options of ctest, e.g. -L quick]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

fail() { echo "test.sh: $*" >&2; exit 1; }

bash tools/install_packages.sh --tests || fail "the packages in tools/packages.txt and packages_for_tests.txt could not be installed"
cmake --preset release -DBUILD_TESTING=ON -DWARNINGS_AS_ERRORS="${WARNINGS_AS_ERRORS:-OFF}" ||
  fail "cmake failed; its message is above"
cmake --build --preset release || fail "the build failed; the compiler's message is above"
ctest --preset all "$@" || fail "a test failed; run it alone with: ctest --preset all -R NAME"
