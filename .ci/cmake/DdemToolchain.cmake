# Compiler flags, linker and cache: one interface target that every target of ours links.
# Libraries that several folders use; one that only one folder needs is found there.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(Threads REQUIRED)
include(CheckLinkerFlag)

get_filename_component(DDEM_ROOT ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)

# Paths count from the root, so that clones share what is compiled; precompiled headers are looked at by their content.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${DDEM_ROOT} CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()

# bfd takes seconds on deal.II's libraries; lld and gold take a fraction.
check_linker_flag(CXX -fuse-ld=lld DDEM_HAS_LLD)
if(DDEM_HAS_LLD)
  add_link_options(-fuse-ld=lld)
endif()

# Reading and instantiating headers takes most of the time. Names in unnamed namespaces are unique in a library.
if(DDEM_UNITY)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 32)
  # g++ takes up to 2.5 GB for such a source: as many at a time as there is memory for.
  cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY)  # MiB
  math(EXPR at_a_time "(${memory} + 2499) / 2500")
  set_property(GLOBAL APPEND PROPERTY JOB_POOLS compile=${at_a_time})
  set(CMAKE_JOB_POOL_COMPILE compile)
  # A source of several is not the main one, of which alone g++ lets a type have members of unnamed namespaces.
  # It begins to look for memory to free at 128 MB, which costs it a tenth of its time.
  set(DDEM_UNITY_FLAGS $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage;--param=ggc-min-heapsize=1000000>)
endif()

add_library(ddem_flags INTERFACE)
target_compile_options(ddem_flags INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
  # g++ 12 sees overlaps in "text" + std::string that are not there.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  ${DDEM_UNITY_FLAGS}
  # No contraction: a fused multiply-add would give other bits on other instruction sets.
  -ffp-contract=off
  # ccache needs it where headers are precompiled.
  $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
  $<$<BOOL:${DDEM_WARNINGS_AS_ERRORS}>:-Werror>)
if(DDEM_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  add_compile_definitions(DDEM_SANITIZED)
endif()
if(DDEM_FUZZ)
  add_link_options(-fsanitize=fuzzer-no-link)
endif()

# For the folders of the readers: the fuzzers watch which ways their bytes take. Compiling takes a fifth more time.
macro(ddem_watch_ways)
  if(DDEM_FUZZ)
    add_compile_options(-fsanitize=fuzzer-no-link)
  endif()
endmacro()

# For loops over discs and elements: what AddressSanitizer sees as well, wrong addresses, is left to it. Twice as fast, and files
# that took three minutes to compile take one.
set(DDEM_SANITIZED_LOOPS -O2 -fno-sanitize=null,alignment,object-size,pointer-overflow)
macro(ddem_sanitize_loops)
  if(DDEM_SANITIZE)
    add_compile_options(${DDEM_SANITIZED_LOOPS})
  endif()
endmacro()

# For folders without hot loops: a third less time to compile, half of it under the sanitizers.
macro(ddem_no_hot_loops)
  add_compile_options($<IF:$<BOOL:${DDEM_SANITIZE}>,-O0,$<$<CONFIG:Release>:-O1>>)
endmacro()

# Reading headers takes more than half of the time that most files take to compile. What follows in a folder and below reads
# these precompiled; files still include what they use, which a build with DDEM_PCH=OFF shows.
macro(ddem_precompiled_headers target)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK" ${ARGN})
  if(DDEM_PCH)
    file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${target}.cc CONTENT "// Nothing but its headers.
")
    add_library(${target} STATIC ${CMAKE_CURRENT_BINARY_DIR}/${target}.cc)
    target_link_libraries(${target} PRIVATE ${ARG_LINK} ddem_flags)
    target_precompile_headers(${target} PRIVATE ${ARG_HEADERS})
    set(DDEM_PRECOMPILED ${target})
  endif()
endmacro()

function(ddem_use_precompiled_headers target)
  if(DDEM_PRECOMPILED)
    target_precompile_headers(${target} REUSE_FROM ${DDEM_PRECOMPILED})
    # Of precompiled headers g++ 12 does not know that they are the system's, and warns of inlined strings that are right.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>)
  endif()
endfunction()

# Explicit sources, flags and the repository root as the only include path: #include "dem/core/packing.h".
function(ddem_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${DDEM_ROOT})
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE ddem_flags)
  ddem_use_precompiled_headers(${name})
endfunction()

# Where several sources are compiled as one, they are one of a target, but those APART, which use names that others use as well and are
# another, and those ALONE.
function(ddem_unity_groups target)
  cmake_parse_arguments(ARG "" "" "APART;ALONE" ${ARGN})
  get_target_property(sources ${target} SOURCES)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  set_source_files_properties(${sources} PROPERTIES UNITY_GROUP together)
  set_source_files_properties(${ARG_APART} PROPERTIES UNITY_GROUP apart)
  set_source_files_properties(${ARG_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# A GoogleTest executable: every test becomes a CTest of its own. LABELS nightly: left out of ./ddem test.
function(ddem_test name)
  cmake_parse_arguments(ARG "" "LABELS" "SOURCES;LINK" ${ARGN})
  set(properties)
  if(ARG_LABELS)
    set(properties PROPERTIES LABELS ${ARG_LABELS})
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} ddem_oracles ddem_flags GTest::gtest_main)
  ddem_use_precompiled_headers(${name})
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 ${properties})
endfunction()
