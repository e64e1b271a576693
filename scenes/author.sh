#!/usr/bin/env bash
# Authors the media of the scenes in this folder. Usage: scenes/author.sh ARCUS NAME (rain_shower | cumulus | fogbow | glory | slab)
set -euo pipefail
arcus=$(realpath "${1:?usage: author.sh ARCUS NAME}")
cd "$(dirname "${BASH_SOURCE[0]}")"
case "${2:?usage: author.sh ARCUS NAME}" in
  rain_shower)
    "$arcus" author rain -o rain_shower.vdb --drops narrow --radius-um 220 --radius-exponent 0.1 --variance 0.02 \
      --rain-mm-per-hour 0.4 --core-radius-m 700 --edge-width-m 500 --stretch 7 --centre-m=-2500,2500,0 --cloud-base-m 2600 \
      --virga-m 12000 --streak-contrast 0.45 --turbulence 0.25 ;;
  cumulus)
    "$arcus" author cloud -o cumulus.vdb --size-m 6000 --depth-m 1300 --seed 3 ;;
  fogbow)
    "$arcus" author fog -o fogbow.vdb --kind advection --centre-m 0,330,0 --size-m 1600,500 --top-m 160 --liquid-g-per-m3 0.03 \
      --radius-um 10 --radius-at-base-um 10 --variance 0.05 ;;
  glory)
    "$arcus" author cloud -o glory.vdb --kind stratocumulus --centre-m 0,1000,0 --size-m 3000 --base-m 500 --depth-m 250 \
      --drops-per-cm3 200 --variance 0.03 ;;
  slab)
    "$arcus" author box -o slab.vdb --name layer --optical-depth 5 --centre-m 0,0,0 --size-m 100000,100000,1 --voxels 4,4,4 \
      --phase-type hg --phase-g 0.85 ;;
  *) echo "author.sh: no medium for '$2'; known: rain_shower, cumulus, fogbow, glory, slab" >&2; exit 2 ;;
esac
