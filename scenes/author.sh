#!/usr/bin/env bash
# Authors the media of the scenes in this folder. Usage: scenes/author.sh ARCUS NAME (rain_shower | moonbow | shower_at_sunset | cumulus | crepuscular | fogbow | glory | corona | halo_22 | parhelia | circumzenithal | display | droplets | slab)
set -euo pipefail
arcus=$(realpath "${1:?usage: author.sh ARCUS NAME}")
cd "$(dirname "${BASH_SOURCE[0]}")"
case "${2:?usage: author.sh ARCUS NAME}" in
  rain_shower | moonbow)
    "$arcus" author rain -o rain_shower.vdb --drops narrow --radius-um 220 --radius-exponent 0.1 --variance 0.02 \
      --rain-mm-per-hour 1 --core-radius-m 700 --edge-width-m 500 --stretch 7 --centre-m=-2500,2500,0 --cloud-base-m 2600 \
      --virga-m 12000 --streak-contrast 0.45 --turbulence 0.25 ;;
  shower_at_sunset)
    "$arcus" author rain -o shower_at_sunset.vdb --rain-mm-per-hour 8 --core-radius-m 1300 --edge-width-m 700 --stretch 3.5 --centre-m=-1000,3600,0 \
      --cloud-base-m 2600 --virga-m 9000 --streak-contrast 0.7 --voxel-m 40 ;;
  cumulus)
    "$arcus" author cloud -o cumulus.vdb --size-m 6000 --depth-m 1300 --seed 3 ;;
  crepuscular)
    "$arcus" author cloud -o crepuscular.vdb --kind cumulus --centre-m 0,4500,0 --size-m 9000 --base-m 1000 --depth-m 1000 --cover 0.22 --cell-m 3000 \
      --voxel-m 40 --detail 0.6 --drops-per-cm3 50 --seed 5 ;;
  fogbow)
    "$arcus" author fog -o fogbow.vdb --kind advection --centre-m 0,330,0 --size-m 1600,500 --top-m 160 --liquid-g-per-m3 0.03 \
      --radius-um 10 --radius-at-base-um 10 --variance 0.05 ;;
  glory)
    "$arcus" author fog -o glory.vdb --kind radiation --centre-m 0,150,0 --size-m 400,320 --base-m 86 --top-m 100 --waves-m 1.2 --voxel-m 2 \
      --liquid-g-per-m3 0.3 --radius-um 9 --radius-at-base-um 8 --variance 0.03
    # Who stands behind the camera: black, for all the light that meets him.
    "$arcus" author box -o observer.vdb --name observer --optical-depth 400 --centre-m=0,-0.6,105.4 --size-m 0.55,0.35,1.9 --voxels 4,4,4 \
      --phase-type isotropic ;;
  corona)
    "$arcus" author cloud -o corona.vdb --kind stratocumulus --centre-m 0,4300,0 --size-m 4000 --base-m 3000 --depth-m 120 --cell-m 500 \
      --cover 0.9 --drops-per-cm3 250 --liquid-gradient-g-per-m3-km 1.2 --adiabatic-share 0.5 --variance 0.02 --voxel-m 10 --detail 0.5 ;;
  halo_22)
    # Seen from below as wide as the sky: a sheet so large that its edge is near the horizon.
    "$arcus" author box -o halo_22.vdb --name cirrostratus --optical-depth 0.7 --centre-m 0,0,8500 --size-m 200000,200000,800 --voxels 4,4,4 \
      --phase-type crystal --phase-habit prism --phase-orientation-type random --phase-size-um 200 ;;
  # Sheets of crystals so large that halos no longer depend on their size, which end a few degrees above the horizon.
  parhelia)
    "$arcus" author cirrus -o parhelia.vdb --kind cirrostratus --habits plate,random_plate --shares 0.6,0.4 --optical-depth 0.8 --size-m 300000 \
      --base-m 7500 --top-m 9000 --voxel-m 500 --tilt-deg 1.5 --length-over-width 5 --texture 2 --size-nodes 1 ;;
  circumzenithal)
    "$arcus" author cirrus -o circumzenithal.vdb --kind cirrostratus --habits plate,column --shares 0.6,0.4 --optical-depth 0.8 --size-m 300000 \
      --base-m 7500 --top-m 9000 --voxel-m 500 --tilt-deg 0.7,0.5 --length-over-width 5 --texture 2 --size-nodes 1 --seed 2 ;;
  display)
    "$arcus" author cirrus -o display.vdb --kind cirrostratus --habits plate,column,parry,random_column --shares 0.3,0.4,0.05,0.25 --optical-depth 1 \
      --size-m 300000 --base-m 7000 --top-m 8500 --voxel-m 500 --tilt-deg 1,0.5,0.5,1 --length-over-width 5 --size-nodes 1 --seed 3 ;;
  droplets)
    "$arcus" author box -o droplets.vdb --name rain --extinction-per-m 0.1 --centre-m 0,25,10 --size-m 48,10,20 --voxels 96,20,40 --size-um 500 \
      --phase-type mie --phase-size-um 500 --phase-distribution-variance 0.01 ;;
  slab)
    "$arcus" author box -o slab.vdb --name layer --optical-depth 5 --centre-m 0,0,0 --size-m 100000,100000,1 --voxels 4,4,4 \
      --phase-type hg --phase-g 0.85 ;;
  *) echo "author.sh: no medium for '$2'; known: rain_shower, moonbow, shower_at_sunset, cumulus, crepuscular, fogbow, glory, corona, halo_22, parhelia, circumzenithal, display, droplets, slab" >&2; exit 2 ;;
esac
