#!/usr/bin/env bash
# Every wrong input gets the contract's exit code and a message that names the place; nothing crashes, nothing
# half-written stays. Usage: bad_input_test.sh ARCUS
ARCUS=$1
source "$(dirname "${BASH_SOURCE[0]}")/shell_kit.sh"

must "$ARCUS" author box --optical-depth 1 --phase-type isotropic -o box.vdb
scene() {  # scene FILE TEXT...: a small scene with lines added
  local file=$1
  shift
  { printf '[camera]\nresolution = [8, 8]\nposition_m = [0, -5, 0]\n[[medium]]\nname = "box"\nvdb = "box.vdb"\n'
    printf '%s\n' "$@"; } >"$file"
}

# The command line.
expect 2 'required' "$ARCUS"
expect 2 'SCENE' "$ARCUS" render
expect 2 'not expected|were not' "$ARCUS" render a.toml --no-such-option
expect 2 "Did you mean 'render'" "$ARCUS" rendr a.toml
expect 2 "Did you mean 'cloud'" "$ARCUS" author clod -o a.vdb
expect 2 "Did you mean '--threads'" "$ARCUS" render a.toml --thread=3
expect 0 'Usage' "$ARCUS" --help
expect 0 'Usage' "$ARCUS" render --help
expect 0 '^arcus [0-9]+\.[0-9]+' "$ARCUS" --version
expect 2 'none.toml' "$ARCUS" render none.toml

# Scenes: a misspelt key, wrong values, wrong types, wrong syntax.
printf '[sun]\nelevaton_deg = 3\n' >a.toml
expect 2 "a.toml:2:1: sun.elevaton_deg.*Did you mean 'elevation_deg'" "$ARCUS" render a.toml
printf '[sun]\nelevation_deg = 95\n' >a.toml
expect 2 'a.toml:2:17: sun.elevation_deg: 95.*between -90 and 90' "$ARCUS" render a.toml
printf '[camera]\nresolution = [0, 0]\n' >a.toml
expect 2 'a.toml:2.*camera.resolution' "$ARCUS" render a.toml
printf '[camera]\nresolution = [100000, 10000]\n' >a.toml
expect 2 'a.toml:2.*camera.resolution.*pixels' "$ARCUS" render a.toml
printf '[camera]\nresolution = "big"\n' >a.toml
expect 2 'a.toml:2.*camera.resolution' "$ARCUS" render a.toml
printf '[render\n' >a.toml
expect 2 'a.toml:1' "$ARCUS" render a.toml
printf '[[medium]]\nname = "x"\n' >a.toml
expect 2 'medium\[0\]\.vdb' "$ARCUS" render a.toml
printf '[[medium]]\nvdb = "none.vdb"\n' >a.toml
expect 2 'none.vdb' "$ARCUS" render a.toml
scene a.toml
expect 2 'sky.radiance|sky.radianc' "$ARCUS" render a.toml --set sky.radianc=1
expect 2 'nan|finite|at least' "$ARCUS" render a.toml --set sun.irradiance_scale=nan
expect 2 'crop' "$ARCUS" render a.toml --crop 0,0,9,9
expect 2 'crop' "$ARCUS" render a.toml --crop 3,3,3,4
expect 2 'exr' "$ARCUS" render a.toml -o a.jpg
scene a.toml 'grid = "clouds"'
expect 2 "clouds" "$ARCUS" render a.toml
scene a.toml 'interpolation = "cubic"'
expect 2 'interpolation.*linear or nearest' "$ARCUS" render a.toml

# Surfaces and drops.
surface() { printf '[camera]\nresolution = [8, 8]\n[[surface]]\nshape = { %s }\nmaterial = { %s }\n' "$1" "$2" >s.toml; }
surface 'type = "cube"' 'albedo = 0.5'
expect 2 "s.toml:4.*shape.type: text 'cube'.*plane, sphere" "$ARCUS" render s.toml
surface 'type = "sphere", radius_m = -1' 'albedo = 0.5'
expect 2 's.toml:4.*radius_m: -1.*above 0' "$ARCUS" render s.toml
surface 'type = "rectangle", edge_v_m = [4, 0, 0]' 'albedo = 0.5'
expect 2 's.toml:4.*edge_v_m' "$ARCUS" render s.toml
surface 'type = "sphere"' 'albedo = [0.5, 0.2]'
expect 2 's.toml:5.*albedo: 2 numbers.*1 or 3' "$ARCUS" render s.toml
surface 'type = "sphere"' 'type = "transparent", reflectance = 0.5'
expect 2 's.toml:5.*transmittance: 0.9.*at most 1 - reflectance = 0.5' "$ARCUS" render s.toml
surface 'type = "sphere"' 'type = "dielectric", index = "none.txt"'
expect 2 'none.txt' "$ARCUS" render s.toml
surface 'type = "mesh", file = "none.obj"' 'albedo = 0.5'
expect 2 'none.obj: no file' "$ARCUS" render s.toml
printf 'ply\nformat ascii 1.0\nelement vertex 4\n' >cut.ply
surface 'type = "mesh", file = "cut.ply"' 'albedo = 0.5'
expect 2 'cut.ply: a header without end_header' "$ARCUS" render s.toml
plane_ply() { printf 'ply\nformat %s 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n' "$1"; }
{ plane_ply ascii; printf '0 0 0\n1 0 0\n1 1 0\n0 1 0\n'; } >cut.ply
expect 2 "cut.ply: 0 of 1 entries of 'face'.*cut off" "$ARCUS" render s.toml
{ plane_ply binary_little_endian; head -c 40 /dev/zero; } >cut.ply
expect 2 "cut.ply: 3 of 4 entries of 'vertex'.*cut off" timeout 20 "$ARCUS" render s.toml
plane_ply ascii | sed 's/element face 1/element face 0/' >none.ply
printf '0 0 0\n1 0 0\n1 1 0\n0 1 0\n' >>none.ply
surface 'type = "mesh", file = "none.ply"' 'albedo = 0.5'
expect 2 'none.ply: no face' "$ARCUS" render s.toml
printf 'v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n' >odd.obj
surface 'type = "mesh", file = "odd.obj"' 'albedo = 0.5'
expect 2 'odd.obj: a corner that is not finite in face 0' "$ARCUS" render s.toml
{ plane_ply ascii; printf '0 0 0\n1 0 0\n1 nan 0\n0 1 0\n4 0 1 2 3\n'; } >odd.ply
surface 'type = "mesh", file = "odd.ply"' 'albedo = 0.5'
expect 2 'odd.ply: a corner that is not finite in face 0' "$ARCUS" render s.toml

# Pictures of the sky, of heights and of colours. Netpbm: a picture as text.
ppm() { printf 'P3\n%s %s\n255\n' "$1" "$2"; shift 2; printf '%s\n' "$@"; }
ppm 2 1 200 100 50 0 0 10 >sky.ppm
ppm 1 1 200 100 50 >square.ppm
ppm 2 1 0 0 0 0 0 0 >black.ppm
echo 'no picture' >words.png
sky() { printf '[camera]\nresolution = [8, 8]\n[render]\nsamples_per_pixel = 1\n[sky]\ntype = "image"\n%s\n[[surface]]\n' "$1" >i.toml; }
sky ''
expect 2 'i.toml:5.*sky.file: nothing.*name of a picture' "$ARCUS" render i.toml
sky 'file = "nowhere.exr"'
expect 2 'i.toml: sky.file: nowhere.exr: no file' "$ARCUS" render i.toml
sky 'file = "words.png"'
expect 2 'sky.file: words.png: no readable picture' "$ARCUS" render i.toml
sky 'file = "square.ppm"'
expect 2 'square.ppm: 1 x 1 pixels found; twice as wide as high' "$ARCUS" render i.toml
sky 'file = "black.ppm"'
expect 2 'black.ppm: no light' "$ARCUS" render i.toml
sky "$(printf 'file = "sky.ppm"\nscale = 0')"
expect 2 'i.toml:8.*sky.scale: 0.*above 0' "$ARCUS" render i.toml
sky "$(printf 'file = "sky.ppm"\nscale = 1e35')"
expect 2 'sky.ppm: values up to .* less than 1e30' "$ARCUS" render i.toml
sky 'file = "sky.ppm"'
for integrator in volume_path path whitted ray_cast; do must "$ARCUS" render i.toml --quiet --set "render.integrator=$integrator"; done
# Tiles of another sky are not merged with those of this one.
must "$ARCUS" tile i.toml --tiles 0/2 --out sky_tiles --quiet
ppm 2 1 200 100 50 0 0 11 >sky.ppm
expect 3 'sky_tiles: holds tiles of something else: the content of sky.ppm was another' "$ARCUS" tile i.toml --tiles 1/2 --out sky_tiles --quiet
surface 'type = "terrain"' 'albedo = 0.5'
expect 2 's.toml:4.*file: nothing.*picture of heights' "$ARCUS" render s.toml
surface 'type = "terrain", file = "nowhere.png"' 'albedo = 0.5'
expect 2 'nowhere.png: no file' "$ARCUS" render s.toml
surface 'type = "terrain", file = "sky.ppm", size_m = [3]' 'albedo = 0.5'
expect 2 's.toml:4.*size_m' "$ARCUS" render s.toml
surface 'type = "terrain", file = "sky.ppm", low_m = 3, high_m = 3' 'albedo = 0.5'
expect 2 's.toml:4.*high_m: 3.*differ from low_m' "$ARCUS" render s.toml
surface 'type = "terrain", file = "sky.ppm", low_m = 100, high_m = 300' 'albedo = 0.5'
expect 2 's.toml: camera.position_m: a place [0-9.]+ m below the land' "$ARCUS" render s.toml
ppm 5000 4000 >wide.ppm
yes '7 7 7' | head -n 20000000 >>wide.ppm
surface 'type = "terrain", file = "wide.ppm"' 'albedo = 0.5'
expect 2 'wide.ppm: 5000 x 4000 heights found; at most 16777216' "$ARCUS" render s.toml
rm wide.ppm
surface 'type = "plane"' 'pattern = "image"'
expect 2 's.toml:5.*image: nothing.*name of a picture' "$ARCUS" render s.toml
surface 'type = "plane"' 'pattern = "image", image = "nowhere.png"'
expect 2 'nowhere.png: no file' "$ARCUS" render s.toml
surface 'type = "plane"' 'pattern = "image", image = "sky.ppm", image_size_m = [0, 1]'
expect 2 's.toml:5.*image_size_m.*above 0' "$ARCUS" render s.toml
surface 'type = "plane"' 'albedo_file = "nowhere.txt"'
expect 2 'nowhere.txt' "$ARCUS" render s.toml
printf '400 0.5\n500 1.5\n' >bright.txt
surface 'type = "plane"' 'albedo_file = "bright.txt"'
expect 2 'bright.txt: a share of 1.5' "$ARCUS" render s.toml
surface 'type = "plane"' 'albedo_file = "bright.txt", pattern = "checker"'
expect 2 's.toml:5.*albedo_file.*must be left out' "$ARCUS" render s.toml

# Photon maps.
photons() { printf '[render]\nintegrator = "photon_map"\n%s\n[camera]\nresolution = [4, 4]\n%s\n' "$1" "$2" >p.toml; }
ball='[[surface]]
shape = { type = "sphere" }
material = { albedo = 0.5 }'
photons 'photons = 0' "$ball"
expect 2 'p.toml:3.*photons: 0.*between 1' "$ARCUS" render p.toml
photons 'neighbours = 2000' "$ball"
expect 2 'p.toml:3.*neighbours: 2000.*between 1 and 1000' "$ARCUS" render p.toml
photons 'iterations = -1' "$ball"
expect 2 'p.toml:3.*iterations: -1' "$ARCUS" render p.toml
photons 'passes = 0' "$ball"
expect 2 'p.toml:3.*passes: 0' "$ARCUS" render p.toml
photons '' '[sun]
irradiance_scale = 0
[[surface]]
shape = { type = "sphere" }'
expect 2 "'photon_map' and a sun without light" "$ARCUS" render p.toml
photons '' '[[surface]]
shape = { type = "plane" }'
expect 2 "'photon_map' and planes alone" "$ARCUS" render p.toml
photons 'photons = 100' '[[surface]]
shape = { type = "sphere" }
material = { type = "mirror" }'
expect 2 'no photon that has landed, of 100 sent' "$ARCUS" render p.toml
photons 'photons = 1000' "$ball"
must "$ARCUS" render p.toml --quiet
surface 'type = "disc", radius_m = 1, inner_radius_m = 1' 'albedo = 0.5'
expect 2 's.toml:4.*inner_radius_m: 1 found; must be less than radius_m = 1' "$ARCUS" render s.toml
drops() { printf '[render]\nintegrator = "path"\n[camera]\nresolution = [8, 8]\n[[droplets]]\n%s\n' "$1" >d.toml; }
drops 'box_m = [[0, 0, 0], [1, 1]]'
expect 2 'd.toml:6.*box_m.*two corners' "$ARCUS" render d.toml
drops 'count = 0'
expect 2 'd.toml:6.*count: 0' "$ARCUS" render d.toml
drops 'radius_um = { effective = 20000000 }'
expect 2 'droplets\[0\]: box_m.*must fit into the box' "$ARCUS" render d.toml
drops "$(printf 'count = 5000\nradius_um = { effective = 900000 }')"
expect 2 'droplets\[0\]: [0-9]+ of 5000 drops without room.*larger box' "$ARCUS" render d.toml
drops 'medium = "rain"'
expect 2 "droplets\[0\]: medium: 'rain' found; the name of a \[\[medium\]\]" "$ARCUS" render d.toml
drops "$(printf 'medium = "rain"\nbox_m = [[0, 0, 0], [1, 1, 1]]')"
expect 2 'd.toml:7.*box_m' "$ARCUS" render d.toml
"$ARCUS" author box -o grey.vdb --quiet --phase-type hg
drops "$(printf 'medium = "grey"\n[[medium]]\nname = "grey"\nvdb = "grey.vdb"')"
expect 2 "droplets\[0\]: medium: 'grey' with a phase function of type 'hg'.*mie or rain" "$ARCUS" render d.toml
printf '[[medium]]\nvdb = "grey.vdb"\n' >g.toml
expect 2 "medium .*phase function of type 'hg' found; drops expected" "$ARCUS" compare-droplets g.toml -o r.html
printf '[camera]\nresolution = [8, 8]\n' >g.toml
expect 2 'g.toml: no \[\[medium\]\]' "$ARCUS" compare-droplets g.toml -o r.html
expect 2 'runs' "$ARCUS" compare-droplets g.toml -o r.html --runs 2
absent r.html
drops 'count = 4000000000'
expect 1 'droplets\[0\]: 4e\+09 drops need about .* enough for' "$ARCUS" render d.toml
scene d.toml '[render]' 'integrator = "path"'
expect 2 "render.integrator: 'path' and a medium.*'volume_path' or 'photon_map' expected" "$ARCUS" render d.toml -o d.exr
absent d.exr

# Recipes.
printf 'type = "mie"\nsize_um = -3\n' >r.toml
expect 2 'r.toml:2.*size_um: -3' "$ARCUS" phase compute r.toml
printf 'type = "mei"\n' >r.toml
expect 2 "r.toml:1.*Did you mean 'mie'" "$ARCUS" phase compute r.toml
printf 'type = "hg"\ng = 1.5\n' >r.toml
expect 2 'r.toml:2.*g: 1.5' "$ARCUS" phase compute r.toml
expect 2 'none.toml' "$ARCUS" phase eval none.toml
mkdir tables
printf 'type = "table"\nfile = "t.txt"\n' >tables/r.toml
expect 2 'tables/t.txt' "$ARCUS" phase compute tables/r.toml -o t.nc
printf '0 1\n90 -1\n180 1\n' >tables/t.txt
expect 2 'tables/t.txt: the value -1' "$ARCUS" phase compute tables/r.toml -o t.nc
printf 'CDF\001' >tables/t.txt
expect 2 'tables/t.txt: 4 bytes found' "$ARCUS" phase compute tables/r.toml -o t.nc
absent t.nc
expect 2 'size' "$ARCUS" phase sphere --x -1
expect 2 'angles' "$ARCUS" phase sphere --x 1 --angles-deg 0:x:3
expect 2 'angles' "$ARCUS" phase sphere --x 1 --angles-deg 0,200

# VDB files: no VDB at all, cut short anywhere.
printf 'not a grid' >b.vdb
scene a.toml
expect 2 'b.vdb' "$ARCUS" render a.toml --set medium.0.vdb=b.vdb
size=$(stat -c %s box.vdb)
for part in 1 2 3 5 8 9; do
  head -c $((size * part / 10)) box.vdb >cut.vdb
  expect 2 'cut.vdb' "$ARCUS" render a.toml --set medium.0.vdb=cut.vdb
  expect 2 'cut.vdb' "$ARCUS" info cut.vdb
done
absent a.exr a.png

# NaN in an array that becomes a grid.
printf '0,0,0,1\n1,0,0,nan\n' >points.csv
expect 2 'points.csv:2|nan' "$ARCUS" author field --file points.csv -o nan.vdb
absent nan.vdb

# The water of a cloud model.
les() {  # les FILE LINES...: a small model output with changes
  printf 'netcdf les { dimensions: z = 2, y = 2, x = 2; variables: float x(x), y(y), z(z), QC(z, y, x); x:units = "m"; y:units = "m"; z:units = "m"; QC:units = "g/m3";
    %s
    data: x = 0, 50; y = 0, 50; z = 500, 520; QC = 0, 0, 0, 0.1, 0, 0.2, 0.2, 0.3; %s }\n' "$2" "$3" | ncgen -o "$1"
}
les les.nc '' ''
expect 2 'no variable .QD. .water.*Did you mean .QC' "$ARCUS" author field --file les.nc --water QD -o les.vdb
expect 2 'no variable .NC. .number' "$ARCUS" author field --file les.nc --number NC -o les.vdb
head -c $(($(stat -c %s les.nc) - 5)) les.nc >cut.nc
expect 2 'cut.nc: [0-9]+ bytes found; [0-9]+ expected by its header' "$ARCUS" author field --file cut.nc -o les.vdb
printf 'hello' >text.nc
expect 2 'text.nc: no NetCDF file' "$ARCUS" author field --file text.nc -o les.vdb
expect 2 'none.nc: no file' "$ARCUS" author field --file none.nc -o les.vdb
les les.nc 'QC:units = "furlong";' ''
expect 2 "units 'furlong' found.*g/kg.*water_unit" "$ARCUS" author field --file les.nc -o les.vdb
les les.nc '' 'QC = 0, 0, 0, 0.1, 0, -0.2, 0.2, 0.3;'
expect 2 'x = 50 m, y = 0 m, z = 520 m: -0.2 g/m3' "$ARCUS" author field --file les.nc -o les.vdb
les les.nc 'x:units = "degrees_east";' ''
expect 2 'latitude or longitude.*Project' "$ARCUS" author field --file les.nc -o les.vdb
printf '2\n2 2 2\n0.05 0.05\n0.5 0.55 0.6\n288 288 288\n1 1 1 0.2 8\n2 2 2 0.4' >cut.lwc
expect 2 'cut.lwc:7: 4 columns' "$ARCUS" author field --file cut.lwc -o les.vdb
printf '[[medium]]\n' >text.lwc
expect 2 'text.lwc:1' "$ARCUS" author field --file text.lwc -o les.vdb
absent les.vdb

# Clouds of ice.
expect 2 'shares: 2 numbers found; one, or one for each of 3 habits' "$ARCUS" author cirrus --shares 1,2 -o ice.vdb
expect 2 "habits.*'sphere'" "$ARCUS" author cirrus --habits plate,sphere -o ice.vdb
expect 2 "'plate' twice" "$ARCUS" author cirrus --habits plate,plate -o ice.vdb
expect 2 'top_m.*must be above base_m' "$ARCUS" author cirrus --top-m 6000 -o ice.vdb
expect 2 'cell_depth_m: 3000 found; must be less than' "$ARCUS" author cirrus --cell-depth-m 3000 -o ice.vdb
expect 2 'ground_temperature_c: .* C at 500 m found; below 0 C' "$ARCUS" author cirrus --base-m 500 -o ice.vdb
expect 2 'at most 2e9 expected' "$ARCUS" author cirrus --voxel-m 1 -o ice.vdb
expect 2 'number_per_l: 0 found; must be above 0' "$ARCUS" author diamond-dust --number-per-l 0 -o ice.vdb
expect 2 'temperature_c: 5 found' "$ARCUS" author diamond-dust --temperature-c 5 -o ice.vdb
absent ice.vdb

# Outputs that cannot be written: exit 1, before any work.
scene a.toml
expect 1 'cannot write' "$ARCUS" render a.toml -o no_such_folder/a.exr
expect 1 'cannot write' "$ARCUS" author box -o no_such_folder/a.vdb
mkdir folder.exr
expect 1 'folder' "$ARCUS" render a.toml -o folder.exr
rmdir folder.exr
if [ -w /dev/full ] && [ "$(id -u)" -ne 0 ]; then
  mkdir locked && chmod 555 locked
  expect 1 'cannot write' "$ARCUS" render a.toml -o locked/a.exr
fi

# Pictures: missing, no picture, cut short.
expect 2 'none.exr' "$ARCUS" profile none.exr
must "$ARCUS" render a.toml -o good.exr --spp 1 --quiet
head -c 300 good.exr >cut.exr
expect 2 'cut.exr' "$ARCUS" profile cut.exr
expect 2 'cut.exr' "$ARCUS" compare good.exr cut.exr
expect 2 'around' "$ARCUS" profile good.exr --around moon

# What reads and writes pictures takes longer to load than all of the rest, so nothing else waits for it; without it, a render ends before
# it begins.
checks=$((checks + 1))
if LD_TRACE_LOADED_OBJECTS=1 "$ARCUS" | grep -q OpenImageIO; then complain 'OpenImageIO is loaded at every start'; fi
mkdir alone && cp "$ARCUS" alone/arcus
expect 1 'cannot read or write pictures: arcus_image_codec' alone/arcus render a.toml -o alone/a.exr --spp 1
expect 1 'cannot read or write pictures: arcus_image_codec' alone/arcus profile good.exr
absent alone/a.exr

# Recipes of crystals: values that make none, and shapes at the ends of what does.
crystal() {  # crystal LINE...: a small recipe of prisms that lie at random, with lines added
  { printf 'type = "crystal"\nhabit = "prism"\nwavelength_nm = 550\nrays_million = 0.02\n'
    printf '%s\n' "$@"; } >ice.toml
}
crystal 'size_um = -1'
expect 2 'ice.toml:5:11: size_um' "$ARCUS" phase compute ice.toml -o ice.nc
crystal 'aspect_ratio = -2'
expect 2 'aspect_ratio' "$ARCUS" phase compute ice.toml -o ice.nc
crystal 'aspect_ratio = 0'
expect 2 'aspect_ratio' "$ARCUS" phase compute ice.toml -o ice.nc
crystal 'size_spread = 3'
expect 2 'size_spread' "$ARCUS" phase compute ice.toml -o ice.nc
crystal 'upper_pyramid.height = 2'
expect 2 'upper_pyramid.height' "$ARCUS" phase compute ice.toml -o ice.nc
crystal 'orientation = { type = "plate", tilt_deg = nan }'
expect 2 'tilt_deg' "$ARCUS" phase compute ice.toml -o ice.nc
crystal 'orientation = { type = "sideways" }'
expect 2 "orientation.type.*'sideways'" "$ARCUS" phase compute ice.toml -o ice.nc
crystal 'material = { n = 0.9, k = 0 }'
expect 2 'index of 0.9.*above 1' "$ARCUS" phase compute ice.toml -o ice.nc
printf 'type = "crystal"\nhabit = "prism"\nrays_million = -1\n' >ice.toml
expect 2 'rays_million: -1 found' "$ARCUS" phase compute ice.toml -o ice.nc
absent ice.nc
for line in 'aspect_ratio = 1e-4' 'aspect_ratio = 1e4' 'upper_pyramid = { height = 1 }' 'size_um = 10000' 'size_um = [1, 10000]'; do
  crystal "$line"
  must "$ARCUS" phase eval ice.toml --size-um 100 --angles-deg 0,22,180
  must "$ARCUS" phase compute ice.toml -o ice.nc
  must "$ARCUS" info ice.nc
done
rm -f ice.nc

# The moon, the night, the sea.
printf '[camera]\nresolution = [4, 4]\n' >m.toml
expect 2 "sun.body: text 'mars' found; must be sun or moon" "$ARCUS" render m.toml --set sun.body=mars
expect 2 'sun.phase_angle_deg.*between 0 and 175' "$ARCUS" render m.toml --set sun.body=moon --set sun.phase_angle_deg=180
expect 2 'sun.phase_angle_deg' "$ARCUS" render m.toml --set sun.phase_angle_deg=90
expect 2 "film.adaptation: text 'dusk' found; must be day or night" "$ARCUS" render m.toml --set film.adaptation=dusk
expect 2 "film.adaptation.*Did you mean 'night'" "$ARCUS" render m.toml --set film.adaptation=nigt
sea() { printf '[camera]\nresolution = [4, 4]\n[[surface]]\nshape = { type = "plane" }\nmaterial = { type = "sea", %s }\n' "$1" >s.toml; }
sea 'wind_m_per_s = -1'
expect 2 's.toml:5.*wind_m_per_s: -1.*between 0 and 30' "$ARCUS" render s.toml
sea 'water_albedo = [0.1, 0.2]'
expect 2 's.toml:5.*water_albedo: 2 numbers.*1 or 3' "$ARCUS" render s.toml
sea 'water_albedo = 0.9'
expect 2 's.toml:5.*water_albedo.*between 0 and 0.5' "$ARCUS" render s.toml
sea 'slopes = "isotropic", wind_from_deg = 20'
expect 2 's.toml:5.*wind_from_deg' "$ARCUS" render s.toml
sea 'wind_m_per_s = 5'
for other in whitted ray_cast photon_map; do
  expect 2 "'$other' and a surface of type 'sea'.*'volume_path' or 'path' expected" "$ARCUS" render s.toml --set render.integrator=$other
done
must "$ARCUS" render s.toml --set render.samples_per_pixel=1 --quiet

# The clear sky.
expect 2 'camera.position_m.*below sea level' "$ARCUS" render a.toml --set sky.type=clear --set camera.position_m=[0,0,-3]
expect 2 "'whitted' and a clear sky" "$ARCUS" render a.toml --set sky.type=clear --set render.integrator=whitted
expect 2 'ozone_dobson_units' "$ARCUS" render a.toml --set sky.type=clear --set sky.ozone_dobson_units=-1

# The sky of crystals.
printf 'type = "crystal"\nhabit = "plate"\nwavelength_nm = 550\nrays_million = 0.01\nmap_step_deg = 5\n' >plates.toml
printf 'type = "hg"\n' >hg.toml
expect 2 "--ray-path: '3-x'.*as 3-5" "$ARCUS" phase plot plates.toml -o sky.png --ray-path 3-x
expect 2 "--without-path: ''" "$ARCUS" phase plot plates.toml -o sky.png --without-path ''
expect 2 "face 13 in '3-13'.*faces 1, 2, 3, 4, 5, 6, 7, 8" "$ARCUS" phase plot plates.toml -o sky.png --ray-path 3-5 --ray-path 3-13
expect 2 'sun-elevation-deg.*91' "$ARCUS" phase plot plates.toml -o sky.png --sun-elevation-deg 91
expect 2 '--weights: 1 number found.*2 in all' "$ARCUS" phase plot plates.toml plates.toml -o sky.png --weights 1
expect 2 '--weights' "$ARCUS" phase plot plates.toml -o sky.png --weights -1
expect 2 '--weights' "$ARCUS" phase plot plates.toml -o sky.png --weights 0
expect 2 '--paths-at.*AZIMUTH,ELEVATION' "$ARCUS" phase plot plates.toml --paths-at 20
expect 2 '--paths-at.*AZIMUTH,ELEVATION' "$ARCUS" phase plot plates.toml --paths-at 20,100
expect 2 '--projection' "$ARCUS" phase plot plates.toml -o sky.png --projection flat
expect 2 '--output: nothing' "$ARCUS" phase plot plates.toml
expect 2 "type 'hg'.*recipes of crystals" "$ARCUS" phase plot plates.toml hg.toml -o sky.png
expect 2 "type 'hg'.*ray paths" "$ARCUS" phase plot hg.toml -o sky.png --ray-path 3-5
expect 2 "plates.toml: crystals that lie as 'plate'" "$ARCUS" phase plot plates.toml --curves -o sky.png
expect 2 'none.toml' "$ARCUS" phase plot plates.toml none.toml -o sky.png
absent sky.png

# A damaged table in the cache is computed again, with a warning.
printf 'type = "mie"\nsize_um = 2\nradii = 200\nwavelength_nm = { min = 500, max = 600, nodes = 2 }\n' >small.toml
must "$ARCUS" phase compute small.toml
table=$(find cache -name '*.nc' -newer small.toml)
[ -n "$table" ] || complain "no table in the cache"
cp "$table" whole.nc
for offset in 5000 $(($(stat -c %s "$table") / 2)); do
  printf 'XXXXXXXXXXXXXXXX' | dd of="$table" bs=1 seek="$offset" conv=notrunc status=none
  expect 0 'damaged|computed again|made again' "$ARCUS" phase compute small.toml -o again.nc
  cp whole.nc "$table"
done
head -c 1000 whole.nc >"$table"
expect 0 'damaged|computed again|made again' "$ARCUS" phase compute small.toml -o again.nc

finish
