# Writes what every Debian package has: its changelog and its copyright, into TO/share/doc/PACKAGE.
find_program(GZIP_PROGRAM gzip REQUIRED)
set(folder ${TO}/share/doc/${PACKAGE})
file(INSTALL ${PACKAGING}/debian/copyright DESTINATION ${CMAKE_INSTALL_PREFIX}/share/doc/${PACKAGE})
configure_file(${PACKAGING}/debian/changelog.in ${folder}/changelog @ONLY NEWLINE_STYLE UNIX)
execute_process(COMMAND ${GZIP_PROGRAM} -9nf ${folder}/changelog COMMAND_ERROR_IS_FATAL ANY)
file(CHMOD ${folder}/changelog.gz PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
