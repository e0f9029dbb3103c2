# DDEM_VERSION, what programs and the package call themselves: of a commit with a tag vX.Y.Z that tag, which the project's
# version must equal; after a tag "X.Y.Z+N.gCOMMIT"; without tags or git the project's version.
set(DDEM_VERSION ${PROJECT_VERSION})
find_package(Git QUIET)
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${CMAKE_SOURCE_DIR} rev-parse --show-prefix
    OUTPUT_VARIABLE below ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE no_repository)
endif()
if(GIT_FOUND AND NOT no_repository AND NOT below)  # not a copy within another repository
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${CMAKE_SOURCE_DIR} describe --tags --match "v[0-9]*" --long
    OUTPUT_VARIABLE described ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(described MATCHES "^v([0-9.]+)-([0-9]+)-(g[0-9a-f]+)$")
    set(tag ${CMAKE_MATCH_1})
    if(CMAKE_MATCH_2 GREATER 0)
      set(DDEM_VERSION "${PROJECT_VERSION}+${CMAKE_MATCH_2}.${CMAKE_MATCH_3}")
    elseif(NOT tag VERSION_EQUAL PROJECT_VERSION)
      message(FATAL_ERROR "CMakeLists.txt says version ${PROJECT_VERSION}, the tag of this commit v${tag}")
    endif()
  endif()
  # The commit that a build was made of is a file beside the programs, and not in them: kept results are of a program, which a
  # commit of documents does not change.
  add_custom_target(commit ALL
    COMMAND ${CMAKE_COMMAND} -D GIT=${GIT_EXECUTABLE} -D SOURCE=${CMAKE_SOURCE_DIR} -D FILE=${CMAKE_BINARY_DIR}/share/ddem/commit
      -P ${CMAKE_CURRENT_LIST_DIR}/WriteCommit.cmake)
endif()
