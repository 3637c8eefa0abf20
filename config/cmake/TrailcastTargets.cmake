# What every target of ours has in common: the standard, warnings as errors, sanitizers, ccache,
# and where binaries land. Targets list their sources; nothing is globbed.

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(TRAILCAST_CCACHE ccache)
if(TRAILCAST_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER "${TRAILCAST_CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${TRAILCAST_CCACHE}")
endif()

option(TRAILCAST_UNITY "Compile sources eight at a time" ON)

set(TRAILCAST_SANITIZE "" CACHE STRING "Comma-separated sanitizers, e.g. address,undefined")
if(TRAILCAST_SANITIZE)
  add_compile_options(-fsanitize=${TRAILCAST_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${TRAILCAST_SANITIZE})
  if(TRAILCAST_SANITIZE MATCHES "address")
    add_compile_definitions(TRAILCAST_ASAN)
  endif()
  # GCC's analysis does not see through the instrumentation.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
endif()

# Applied to each of our targets; generated code (idlc, protoc) is kept out of it.
function(trailcast_target_defaults target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Werror -Wnon-virtual-dtor
                                           -Woverloaded-virtual)
  # Clang has a source's own names shadowed by those of another one that is compiled with it.
  if(NOT (TRAILCAST_UNITY AND CMAKE_CXX_COMPILER_ID MATCHES "Clang"))
    target_compile_options(${target} PRIVATE -Wshadow)
  endif()
  target_include_directories(${target} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
                                              "$<INSTALL_INTERFACE:include/trailcast>")
endfunction()

# trailcast_compile_together(<target> [a.cc...]): but for those.
function(trailcast_compile_together target)
  if(TRAILCAST_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    # GCC takes the sources for headers that others might include, too.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
    endif()
  endif()
endfunction()

# trailcast_library(<name> SOURCES a.cc b.cc APART c.cc DEPS x PRIVATE_DEPS y)
# Sources are compiled eight at a time, which takes half the time; APART: one by one, since they
# name things of their own like others do.
function(trailcast_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;APART;DEPS;PRIVATE_DEPS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES} ${ARG_APART})
  trailcast_target_defaults(${name})
  trailcast_compile_together(${name} ${ARG_APART})
  target_link_libraries(${name} PUBLIC ${ARG_DEPS} PRIVATE ${ARG_PRIVATE_DEPS})
endfunction()

# trailcast_executable(<name> SOURCES main.cc APART other.cc DEPS x): compiled as libraries are.
function(trailcast_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;APART;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES} ${ARG_APART})
  trailcast_target_defaults(${name})
  trailcast_compile_together(${name} ${ARG_APART})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS})
endfunction()

# trailcast_test(<name> LABEL unit|simulator|contract|scenario TIMEOUT s SOURCES a_test.cc
#                APART b_test.cc DEPS x SHARDS n)
# Every case is a ctest test of its own, so that they run in parallel and are named by situation.
# The cases of a unit test's program run in one process, since under sanitizers most take longer to
# start than to run; where that takes a minute, SHARDS of them run side by side. With TOGETHER other
# cases are one as well, since they share what is slow to come by.
# ./run test has ten places for tests on two cores, and a test takes four of them. ALONE: nothing runs
# beside them, since they measure time; REAL_TIME: their robots keep pace with the clock, so that they
# take two fifths of a core and three places, and they begin first, so that others fill what is left;
# WAITS: it mostly waits, and takes one place.
# LONG: cases, as GoogleTest filters them, that drive simulated robots for long: they are labelled
# `trial`, which ./run trials runs.
# Sources are compiled together or APART as a library's are.
# NUMERIC: what they include computes for long, and is optimised under sanitizers, too.
function(trailcast_test name)
  cmake_parse_arguments(ARG "TOGETHER;ALONE;REAL_TIME;WAITS;NUMERIC" "LABEL;TIMEOUT;SHARDS"
                        "SOURCES;APART;DEPS;LONG" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  if(TRAILCAST_SANITIZE)  # several times slower
    math(EXPR ARG_TIMEOUT "3 * ${ARG_TIMEOUT}")
  endif()
  add_executable(${name} ${ARG_SOURCES} ${ARG_APART})
  trailcast_target_defaults(${name})
  trailcast_compile_together(${name} ${ARG_APART})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS} trailcast_test_places GTest::gmock
                                        GTest::gtest_main)
  if(TARGET ${ARG_LABEL}s)
    add_dependencies(${ARG_LABEL}s ${name})
  endif()
  # Much less time to compile; what is tested is optimised all the same.
  if(TRAILCAST_SANITIZE AND NOT ARG_NUMERIC)
    target_compile_options(${name} PRIVATE -O0)
  else()
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  set(discovery DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60) # from a cold disk, beside other work
  list(JOIN ARG_LONG ":" long)
  if(long)
    gtest_discover_tests(${name} TEST_FILTER "${long}" ${discovery}
                         PROPERTIES LABELS trial TIMEOUT ${ARG_TIMEOUT})
  endif()
  set(takes 4)
  if(ARG_REAL_TIME)
    set(takes 2)
  elseif(ARG_WAITS)
    set(takes 1)
  endif()
  if(ARG_LABEL STREQUAL unit)
    if(NOT ARG_SHARDS)
      set(ARG_SHARDS 1)
    endif()
    math(EXPR last "${ARG_SHARDS} - 1")
    foreach(shard RANGE ${last})
      set(part ${name})
      if(last GREATER 0)
        set(part ${name}.${shard})
      endif()
      add_test(NAME ${part} COMMAND ${name})
      set_tests_properties(
        ${part} PROPERTIES LABELS unit TIMEOUT ${ARG_TIMEOUT} COST ${ARG_SHARDS}
                           ENVIRONMENT "GTEST_TOTAL_SHARDS=${ARG_SHARDS};GTEST_SHARD_INDEX=${shard}")
    endforeach()
    return()
  endif()
  if(ARG_TOGETHER)
    add_test(NAME ${name} COMMAND ${name} "--gtest_filter=-${long}")
    set_tests_properties(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT} COST 500
                                             PROCESSORS ${takes})
    return()
  endif()
  set(beside RUN_SERIAL ${ARG_ALONE})
  if(ARG_REAL_TIME)
    set(beside COST 1000)
  endif()
  gtest_discover_tests(${name} TEST_FILTER "-${long}" ${discovery}
                       PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT} PROCESSORS ${takes} ${beside})
endfunction()

# trailcast_benchmark(<name> SOURCES a_bench.cc DEPS x): built with the rest, run by hand.
function(trailcast_benchmark name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  trailcast_target_defaults(${name})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS} benchmark::benchmark)
endfunction()
