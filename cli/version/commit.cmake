# Writes the commit of the sources into a source file: cmake -DSOURCE=FOLDER -DFILE=FILE.cpp [-DCOMMIT=X] -P commit.cmake
# X if it is given; "unknown" without git, and where the sources are no git tree of their own.
cmake_policy(VERSION 3.22)
set(commit unknown)
find_program(GIT git)
if(COMMIT)
  set(commit ${COMMIT})
elseif(GIT)
  # The first line is where SOURCE stands in its tree: nothing, if it is the tree itself.
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-prefix --short=12 HEAD
                  OUTPUT_VARIABLE lines RESULT_VARIABLE result ERROR_QUIET)
  if(result EQUAL 0 AND lines MATCHES "^\n([0-9a-f]+)\n$")
    set(commit ${CMAKE_MATCH_1})
  endif()
endif()
file(CONFIGURE OUTPUT ${FILE} CONTENT "namespace oriel::cli {
extern const char* const kCommit;
const char* const kCommit = \"@commit@\";
}
" @ONLY)
