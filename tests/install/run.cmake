# Installs the build tree into a folder of its own, checks what is there, and builds and runs examples/library with it.
# cmake -DBUILD=… -DSOURCE=… -DWORK=… -DGENERATOR=… -DCXX=… -DTYPE=… -P run.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGN}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
set(prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})

foreach(file bin/oriel share/oriel/rules/residential.yaml include/oriel/oriel/oriel.h
        include/oriel/model/version.h)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
# The studio says its address until it is ended.
execute_process(COMMAND timeout -s INT 3 ${prefix}/bin/oriel studio --no-browser ${SOURCE}/examples/samples/house.stripped.city.json
                OUTPUT_VARIABLE address ERROR_VARIABLE said)
if(NOT address MATCHES "^http://127[.]0[.]0[.]1:[0-9]+/")
  message(FATAL_ERROR "the installed studio does not open: ${address}${said}")
endif()
# Nothing private, and nothing that is of this machine.
file(GLOB_RECURSE headers ${prefix}/include/*)
foreach(header ${headers})
  if(header MATCHES "/(detail|pipeline)/" OR NOT header MATCHES "[.](h|inc)$")
    message(FATAL_ERROR "installed, but private: ${header}")
  endif()
endforeach()
file(GLOB_RECURSE exports ${prefix}/*.cmake)
foreach(export ${exports})
  file(READ ${export} text)
  string(FIND "${text}" "${SOURCE}" place)
  if(NOT place EQUAL -1)
    message(FATAL_ERROR "${export} names the source folder ${SOURCE}")
  endif()
endforeach()

set(sample ${SOURCE}/examples/samples/house.stripped.city.json)
run(${prefix}/bin/oriel rules check ${prefix}/share/oriel/rules/residential.yaml)
run(${prefix}/bin/oriel generalise ${sample} --scale 1:20000 -o ${WORK}/out.city.json)

# Away from the source tree, so that only installed headers are found.
file(COPY ${SOURCE}/examples/library/main.cpp ${SOURCE}/examples/library/CMakeLists.txt DESTINATION ${WORK}/consumer)
run(${CMAKE_COMMAND} -S ${WORK}/consumer -B ${WORK}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_BUILD_TYPE=${TYPE} -DCMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/library ${sample} ${WORK}/labelled.city.json ${WORK}/coarse.city.json)
message("${output}")
# What the library writes is what the command writes.
run(${prefix}/bin/oriel label ${sample} -o ${WORK}/command.city.json)
run(${CMAKE_COMMAND} -E compare_files ${WORK}/labelled.city.json ${WORK}/command.city.json)
file(REMOVE_RECURSE ${WORK})
