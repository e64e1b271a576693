#!/usr/bin/env bash
# Authors the media of the scenes in this folder. Usage: scenes/author.sh ARCUS NAME (rain_shower | slab)
set -euo pipefail
arcus=$(realpath "${1:?usage: author.sh ARCUS NAME}")
cd "$(dirname "${BASH_SOURCE[0]}")"
case "${2:?usage: author.sh ARCUS NAME}" in
  rain_shower)
    "$arcus" author rain -o rain_shower.vdb --drops narrow --radius-um 300 --variance 0.03 --rain-mm-per-hour 5 \
      --core-radius-m 550 --edge-width-m 450 --stretch 5 --centre-m 0,2300,0 --cloud-base-m 1900 ;;
  slab)
    "$arcus" author box -o slab.vdb --name layer --optical-depth 5 --centre-m 0,0,0 --size-m 100000,100000,1 --voxels 4,4,4 \
      --phase-type hg --phase-g 0.85 ;;
  *) echo "author.sh: no medium for '$2'; known: rain_shower, slab" >&2; exit 2 ;;
esac
