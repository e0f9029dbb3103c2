# cmake --install, and a Debian package by cpack. The programs find each other and share/ddem from where they stand, so
# that an installed tree may be moved.
include(GNUInstallDirs)
set(share ${CMAKE_INSTALL_DATADIR}/ddem)

install(TARGETS ddem RUNTIME)
foreach(program ddem-fem ddem-lammps)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME)
  endif()
endforeach()
install(FILES ${CMAKE_BINARY_DIR}/share/ddem/plotly-cartesian.min.js ${CMAKE_BINARY_DIR}/share/ddem/commit DESTINATION ${share} OPTIONAL)
install(FILES harness/campaign/summary.schema.json harness/solvers/scene.schema.json DESTINATION ${share}/schemas)
# As in the checkout, so that the paths and links of README and guide hold there.
install(DIRECTORY harness/scenes harness/campaigns harness/guide DESTINATION ${share}/harness)
install(DIRECTORY harness/solvers/examples DESTINATION ${share}/harness/solvers)
install(FILES harness/campaign/summary.schema.json DESTINATION ${share}/harness/campaign)
install(FILES harness/solvers/scene.schema.json DESTINATION ${share}/harness/solvers)
install(DIRECTORY reports/example DESTINATION ${share}/reports)
install(DIRECTORY dem/lammps/example DESTINATION ${share}/dem/lammps)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${share})
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
# As Debian wants them.
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(CODE "execute_process(COMMAND gzip -9nc ${CMAKE_SOURCE_DIR}/CHANGELOG.md
  OUTPUT_FILE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}/changelog.gz\")")

# Made by the program itself: completion for shells, and a man page a command (help2man).
set(made ${CMAKE_BINARY_DIR}/share)
set(completions ${made}/completions/ddem ${made}/completions/_ddem)
add_custom_command(OUTPUT ${completions}
  COMMAND ddem completion bash > ${made}/completions/ddem
  COMMAND ddem completion zsh > ${made}/completions/_ddem
  DEPENDS ddem COMMENT "Completion for bash and zsh" VERBATIM)
file(MAKE_DIRECTORY ${made}/completions)
add_custom_target(completions ALL DEPENDS ${completions})
install(FILES ${made}/completions/ddem DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${made}/completions/_ddem DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)

find_program(DDEM_HELP2MAN help2man)
if(DDEM_HELP2MAN)
  add_custom_command(OUTPUT ${made}/man/ddem.1.gz
    COMMAND sh ${CMAKE_SOURCE_DIR}/.ci/man-pages ${DDEM_HELP2MAN} $<TARGET_FILE:ddem> ${DDEM_VERSION} ${made}/man
    DEPENDS ddem .ci/man-pages COMMENT "Man pages" VERBATIM)
  add_custom_target(man ALL DEPENDS ${made}/man/ddem.1.gz)
  install(DIRECTORY ${made}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VERSION ${DDEM_VERSION})
set(CPACK_PACKAGE_CONTACT "the ddem authors <ddem@ddem.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "validation of deformable discrete elements against continua")
set(CPACK_PACKAGE_DESCRIPTION
  "Sends waves through strips of bonded discs (DEM and deformable DEM) and through\nfinite-element models of the same strips, and compares wave speeds and Poisson's\nratios with static moduli and closed forms: nightly validation, reports, and\ncalibration of contact stiffness. Judges other DEM programs as well.")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
