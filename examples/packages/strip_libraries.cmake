# CMake strips programs and leaves static libraries alone, in which Debian wants no debug symbols either.
file(GLOB libraries ${TO}/${LIBRARIES}/liboriel_*.a ${TO}/${LIBRARIES}/liboriel.a)
execute_process(COMMAND ${STRIP} --strip-debug --remove-section=.comment --remove-section=.note
                        --enable-deterministic-archives ${libraries}
                COMMAND_ERROR_IS_FATAL ANY)
