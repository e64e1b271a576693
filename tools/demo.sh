#!/usr/bin/env bash
# From a bare machine to a picture: installs the packages, builds, authors a shower and renders its rainbow.
# Usage: tools/demo.sh [further options of `arcus render`]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

fail() { echo "demo.sh: $*" >&2; exit 1; }

bash tools/install_packages.sh || fail "the packages in tools/packages.txt could not be installed"
cmake --preset release -DBUILD_TESTING=OFF >build-demo.log 2>&1 ||
  fail "cmake failed; see $root/build-demo.log"
mkdir -p build && mv build-demo.log build/demo.log
echo "building (minutes the first time) ..." >&2
cmake --build --preset release --target arcus >>build/demo.log 2>&1 || fail "the build failed; see $root/build/demo.log"

arcus=build/release/arcus
mkdir -p build/pictures
bash scenes/author.sh "$arcus" rain_shower || fail "the shower could not be authored"
"$arcus" render scenes/rain_shower.toml -o build/pictures/rain_shower.exr "$@" || fail "the render failed"
echo "the picture: $root/build/pictures/rain_shower.png"
