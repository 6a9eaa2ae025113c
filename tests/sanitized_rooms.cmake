# The rooms that read, mend and cut what comes from elsewhere, compiled once more with address and undefined-behaviour sanitizers
# and assertions, for their own tests. Left out, for CI's time: `validate`, mostly CGAL, and `interpret`, of which tests/fuzz/replay
# reads packs of every kind. The preset `asan` builds all of oriel so.
# Left out here are also the checks of each pointer (null, alignment, object size), which double the time to compile; the address
# sanitizer sees most of what they would; and the use of variables of a block that was left, which costs another quarter.
set(ORIEL_SANITIZED_ROOMS io solidify segment)
# Of io what only writes, and from values that were made here, for CI's time, too.
set(ORIEL_NOT_SANITIZED "/io/(./)?(gltf|gpkg|picture|tiles)/")
set(ORIEL_SANITIZERS
  -fsanitize=address,signed-integer-overflow,float-cast-overflow,shift,integer-divide-by-zero,bounds,enum,bool,return,unreachable
  -fno-sanitize-recover=all -fno-omit-frame-pointer -fno-sanitize-address-use-after-scope)
# Of optimisations as much as makes it fast to compile and to run together; for that, too, what is checked is a call.
set(ORIEL_SANITIZED_OPTIONS -O1 -g1 ${ORIEL_SANITIZERS}
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;--param=asan-instrumentation-with-call-threshold=0>)
set(ORIEL_THREAD_OPTIONS -O0 -g1 -fsanitize=thread $<$<CXX_COMPILER_ID:GNU>:-Wno-tsan>)

# What nearly every file includes is read once for all targets of the same flags; those of a target without libraries have fewest.
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/no_source.cpp "")
function(oriel_precompiled_headers name)
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/no_source.cpp)
  target_link_libraries(${name} PRIVATE oriel_options fmt::fmt)
  target_compile_options(${name} PRIVATE ${ARGN})
  target_precompile_headers(${name} PRIVATE ${ORIEL_COMMON_HEADERS})
endfunction()

# oriel_sanitized_test(ROOM TEST): TEST_sanitized, the objects of TEST on those of the room under sanitizers. TEST runs the slow cases.
function(oriel_sanitized_test room test)
  set(objects oriel_${room}_sanitized)
  get_target_property(sources oriel_${room} SOURCES)
  list(FILTER sources EXCLUDE REGEX "${ORIEL_NOT_SANITIZED}")
  get_target_property(libraries oriel_${room} LINK_LIBRARIES)
  add_library(${objects} OBJECT ${sources})
  target_link_libraries(${objects} PRIVATE ${libraries} oriel_options)
  target_compile_definitions(${objects} PRIVATE ORIEL_ASSERTIONS)
  target_compile_options(${objects} PRIVATE ${ORIEL_SANITIZED_OPTIONS})
  if(NOT TARGET oriel_sanitized_headers)
    oriel_precompiled_headers(oriel_sanitized_headers ${ORIEL_SANITIZED_OPTIONS})
    target_compile_definitions(oriel_sanitized_headers PRIVATE ORIEL_ASSERTIONS)
  endif()
  target_precompile_headers(${objects} REUSE_FROM oriel_sanitized_headers)
  set_target_properties(${objects} PROPERTIES UNITY_BUILD ${ORIEL_UNITY} UNITY_BUILD_BATCH_SIZE 40)

  # These objects come before the archives, whose own are taken only for what is left out here: the first definition counts.
  get_target_property(libraries ${test} LINK_LIBRARIES)
  add_executable(${test}_sanitized $<TARGET_OBJECTS:${objects}> $<TARGET_OBJECTS:${test}>)
  target_link_libraries(${test}_sanitized PRIVATE ${libraries})
  target_link_options(${test}_sanitized PRIVATE ${ORIEL_SANITIZERS} -Wl,--allow-multiple-definition)
  set_target_properties(${test}_sanitized PROPERTIES LINKER_LANGUAGE CXX)
endfunction()

# oriel_of_threads: the command under the thread sanitizer, as far as it has what threads share: the commands that tests/tsan.sh
# runs, the library, names and logs (base), and the tables of attributes and relations, which the first thread that asks for them
# makes (model). The other rooms keep nothing between two calls, and what their threads share does not change (tests/repository).
# Left out, for time, are the other commands and what only they call.
set(ORIEL_COMMANDS_WITHOUT_THREADS cat collect completion diff experiment explain learn merge rules score split studio tiles validate view)
list(JOIN ORIEL_COMMANDS_WITHOUT_THREADS "|" commands)
set(ORIEL_NOT_OF_THREADS
  "/cli/(completion|commands/rules|commands/view)/" left_out tiles_page "commands/(${commands})_"
  "/oriel/./calls/(learn|stored_samples)[.]cpp")
function(oriel_leave_out_of_threads list)
  foreach(pattern ${ORIEL_NOT_OF_THREADS})
    list(FILTER ${list} EXCLUDE REGEX "${pattern}")
  endforeach()
  set(${list} ${${list}} PARENT_SCOPE)
endfunction()

function(oriel_command_of_threads)
  oriel_precompiled_headers(oriel_thread_headers ${ORIEL_THREAD_OPTIONS})
  set(objects "")
  foreach(room base model oriel)
    get_target_property(sources oriel_${room} SOURCES)
    oriel_leave_out_of_threads(sources)
    get_target_property(libraries oriel_${room} LINK_LIBRARIES)
    add_library(oriel_${room}_of_threads OBJECT ${sources})
    target_link_libraries(oriel_${room}_of_threads PRIVATE ${libraries} oriel_options spdlog::spdlog)
    list(APPEND objects oriel_${room}_of_threads)
    list(APPEND all_objects $<TARGET_OBJECTS:oriel_${room}_of_threads>)
  endforeach()
  get_target_property(sources oriel SOURCES)
  oriel_leave_out_of_threads(sources)
  get_target_property(libraries oriel LINK_LIBRARIES)
  list(FILTER libraries EXCLUDE REGEX "mimalloc|Wl,|stdc")
  oriel_leave_out(${CMAKE_CURRENT_BINARY_DIR}/other_commands.cpp ${ORIEL_COMMANDS_WITHOUT_THREADS})
  add_executable(oriel_of_threads ${all_objects} ${sources} ${CMAKE_CURRENT_BINARY_DIR}/other_commands.cpp)
  target_link_libraries(oriel_of_threads PRIVATE ${libraries})
  target_link_options(oriel_of_threads PRIVATE -fsanitize=thread)
  get_target_property(definitions oriel COMPILE_DEFINITIONS)
  target_compile_definitions(oriel_of_threads PRIVATE ${definitions})
  add_dependencies(oriel_of_threads oriel)  # which makes what --version says
  foreach(target ${objects} oriel_of_threads)
    target_include_directories(${target} PRIVATE
      ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated $<TARGET_PROPERTY:oriel_oriel,INCLUDE_DIRECTORIES>)
    target_compile_options(${target} PRIVATE ${ORIEL_THREAD_OPTIONS})
    target_precompile_headers(${target} REUSE_FROM oriel_thread_headers)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ${ORIEL_UNITY} UNITY_BUILD_BATCH_SIZE 24)
  endforeach()
endfunction()
