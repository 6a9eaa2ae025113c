# Tests of the leaves that are built, and, where all are, of the whole command.
if(ORIEL_EXPERIMENTS)
  oriel_test(experiments oriel::experiments oriel::interpret oriel_generator yaml-cpp nlohmann_json::nlohmann_json)
  target_sources(test_experiments PRIVATE cli/command.cpp)
  target_compile_definitions(test_experiments PRIVATE ORIEL_COMMAND="$<TARGET_FILE:oriel>")
  add_dependencies(test_experiments oriel)
endif()
if(ORIEL_STUDIO)
  oriel_test(studio/editing oriel::studio oriel::interpret oriel::kernel)
  oriel_test(studio/session oriel::studio nlohmann_json::nlohmann_json)
  # Also runs `rules lsp` itself.
  oriel_test(studio/lsp oriel::studio nlohmann_json::nlohmann_json)
  target_sources(test_studio_lsp PRIVATE cli/command.cpp)
  target_compile_definitions(test_studio_lsp PRIVATE ORIEL_COMMAND="$<TARGET_FILE:oriel>")
  add_dependencies(test_studio_lsp oriel)
  oriel_test(studio/server oriel::studio nlohmann_json::nlohmann_json)
  target_compile_definitions(test_studio_server PRIVATE ORIEL_COMMAND="$<TARGET_FILE:oriel>")
  add_dependencies(test_studio_server oriel)
endif()
if(NOT ORIEL_EXPERIMENTS OR NOT ORIEL_STUDIO OR NOT ORIEL_TILES)
  return()
endif()

oriel_test(cli oriel::io oriel_generator nlohmann_json::nlohmann_json ZLIB::ZLIB meshoptimizer::meshoptimizer)
target_compile_definitions(test_cli PRIVATE ORIEL_COMMAND="$<TARGET_FILE:oriel>"
  ORIEL_GENERATE_COMMAND="$<TARGET_FILE:oriel-generate>" ORIEL_CUTS_COMMAND="$<TARGET_FILE:oriel-cuts>")
add_dependencies(test_cli oriel oriel-generate oriel-cuts)
add_test(NAME "cli: runs that are killed go on" COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/cli/kill_test.sh
         $<TARGET_FILE:oriel> $<TARGET_FILE:oriel-generate> 20)
set_tests_properties("cli: runs that are killed go on" PROPERTIES LABELS cli TIMEOUT 300)
# Downloads Snakemake where it is missing; says skipped where it cannot be had.
add_test(NAME "examples: a city in shards that is killed half-way goes on" COMMAND ${PROJECT_SOURCE_DIR}/examples/cluster/test.sh
         $<TARGET_FILE:oriel> $<TARGET_FILE:oriel-generate> 3)
set_tests_properties("examples: a city in shards that is killed half-way goes on" PROPERTIES LABELS examples TIMEOUT 300
                     SKIP_RETURN_CODE 77 COST 50)
# Clicks in a browser where there is one; 77 says that there is none.
add_test(NAME "cli: a page says in a browser what explain says" COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/view/test.sh $<TARGET_FILE:oriel>)
set_tests_properties("cli: a page says in a browser what explain says" PROPERTIES LABELS cli TIMEOUT 300 SKIP_RETURN_CODE 77)
# The page's sources, by Node where it is installed.
find_program(ORIEL_NODE node)
if(ORIEL_NODE)
  foreach(name palette bundle)
    add_test(NAME "studio: page ${name}" COMMAND ${ORIEL_NODE} ${CMAKE_CURRENT_SOURCE_DIR}/studio/page/${name}_test.mjs)
    set_tests_properties("studio: page ${name}" PROPERTIES LABELS cli)
  endforeach()
endif()
# The studio, in a browser where there is one.
add_test(NAME "studio: an author works in a browser" COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/studio/browser/run.sh $<TARGET_FILE:oriel>
         ${CMAKE_CURRENT_BINARY_DIR}/studio_browser)
set_tests_properties("studio: an author works in a browser" PROPERTIES LABELS cli TIMEOUT 300 SKIP_RETURN_CODE 77 COST 45)
# Tilesets before gltf-validator, 3d-tiles-tools and a browser; 77 says that they cannot be had.
add_test(NAME "cli: other programs take the tiles" COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/tiles/run.sh $<TARGET_FILE:oriel>
         $<TARGET_FILE:oriel-generate> ${CMAKE_CURRENT_BINARY_DIR}/tiles_judges)
set_tests_properties("cli: other programs take the tiles" PROPERTIES LABELS cli TIMEOUT 300 SKIP_RETURN_CODE 77 COST 30)
if(ORIEL_NODE)
  add_test(NAME "cli: page of tiles bundle" COMMAND ${ORIEL_NODE} ${CMAKE_CURRENT_SOURCE_DIR}/tiles/bundle_test.mjs)
  set_tests_properties("cli: page of tiles bundle" PROPERTIES LABELS cli)
endif()
# Runs of the command in which a call of the system fails, by a library that is loaded before all others. Nothing goes
# before a sanitizer's.
oriel_test(faults/commands nlohmann_json::nlohmann_json)
target_sources(test_faults_commands PRIVATE cli/command.cpp)
target_compile_definitions(test_faults_commands PRIVATE ORIEL_COMMAND="$<TARGET_FILE:oriel>")
add_dependencies(test_faults_commands oriel)
if(NOT ORIEL_SANITIZE AND NOT ORIEL_SANITIZE_THREADS)
  add_library(oriel_failing_calls MODULE faults/preload/failing_calls.cpp)
  target_compile_options(oriel_failing_calls PRIVATE -O1)
  target_link_libraries(oriel_failing_calls PRIVATE oriel_options ${CMAKE_DL_LIBS})
  target_compile_definitions(test_faults_commands PRIVATE ORIEL_FAILING_CALLS="$<TARGET_FILE:oriel_failing_calls>")
  add_dependencies(test_faults_commands oriel_failing_calls)
endif()
# The inputs of the fuzz targets (tests/fuzz), run by the compiler of the build.
add_subdirectory(fuzz)
oriel_test(fuzz/replay oriel_fuzz)
add_test(NAME "cli: slow cases" COMMAND test_cli "--test-case=slow:*")
set_tests_properties("cli: slow cases" PROPERTIES LABELS slow ENVIRONMENT ORIEL_SLOW=1 COST 100)
