# ninja guide: the guide as static pages with search, in build/*/guide. What it needs: .ci/packages-guide.txt.
find_program(DDEM_SPHINX sphinx-build)
find_path(DDEM_KATEX katex.min.js PATHS /usr/share/javascript/katex)
if(DDEM_SPHINX AND DDEM_KATEX)
  set(guide ${CMAKE_BINARY_DIR}/guide)
  add_custom_target(guide
    COMMAND ${CMAKE_COMMAND} -E env DDEM_KATEX=${DDEM_KATEX}
      ${DDEM_SPHINX} -q -E -W --keep-going -c ${CMAKE_SOURCE_DIR}/harness/guide/site -d ${guide}/.doctrees -b html
      ${CMAKE_SOURCE_DIR}/harness/guide ${guide}
    COMMAND ${CMAKE_COMMAND} -E copy ${guide}/README.html ${guide}/index.html
    COMMENT "The guide: ${guide}/index.html" VERBATIM)
endif()
