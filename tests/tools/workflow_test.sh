#!/usr/bin/env bash
# The program as people use it: author, look at, render, measure, compare; interrupt and go on. Usage: workflow_test.sh ARCUS
ARCUS=$1
source "$(dirname "${BASH_SOURCE[0]}")/shell_kit.sh"

# check WHAT COMMAND...: the command succeeds; its own output is of no interest.
check() {
  local what=$1
  shift
  checks=$((checks + 1))
  "$@" >"$work/.stdout" 2>"$work/.stderr" || complain "$what"
}
is_png() { [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ]; }
is_json() {
  printf 'file(READ "%s" text)\nstring(JSON count LENGTH "${text}")\n' "$1" >json.cmake
  cmake -P json.cmake
}

# Author a small shower, with options and with a file of settings: the same bytes of values.
must "$ARCUS" author rain -o shower.vdb --core-radius-m 60 --edge-width-m 40 --cloud-base-m 120 --seed 4 --quiet
printf 'core_radius_m = 60\nedge_width_m = 40\ncloud_base_m = 120\nseed = 4\n' >shower.toml
must "$ARCUS" author rain -o again.vdb --settings shower.toml --quiet
expect 0 'rain.extinction' "$ARCUS" info shower.vdb
"$ARCUS" info shower.vdb --json | grep -v '"file"' >one.json
"$ARCUS" info again.vdb --json | grep -v '"file"' >two.json
check 'settings and options author different showers' cmp one.json two.json
check 'info --json is no JSON' is_json one.json
"$ARCUS" author rain -o again.vdb --settings shower.toml 2>said.txt
tonnes=$(sed -n 's/^again.vdb: \([0-9.e+]*\) t of water.*/\1/p' said.txt)
kilograms=$("$ARCUS" info again.vdb --png views.png | sed -n 's/^water_kg: //p')
check 'author and info tell the same mass of water' awk -v t="$tonnes" -v kg="$kilograms" 'BEGIN { exit !(t > 0 && kg / t / 1000 > 0.99 && kg / t / 1000 < 1.01) }'
check 'info --png makes a PNG' is_png views.png
for kind in cumulus stratocumulus stratus; do
  expect 0 'effective radius' "$ARCUS" author cloud --kind "$kind" --size-m 1500 --voxel-m 50 -o cloud.vdb
done
expect 0 'effective radius' "$ARCUS" author fog --size-m 200 --voxel-m 10 -o fog.vdb
expect 0 'size_um = \[' "$ARCUS" info fog.vdb
# Ice: each habit a species of its own in one file, all with the mass that the author tells.
for kind in uncinus fibratus cirrostratus; do
  expect 0 'species cirrus_plate, cirrus_column, cirrus_prism' "$ARCUS" author cirrus --kind "$kind" --size-m 5000 --voxel-m 250 -o cirrus.vdb
done
"$ARCUS" author cirrus --size-m 6000 --voxel-m 200 --cover 0.5 --habits plate,column --shares 0.6,0.4 -o cirrus.vdb 2>said.txt
tonnes=$(sed -n 's/^cirrus.vdb: \([0-9.e+]*\) t of ice.*/\1/p' said.txt)
kilograms=$("$ARCUS" info cirrus.vdb --png views.png | sed -n 's/^ice_kg: //p' | awk '{ sum += $1 } END { print sum }')
check "author and info tell the same mass of ice: $tonnes t, $kilograms kg" awk -v t="$tonnes" -v kg="$kilograms" 'BEGIN { exit !(t > 0 && kg / t / 1000 > 0.99 && kg / t / 1000 < 1.01) }'
expect 0 'cirrus_column.size' "$ARCUS" info cirrus.vdb
expect 0 'habit = "plate"' "$ARCUS" info cirrus.vdb
expect 0 'optical depth 0.2,' "$ARCUS" author diamond-dust --optical-depth 0.2 --size-m 400 --voxel-m 20 -o dust.vdb
expect 0 'medium: diamond_dust_plate' "$ARCUS" info dust.vdb
expect 0 'Usage' "$ARCUS" author rain --help
printf '0,0,0,0.5\n1,0,0,0.25\n0,0,2,0.125\n' >points.csv
must "$ARCUS" author field --file points.csv -o field.vdb
expect 0 'active_voxels: 3' "$ARCUS" info field.vdb

# The water of a cloud model: NetCDF with uneven levels, and an LWC file.
cat >les.cdl <<'CDL'
netcdf les { dimensions: z = 3, y = 2, x = 2;
variables: float x(x), y(y), z(z), QC(z, y, x); x:units = "m"; y:units = "m"; z:units = "km"; QC:units = "g/kg"; QC:_FillValue = -999.f;
data: x = 0, 50; y = 0, 50; z = 0.5, 0.52, 0.56; QC = 0, 0, 0, 0.1, 0, 0.2, 0.2, 0.3, 0, 0, 0.1, 0.1; }
CDL
ncgen -o les.nc les.cdl
expect 0 "water from 'QC' times .*Standard Atmosphere" "$ARCUS" author field --file les.nc --number-per-cm3 100 -o les.vdb
expect 0 'uneven layers became' "$ARCUS" author field --file les.nc --number-per-cm3 100 -o les.vdb
# 1 g/kg near 540 m is 1.16 g/m3; layers of 20, 30 and 40 m, cells of 50 m: 81 kg.
kilograms=$("$ARCUS" info les.vdb --png views.png | sed -n 's/^water_kg: //p')
check "the water of the model is kept: $kilograms kg" awk -v kg="$kilograms" 'BEGIN { w = 1.163 * 2500 * (20 * 0.1 + 30 * 0.7 + 40 * 0.2) / 1000; exit !(kg > 0.98 * w && kg < 1.02 * w) }'
printf '2 parameter LWC file\n2 2 2\n0.05 0.05\n0.5 0.55 0.6\n288 288 288\n1 1 1 0.2 8\n2 2 2 0.4 12\n' >les.lwc
expect 0 'effective radius 8 to 12 um' "$ARCUS" author field --file les.lwc -o lwc.vdb
expect 0 'cloud.size' "$ARCUS" info lwc.vdb

# Phase functions.
"$ARCUS" phase sphere --x 10 --n 1.33 --k 1e-8 --angles-deg 0,90,180 --json >sphere.json
for key in qext qsca qback g angles_deg s1_re s1_im s2_re s2_im; do
  check "phase sphere --json has no $key" grep -q "\"$key\"" sphere.json
done
printf 'type = "mie"\nsize_um = [3, 4]\nradii = 300\nwavelength_nm = { min = 500, max = 600, nodes = 3 }\n' >drops.toml
"$ARCUS" phase eval drops.toml --size-um 3 --wavelength-nm 550 --angles-deg 0:180:90 >eval.csv
check 'the header of phase eval' grep -qx 'scattering_angle_deg,P11,P12,P33,P34' eval.csv
check 'phase eval has a line an angle' test "$(wc -l <eval.csv)" -eq 4
must "$ARCUS" phase compute drops.toml -o drops.nc
check 'the dimensions of a table' bash -c 'ncdump -h drops.nc | grep -q "P11(size_um, wavelength_nm, scattering_angle_deg)"'
must "$ARCUS" phase plot drops.toml -o drops.png --polar polar.png --size-um 4
check 'phase plot makes a PNG' is_png drops.png
check 'phase plot --polar makes a PNG' is_png polar.png
expect 0 'recipe' "$ARCUS" info drops.nc

# The sky of crystals: few rays, coarse maps.
few='--rays-million 0.02 --map-step-deg 2 --quiet'
for kind in plate column prism; do
  printf 'type = "crystal"\nhabit = "%s"\nwavelength_nm = { min = 450, max = 650, nodes = 3 }\n' "$kind" >$kind.toml
  must "$ARCUS" phase plot $kind.toml -o $kind.png --below --label --size-px 300 $few
  check "phase plot of $kind makes a PNG" is_png $kind.png
done
must "$ARCUS" phase plot plate.toml column.toml --weights 1,0.5 -o display.png --projection equal-area --sun-elevation-deg 25 --size-px 300 $few
check 'two recipes make one PNG' is_png display.png
must "$ARCUS" phase plot prism.toml --curves -o curves.png --rays-million 0.02 --quiet
check 'phase plot --curves makes a PNG' is_png curves.png
tables=$(find "$XDG_CACHE_HOME" -name '*.nc' | wc -l)
must "$ARCUS" phase plot plate.toml -o arc.png --ray-path 1-3 --plain --size-px 300 $few
check 'a map of one path is kept beside that of all' test "$(find "$XDG_CACHE_HOME" -name '*.nc' | wc -l)" -eq $((tables + 1))
check 'it is another picture' bash -c '! cmp -s arc.png plate.png'
expect 0 '1-3 +plate' "$ARCUS" phase plot plate.toml --paths-at 0,66 --radius-deg 3 --rays-million 0.05
expect 0 '# no light fell there' "$ARCUS" phase plot plate.toml --paths-at 0,66 --radius-deg 3 --without-path 1-3 --ray-path 1-3 --rays-million 0.01
"$ARCUS" phase plot plate.toml --paths-at -25,20 --exact-path --rays-million 0.02 --json >paths.json
check 'phase plot --paths-at --json is no JSON' is_json paths.json
check 'a path has a share' grep -q '"share"' paths.json

# Crystals that lie level, from the recipe to a picture.
printf 'type = "crystal"\nhabit = "plate"\nwavelength_nm = { min = 450, max = 650, nodes = 3 }\nrays_million = 0.02\nmap_step_deg = 2\n' >level.toml
must "$ARCUS" phase compute level.toml --sun-elevation-deg 30 -o level.nc --quiet
check 'the dimensions of a map' bash -c 'ncdump -h level.nc | grep -q "scattering(size_um, elevation_deg, azimuth_deg, wavelength_nm)"'
expect 0 'sun_elevation_deg: 30' "$ARCUS" info level.nc
must "$ARCUS" author box -o level.vdb --name ice --optical-depth 0.3 --centre-m 0,0,5000 --size-m 50000,50000,100 --voxels 4,4,4 --phase-type crystal \
  --phase-habit plate --phase-wavelength-nm 450,550,650 --phase-rays-million 0.02 --phase-map-step-deg 2 --quiet
printf '[render]\nsamples_per_pixel = 4\n[camera]\nresolution = [16, 12]\nazimuth_deg = 180\nelevation_deg = 30\n[sun]\nelevation_deg = 30\n[sky]\ntype = "none"\n' >dogs.toml
printf '[[medium]]\nvdb = "level.vdb"\n[[medium]]\nvdb = "level.vdb"\ntranslate_m = [0, 0, -4000]\nphase = { type = "isotropic" }\n' >>dogs.toml
must "$ARCUS" render dogs.toml -o dogs.exr --quiet
check 'crystals and other particles make a picture' is_png dogs.png

# A table from elsewhere: named relative to its recipe, and rendered from any folder.
mkdir -p tables/scenes
printf 'angle 450 650\n0 30 20\n90 1 1\n180 2 1\n' >tables/t.txt
printf 'type = "table"\nfile = "t.txt"\n' >tables/r.toml
expect 0 "column '450': its integral over the sphere is" "$ARCUS" phase compute tables/r.toml -o tables/own.nc
must "$ARCUS" author box --optical-depth 1 --phase tables/r.toml -o tables/box.vdb
printf '[camera]\nresolution = [8, 8]\nposition_m = [0, -5, 0]\n[[medium]]\nvdb = "../box.vdb"\n' >tables/scenes/s.toml
check 'a VDB with a table renders from its own folder' bash -c "cd tables/scenes && '$ARCUS' render s.toml --spp 1 --quiet"
printf 'phase = { type = "table", file = "../own.nc" }\n' >>tables/scenes/s.toml
check 'a table of phase compute serves a scene' "$ARCUS" render tables/scenes/s.toml --spp 1 --quiet

# Render, with options that change the scene; the EXR knows it.
must "$ARCUS" author box -o box.vdb --optical-depth 1 --phase drops.toml
printf '[camera]\nresolution = [48, 32]\nposition_m = [0, -2000, 0]\n[[medium]]\nvdb = "box.vdb"\n' >box.toml
expect 0 'samples/s' "$ARCUS" render box.toml -o box.exr --spp 4 --seed 3 --set sun.elevation_deg=35 --set 'film.channels=["rgb","variance"]'
check 'a PNG beside the EXR' is_png box.png
expect 0 'arcus:sun:elevation_deg: 35' "$ARCUS" info box.exr
expect 0 'variance.R' "$ARCUS" info box.exr
must "$ARCUS" render box.toml -o quiet.exr --spp 1 --quiet --no-png
check '--quiet is quiet' test ! -s "$work/.stderr"
absent quiet.png
"$ARCUS" render box.toml -o json.exr --spp 4 --progress json --no-png 2>progress.txt
check '--progress json' grep -q '^{.*samples' progress.txt

# The same bits whatever the threads; pictures that differ say so.
for threads in 1 3; do must "$ARCUS" render box.toml -o "t$threads.exr" --spp 4 --threads "$threads" --no-png; done
expect 0 'RMSE' "$ARCUS" compare t1.exr t3.exr -o report.html
check 'pictures of 1 and 3 threads differ' bash -c "'$ARCUS' compare t1.exr t3.exr | grep -qE '^R .* 0 +0 +0 '"
check 'the report holds pictures' grep -q '<img' report.html

# A profile around the antisolar point: a CSV with one line a bin, and its chart.
must "$ARCUS" profile box.exr --around antisolar -o profile.csv
check 'the header of a profile' grep -q '^angle_deg,' profile.csv
check 'a profile has bins' test "$(wc -l <profile.csv)" -gt 5
check 'a chart beside the CSV' is_png profile.png

# Interrupted: a valid picture of what is done, exit code 130 or 143, and a checkpoint where one is asked for.
interrupt() {  # interrupt SIGNAL CODE OPTIONS...: renders until samples are reported, and a little longer
  local signal=$1 code=$2 found
  shift 2
  checks=$((checks + 1))
  # Shells start background jobs with SIGINT ignored: env sets it anew.
  env --default-signal=INT "$ARCUS" render box.toml -o cut.exr --no-png --progress json "$@" 2>"$work/.stderr" &
  local process=$! tries=0
  until grep -q '^{' "$work/.stderr" || [ $((tries++)) -gt 300 ]; do sleep 0.1; done
  sleep 0.2
  kill "-$signal" "$process"
  wait "$process"
  found=$?
  [ "$found" -eq "$code" ] || complain "SIG$signal ended a render with $found, not $code"
}
set +m
interrupt TERM 143 --spp 1000000
expect 0 'samples_per_pixel' "$ARCUS" info cut.exr
absent cut.exr.checkpoint
# One thread until it goes on to the end: on many it would be done before it is stopped.
interrupt TERM 143 --spp 2000 --threads 1 --resume
check 'a checkpoint is left' test -s cut.exr.checkpoint
for _ in 1 2 3; do "$ARCUS" render box.toml -o cut.exr --spp 2000 --threads 1 --resume --time-limit 0.2 --no-png --quiet; done
expect 3 'another picture' "$ARCUS" render box.toml -o cut.exr --spp 2001 --resume
must "$ARCUS" render box.toml -o cut.exr --spp 2000 --resume --no-png
absent cut.exr.checkpoint
must "$ARCUS" render box.toml -o whole.exr --spp 2000 --no-png --threads 1
check 'resumed and whole pictures differ' bash -c "'$ARCUS' compare cut.exr whole.exr | grep -qE '^R .* 0 +0 +0 '"
# Ctrl-C.
rm cut.exr
interrupt INT 130 --spp 1000000
expect 0 'samples_per_pixel' "$ARCUS" info cut.exr

# A medium against drops drawn from it.
must "$ARCUS" author box -o drops.vdb --quiet --centre-m 0,20,0 --size-m 20,10,20 --optical-depth 0.2 --size-um 500 \
  --phase-optics geometric --phase-size-um 500 --phase-distribution-variance 0.01 --phase-wavelength-nm 380,780
printf '[render]\nsamples_per_pixel = 64\n[camera]\nresolution = [16, 12]\n[sun]\nazimuth_deg = 180\nelevation_deg = 0\n[[medium]]\nvdb = "drops.vdb"\n' >drops.toml
expect 0 'profile: chi-square .* light of drops over that of the medium' "$ARCUS" compare-droplets drops.toml -o drops.html --drops 2000 --runs 4 --sun-radius-deg 20 --bin-deg 5 --to-deg 30
check 'the page has no pictures' bash -c '[ "$(grep -o "data:image/png" drops.html | wc -l)" -ge 6 ]'
check 'times are missing' grep -q 'time of 2000 drops' drops.html

finish
