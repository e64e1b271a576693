#!/usr/bin/env bash
# Writes the reference pages and schemas from the lists of keys that the program reads files with.
# Usage: docs/make_reference.sh ARCUS [--check: only say whether they are up to date]
set -euo pipefail
arcus=$(realpath "${1:?usage: make_reference.sh ARCUS [--check]}")
docs=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$docs/reference
if [ "${2:-}" = --check ]; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi
mkdir -p "$folder"
for kind in scene recipe author-rain author-cloud author-cirrus author-diamond-dust author-fog author-box author-field; do
  "$arcus" reference --kind "$kind" >"$folder/${kind//-/_}.md"
  "$arcus" reference --kind "$kind" --schema >"$folder/${kind//-/_}.schema.json"
done
[ "${2:-}" != --check ] || diff -r "$folder" "$docs/reference" ||
  { echo "docs/reference is not what the program says; run docs/make_reference.sh" >&2; exit 1; }
