# cmake -D ROOT=folder -P rules.cmake: fails, with every place, where sources of ROOT break the architecture.
cmake_minimum_required(VERSION 3.25)

# What the files of a folder may include of ours; all of it by its path from the root.
set(may_include_dem dem)
set(may_include_meshes meshes dem)
set(may_include_reports reports)
# Of dem/core what knows nothing of discs: threads, and filters of leapfrog states.
set(may_include_fem_reference fem_reference dem/core/team.h dem/core/time_filter.h meshes/strip_mesh.h meshes/user_mesh.h)
set(may_include_harness harness reports dem meshes/packings)

# What else must not stand in a folder's sources: regular expressions.
set(never_in_dem
  "(^|[^a-z_])virtual[^a-z_]"
  "#include *<(hdf5|deal\\.II|gmsh|toml|nlohmann|CLI)"
  "#include *<(iostream|fstream|ostream|iomanip|cstdio|stdio.h|filesystem|fmt/ostream.h)>"
  "fmt::print"
  "(^|[^a-z_])f?printf *\\(")
set(never_in_meshes "#include *<(hdf5|deal\\.II|iostream)" "fmt::print")
set(never_in_reports "#include *<(hdf5|deal\\.II|gmsh|Eigen)")
set(never_in_harness "#include *<(deal\\.II|gmsh)")

set(violations "")

# Lines of `file` that match; comments are not code.
function(find_lines file regex result)
  file(STRINGS ${ROOT}/${file} lines REGEX "${regex}")
  list(FILTER lines EXCLUDE REGEX "^ *//")
  set(${result} "${lines}" PARENT_SCOPE)
endfunction()

function(add_violation file line)
  string(STRIP "${line}" line)
  list(APPEND violations "${file}: ${line}")
  set(violations "${violations}" PARENT_SCOPE)
endfunction()

function(check_includes folder file)
  find_lines(${file} "^ *# *include *\"" includes)
  foreach(line IN LISTS includes)
    string(REGEX REPLACE ".*\"(.*)\".*" "\\1" header "${line}")
    set(allowed NO)
    foreach(prefix IN LISTS may_include_${folder})
      if(header STREQUAL prefix OR header MATCHES "^${prefix}/")
        set(allowed YES)
      endif()
    endforeach()
    if(NOT allowed OR header MATCHES "\\.\\.")
      add_violation(${file} "${line}")
    endif()
  endforeach()
  set(violations "${violations}" PARENT_SCOPE)
endfunction()

foreach(folder dem meshes reports fem_reference harness)
  file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.cc)
  if(NOT sources)
    message(FATAL_ERROR "no sources in ${ROOT}/${folder}")
  endif()
  foreach(file IN LISTS sources)
    check_includes(${folder} ${file})
    foreach(regex IN LISTS never_in_${folder})
      find_lines(${file} "${regex}" hits)
      foreach(line IN LISTS hits)
        add_violation(${file} "${line}")
      endforeach()
    endforeach()
  endforeach()
endforeach()

# Checks for NaN vanish with fast-math.
file(GLOB_RECURSE builds RELATIVE ${ROOT} ${ROOT}/dem/* ${ROOT}/meshes/* ${ROOT}/reports/* ${ROOT}/fem_reference/*
  ${ROOT}/harness/* ${ROOT}/.ci/cmake/*)
foreach(file IN LISTS builds ITEMS CMakeLists.txt CMakePresets.json)
  find_lines(${file} "-Ofast|fast-math|unsafe-math|finite-math-only" hits)
  foreach(line IN LISTS hits)
    add_violation(${file} "${line}")
  endforeach()
endforeach()

if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "against the architecture:\n  ${text}")
endif()
