# Makes the man pages of PROGRAMS and of their commands, into TO/share/man/man1.
execute_process(COMMAND bash ${PACKAGING}/man_pages.sh ${VERSION} "${DATE}" ${TO}/share/man/man1 ${PROGRAMS}
                COMMAND_ERROR_IS_FATAL ANY)
