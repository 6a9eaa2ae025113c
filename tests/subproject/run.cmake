# Configures the parent project without a warning, and compiles the example and the first room; with WHOLE, the whole library, and
# runs the example.
# cmake -DSOURCE=… -DWORK=… -DGENERATOR=… -DCXX=… -DFLAGS=… -DWHOLE=ON|OFF -P run.cmake
file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE}/tests/subproject -B ${WORK} -G ${GENERATOR} -DORIEL_SOURCE=${SOURCE} -DORIEL_UNITY=ON
                        -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE warnings)
if(NOT result EQUAL 0 OR warnings MATCHES "Warning")
  message(FATAL_ERROR "configuring said (${result}):\n${warnings}")
endif()
set(targets compiled_only oriel_base)
if(WHOLE)
  set(targets library)
endif()
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK} --target ${targets} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0 OR output MATCHES "warning:")
  message(FATAL_ERROR "building said (${result}):\n${output}")
endif()
if(NOT WHOLE)
  file(REMOVE_RECURSE ${WORK})
  return()
endif()
execute_process(COMMAND ${WORK}/library ${SOURCE}/examples/samples/house.stripped.city.json ${WORK}/labelled.city.json ${WORK}/coarse.city.json
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the example ended with ${result}:\n${output}")
endif()
message("${output}")
file(REMOVE_RECURSE ${WORK})
