# cmake -D ROOT=folder -P rules.cmake: fails, with every place, where sources of ROOT break the architecture.
cmake_minimum_required(VERSION 3.25)

# What the files of a folder may include of ours; all of it by its path from the root.
set(may_include_dem dem)
set(may_include_meshes meshes dem)
set(may_include_reports reports)
# Of dem/core what knows nothing of discs: threads, and filters of leapfrog states.
set(may_include_fem_reference fem_reference dem/core/team.h dem/core/time_filter.h meshes/quad_mesh.h meshes/strip_mesh.h meshes/user_mesh.h)
set(may_include_harness harness reports dem meshes/packings)

# The method on LAMMPS: the styles know of ours the parameters of laws alone, and nothing of ours knows the styles.
set(may_include_dem/lammps dem/lammps dem/core/material.h)

# Rooms of the harness. A campaign knows its studies by registry.cc alone, and studies know of it what study.h says.
set(beneath reports dem meshes/packings harness/io harness/scene harness/model harness/measure harness/references harness/provenance)
set(may_include_harness/solvers ${beneath} harness/solvers)
set(may_include_harness/run ${beneath} harness/solvers harness/run)
set(may_include_harness/studies ${beneath} harness/solvers harness/run harness/bench harness/calibrate harness/nightly harness/studies
  harness/campaign/study.h harness/campaign/pieces.h harness/campaign/run_options.h harness/campaign/campaign_spec.h)
set(may_include_harness/campaign ${beneath} harness/solvers harness/run harness/nightly harness/campaign)
set(may_include_harness/campaign/registry.cc ${may_include_harness/campaign} harness/studies)

# What else must not stand in a folder's sources: regular expressions.
set(never_in_dem
  "(^|[^a-z_])virtual[^a-z_]"
  "#include *<(hdf5|deal\\.II|gmsh|toml|nlohmann|CLI)"
  "#include *<(iostream|fstream|ostream|iomanip|cstdio|stdio.h|filesystem|fmt/ostream.h)>"
  "fmt::print"
  "(^|[^a-z_])f?printf *\\(")
# LAMMPS calls back by virtual functions, and hands on files of the C library.
set(never_in_dem/lammps "#include *<(hdf5|deal\\.II|gmsh|toml|nlohmann|CLI|fmt|iostream|fstream|Eigen)")
set(outside_dem/lammps "#include *(<(lammps/|mpi\\.h)|\"dem/lammps/)")
set(never_in_meshes "#include *<(hdf5|deal\\.II|iostream)" "fmt::print")
set(never_in_reports "#include *<(hdf5|deal\\.II|gmsh|Eigen)")
# Messages go through harness/io/message.h, which survives a standard error that is closed or full.
# Numbers of users go into narrower types by narrow() of dem/core/narrow.h, which is checked.
set(narrower "(int|unsigned|long|short|std::u?int(8|16|32)_t)")
set(member "[A-Za-z_]+(\\.|->)[^()?]*")
set(never_in_harness "#include *<(deal\\.II|gmsh)" "(^|[^a-z_])(stderr|cerr|clog|perror)([^a-z_]|$)"
  "static_cast<${narrower}>\\(${member}\\)" "static_cast<${narrower}>\\(values\\.integer")

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
    string(REGEX MATCH "^(harness/[a-z]+|dem/lammps)" room ${file})
    foreach(rule ${file} ${room})
      if(DEFINED may_include_${rule})
        check_includes(${rule} ${file})
        break()
      endif()
    endforeach()
    set(never ${never_in_${folder}} ${outside_dem/lammps})
    if(room STREQUAL "dem/lammps")
      set(never ${never_in_dem/lammps})
    endif()
    foreach(regex IN LISTS never)
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
