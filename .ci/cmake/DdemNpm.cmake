# JavaScript libraries by npm's client: packed at a pinned version, checked, unpacked into the build folder. Without npm or
# network they are missing, which costs interactive figures or tests in a browser, never the build.

# ddem_npm_package(NAME VERSION SHA512 FOLDER): FOLDER becomes the unpacked package's folder, or empty with a message why.
function(ddem_npm_package name version sha512 folder)
  set(home ${CMAKE_BINARY_DIR}/npm/${name}-${version})
  set(${folder} ${home}/package PARENT_SCOPE)
  if(EXISTS ${home}/package/package.json)
    return()
  endif()
  set(${folder} "" PARENT_SCOPE)
  find_program(DDEM_NPM npm)
  if(NOT DDEM_NPM)
    message(STATUS "no npm, hence no ${name}")
    return()
  endif()
  # Who cannot reach the registry waits once.
  get_property(failed GLOBAL PROPERTY DDEM_NPM_FAILED)
  if(failed)
    message(STATUS "npm failed before, hence no ${name}")
    return()
  endif()
  file(MAKE_DIRECTORY ${home})
  execute_process(
    COMMAND ${DDEM_NPM} pack ${name}@${version} --loglevel=error --fetch-retries=1 --fetch-retry-mintimeout=1000 --fetch-timeout=15000
      --pack-destination ${home}
    WORKING_DIRECTORY ${home} TIMEOUT 60 RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE error)
  file(GLOB archives ${home}/*.tgz)
  if(NOT result EQUAL 0 OR NOT archives)
    set_property(GLOBAL PROPERTY DDEM_NPM_FAILED TRUE)
    message(STATUS "npm could not fetch ${name} ${version}: ${result}\n${error}")
    return()
  endif()
  list(GET archives 0 archive)
  file(SHA512 ${archive} found)
  if(NOT found STREQUAL sha512)
    file(REMOVE ${archive})
    message(WARNING "${name} ${version} is not what it was: SHA-512 ${found} instead of ${sha512}; it is not used")
    return()
  endif()
  file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${home}/unpacked)
  file(RENAME ${home}/unpacked/package ${home}/package)
  set(${folder} ${home}/package PARENT_SCOPE)
endfunction()
