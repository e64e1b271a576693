# Reads every #include and finds those that run against the direction of the house:
#
#   cmake -D ROOT=<repository> -P tests/check_layers.cmake
#
#   phase <- media <- src <- tools, and inside each room its folders in their order; a package only
#   where it is isolated; include lines are paths from the root; no `using namespace`.
#
# Prints file:line and the rule for each violation, and fails if there is one.

cmake_minimum_required(VERSION 3.25)
if(NOT IS_DIRECTORY "${ROOT}/phase")
  message(FATAL_ERROR "ROOT: '${ROOT}' found; must be the repository, with phase/ in it")
endif()

# ---- what each folder may include, besides itself --------------------------------------------------

set(phase_order base settings optics particle crystal population function species)
set(src_words film light camera material shape)                    # they do not know one another
set(src_order scene photon integrator render farm analysis)

function(allow folder)
  set(allowed_${folder} ${folder} ${ARGN} PARENT_SCOPE)
endfunction()

set(left "")
foreach(folder ${phase_order})
  allow(phase/${folder} ${left})
  list(APPEND left phase/${folder})
endforeach()
set(phase ${left})

allow(media/space phase/base)
allow(media/air phase/base phase/optics phase/function phase/species media/space)
allow(media/grid phase/base phase/settings media/space)  # settings: numbers as text in messages
allow(media/author ${phase} media/space media/grid)
set(left media/space media/air media/grid)
foreach(folder majorant medium tracking)
  allow(media/${folder} ${phase} ${left})
  list(APPEND left media/${folder})
endforeach()
set(media ${left} media/author)

foreach(folder ${src_words})
  allow(src/${folder} ${phase} media/space media/air)
  list(APPEND src src/${folder})
endforeach()
list(APPEND allowed_src/shape src/material)
foreach(folder ${src_order})
  allow(src/${folder} ${phase} ${media} ${src})
  list(APPEND src src/${folder})
endforeach()

allow(tools ${phase} ${media} ${src})

# ---- packages ---------------------------------------------------------------------------------------

# package(<header> <files> <rule>): headers that match the first expression may be included by files
# whose path matches the second. Anything that is neither here nor part of the language or the system
# belongs to no room.
set(packages "")
macro(package header files rule)
  list(APPEND packages "${header}")
  set(files_${header} "${files}")
  set(rule_${header} "${rule}")
endmacro()
package("^Imath/" "^phase/base/" "Imath stays in phase/base")
package("^Random123/" "^phase/base/" "Random123 stays in phase/base")
package("^(oneapi/)?tbb/" "[.]cpp$" "TBB in sources, not in headers")
package("^toml(plus|[+][+]|[.]hpp)" "^phase/settings/toml_text[.]cpp$"
  "the TOML parser stays in phase/settings/toml_text.cpp")
package("^netcdf" "^phase/(base/netcdf_file|species/netcdf_table)[.]cpp$"
  "NetCDF stays in phase/base/netcdf_file.cpp and phase/species/netcdf_table.cpp")
package("^xxh" "^phase/(base/content_hash|species/[^/]*)[.]cpp$"
  "xxHash stays in phase/base/content_hash.cpp and sources of phase/species")
package("^nlohmann/" "^(phase/settings|src/film|src/analysis|src/render|src/farm|tools)/.*[.]cpp$"
  "JSON in sources of phase/settings, src/film, src/render, src/analysis and tools")
package("^openvdb/" "^media/grid/.*[.]cpp$" "OpenVDB stays in sources of media/grid")
package("^nanovdb/" "^tests/benchmarks/" "NanoVDB is there to be compared with")
package("^OpenImageIO/" "^src/film/image_codec[.]cpp$" "OpenImageIO stays in src/film/image_codec.cpp")
package("^embree" "^src/shape/intersector[.]cpp$" "Embree stays in src/shape/intersector.cpp")
package("^nanoflann" "^src/photon/point_tree[.]cpp$" "nanoflann stays in src/photon/point_tree.cpp")
package("^assimp/" "^src/shape/mesh_file[.]cpp$" "assimp stays in src/shape/mesh_file.cpp")
package("^cairo" "^src/analysis/canvas[.]cpp$" "Cairo stays in src/analysis/canvas.cpp")
package("^CLI/" "^tools/" "the option parser stays in tools")

set(language "^[a-z_0-9]+$")
set(system "^(sys/[a-z_]+|math|unistd|fcntl|signal|dirent|errno|time|pthread|sched|poll|spawn|immintrin|cpuid|dlfcn)[.]h$")

# ---- reading ----------------------------------------------------------------------------------------

set(violations 0)

function(violation file line rule)
  file(READ "${ROOT}/${file}" text)
  string(FIND "\n${text}" "\n${line}" position)
  string(SUBSTRING "\n${text}" 0 ${position} before)
  string(REGEX MATCHALL "\n" ends "${before}")
  list(LENGTH ends number)
  math(EXPR number "${number} + 1")
  string(STRIP "${line}" line)
  message("${file}:${number}: ${line}: ${rule}")
  math(EXPR violations "${violations} + 1")
  set(violations ${violations} PARENT_SCOPE)
endfunction()

# The folder of a file that counts: "phase/base" of phase/base/error.h, "tools" of tools/render.cpp.
function(folder_of file result)
  string(REGEX REPLACE "^(tools|tests|[^/]+/[^/]+)/.*$" "\\1" folder "${file}")
  set(${result} "${folder}" PARENT_SCOPE)
endfunction()

macro(check_own file line path)
  folder_of("${file}" from)
  folder_of("${path}" to)
  string(REGEX REPLACE "/.*" "" room "${file}")
  set(rooms "^(phase|media|src|tools|tests)/")
  if(NOT "${path}" MATCHES "${rooms}")
    violation("${file}" "${line}" "an include line is the file's path from the root of the repository")
  elseif(room STREQUAL "tests" OR "${path}" STREQUAL "${room}/data/embedded.h")
    # a test looks at everything; embedded.h is generated for its own room
  elseif(NOT to IN_LIST allowed_${from})
    violation("${file}" "${line}" "${from} may not include ${to}")
  endif()
endmacro()

macro(check_package file line header)
  set(known FALSE)
  foreach(package IN LISTS packages)
    if("${header}" MATCHES "${package}")
      set(known TRUE)
      if(NOT "${file}" MATCHES "${files_${package}}")
        violation("${file}" "${line}" "${rule_${package}}")
      endif()
    endif()
  endforeach()
  if("${header}" MATCHES "^(phase|media|src|tools|tests)/")
    violation("${file}" "${line}" "the repository's own files are included with quotes")
  elseif(NOT known AND NOT "${header}" MATCHES "${language}" AND NOT "${header}" MATCHES "${system}")
    violation("${file}" "${line}" "no room uses this package: tests/check_layers.cmake lists those in use")
  endif()
endmacro()

set(includes 0)
foreach(room phase media src tools tests)
  file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/${room}/*.h" "${ROOT}/${room}/*.cpp")
  foreach(file IN LISTS files)
    folder_of("${file}" folder)
    if(NOT room STREQUAL "tests" AND NOT DEFINED allowed_${folder})
      message("${file}: ${folder} has no place in the order of folders: tests/check_layers.cmake")
      math(EXPR violations "${violations} + 1")
      continue()
    endif()
    file(STRINGS "${ROOT}/${file}" lines ENCODING UTF-8
      REGEX "^[ \t]*(#[ \t]*include[ \t]*[<\"]|using[ \t]+namespace)")
    foreach(line IN LISTS lines)
      if(line MATCHES "using[ \t]+namespace")
        violation("${file}" "${line}" "no using namespace: name what is used")
      elseif(line MATCHES "include[ \t]*\"([^\"]*)\"")
        check_own("${file}" "${line}" "${CMAKE_MATCH_1}")
        math(EXPR includes "${includes} + 1")
      elseif(line MATCHES "include[ \t]*<([^>]*)>")
        if(NOT room STREQUAL "tests")
          check_package("${file}" "${line}" "${CMAKE_MATCH_1}")
        endif()
        math(EXPR includes "${includes} + 1")
      endif()
    endforeach()
  endforeach()
endforeach()

if(violations GREATER 0)
  message(FATAL_ERROR "layers: ${violations} violations in ${includes} include lines")
endif()
message("layers: ${includes} include lines, all in order")
