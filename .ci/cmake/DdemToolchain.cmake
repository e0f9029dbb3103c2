# Compiler flags, linker and cache: one interface target that every target of ours links.
# Libraries that several folders use; one that only one folder needs is found there.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(Threads REQUIRED)
include(CheckLinkerFlag)

get_filename_component(DDEM_ROOT ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

# bfd takes seconds on deal.II's libraries; lld and gold take a fraction.
check_linker_flag(CXX -fuse-ld=lld DDEM_HAS_LLD)
if(DDEM_HAS_LLD)
  add_link_options(-fuse-ld=lld)
endif()

add_library(ddem_flags INTERFACE)
target_compile_options(ddem_flags INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
  # g++ 12 sees overlaps in "text" + std::string that are not there.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # What the sanitizers add confuses g++ in what is initialised; the release build looks at it.
  $<$<AND:$<BOOL:${DDEM_SANITIZE}>,$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized>
  # No contraction: a fused multiply-add would give other bits on other instruction sets.
  -ffp-contract=off
  $<$<BOOL:${DDEM_WARNINGS_AS_ERRORS}>:-Werror>
  $<$<CONFIG:Release>:-O3>)
if(DDEM_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

if(DDEM_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# Explicit sources, flags and the repository root as the only include path: #include "dem/core/packing.h".
function(ddem_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${DDEM_ROOT})
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE ddem_flags)
endfunction()

# A GoogleTest executable: every test becomes a CTest of its own. LABELS nightly: left out of ./ddem test.
function(ddem_test name)
  cmake_parse_arguments(ARG "" "LABELS" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} ddem_flags GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE DDEM_ORACLES="${DDEM_ROOT}/tests/oracles")
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS "${ARG_LABELS}")
endfunction()
