#!/usr/bin/env bash
# Installs the Debian packages listed in packages.txt that are missing, and with --tests those of packages_for_tests.txt. Does nothing
# where all are there.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

fail() { echo "$(basename "$0"): $*" >&2; exit 1; }

lists=("$here/packages.txt")
[ "${1:-}" != --tests ] || lists+=("$here/packages_for_tests.txt")
mapfile -t packages < <(sed 's/#.*//; /^[[:space:]]*$/d' "${lists[@]}")
command -v dpkg-query >/dev/null || fail "this is no Debian system; install the equivalents of: ${packages[*]}"
missing=()
for package in "${packages[@]}"; do
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || fail "missing packages; as root run: apt-get install ${missing[*]}"
  root=(sudo)
fi
echo "installing ${#missing[@]} packages: ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
"${root[@]}" apt-get update -qq || fail "apt-get update failed; is the network reachable?"
"${root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2 ||
  fail "apt-get could not install: ${missing[*]}"
