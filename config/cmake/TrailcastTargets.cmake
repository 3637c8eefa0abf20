# What every target of ours has in common: the standard, warnings as errors, sanitizers, ccache,
# and where binaries land. Targets list their sources; nothing is globbed.

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

option(TRAILCAST_UNITY "Compile sources eight at a time, with precompiled headers" ON)

# ccache keeps what is compiled with precompiled headers only where it is told that it may.
find_program(TRAILCAST_CCACHE ccache)
if(TRAILCAST_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER "${TRAILCAST_CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros
                                  "${TRAILCAST_CCACHE}")
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
  else()
    add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-Xclang -fno-pch-timestamp>")
  endif()
endif()

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

# Headers that nearly every source includes are parsed once for libraries, once for programs, and once
# for tests. Headers whose meaning depends on a target's definitions (spdlog, httplib) are not among them.
set(trailcast_headers <algorithm> <array> <chrono> <cmath> <cstdint> <deque> <filesystem> <fstream>
                      <functional> <map> <memory> <mutex> <optional> <set> <span> <sstream> <string>
                      <string_view> <thread> <utility> <variant> <vector> <fmt/format.h>)

# Tests are optimised little, which takes much less time; what they test is optimised all the same.
function(trailcast_compile_as_test target)
  if(TRAILCAST_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  else()
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# trailcast_precompile(<kind> HEADERS <h>... DEPS x): the headers as sources of this kind see them.
function(trailcast_precompile kind)
  cmake_parse_arguments(ARG "" "" "HEADERS;DEPS" ${ARGN})
  if(NOT TRAILCAST_UNITY)
    return()
  endif()
  set(target trailcast_precompiled_${kind})
  set(source "${CMAKE_BINARY_DIR}/generated/${target}.cc")
  if(kind STREQUAL library)
    file(CONFIGURE OUTPUT "${source}" CONTENT "")
    add_library(${target} OBJECT "${source}")
  else() # another kind of position independence
    file(CONFIGURE OUTPUT "${source}" CONTENT "int main() {}\n")
    add_executable(${target} EXCLUDE_FROM_ALL "${source}")
  endif()
  trailcast_target_defaults(${target})
  target_link_libraries(${target} PRIVATE ${ARG_DEPS})
  target_precompile_headers(${target} PRIVATE ${ARG_HEADERS})
  if(kind STREQUAL test)
    trailcast_compile_as_test(${target})
  endif()
endfunction()

trailcast_precompile(library HEADERS ${trailcast_headers} DEPS fmt::fmt)
trailcast_precompile(program HEADERS ${trailcast_headers} DEPS fmt::fmt)
trailcast_precompile(test HEADERS ${trailcast_headers} <gtest/gtest.h> <gmock/gmock.h> DEPS fmt::fmt
                                                                                        GTest::gmock)

# trailcast_include_precompiled(<target> <kind>)
function(trailcast_include_precompiled target kind)
  if(TRAILCAST_UNITY)
    target_link_libraries(${target} PRIVATE fmt::fmt)
    target_precompile_headers(${target} REUSE_FROM trailcast_precompiled_${kind})
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
  trailcast_include_precompiled(${name} library)
endfunction()

# trailcast_executable(<name> SOURCES main.cc APART other.cc DEPS x): compiled as libraries are.
function(trailcast_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;APART;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES} ${ARG_APART})
  trailcast_target_defaults(${name})
  trailcast_compile_together(${name} ${ARG_APART})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS})
  trailcast_include_precompiled(${name} program)
endfunction()

# Tests wait for what has to happen with bounds of their own, which say what did not; this one ends a
# test that hangs beyond them.
set(trailcast_test_timeout_s 1500)

# trailcast_test(<name> LABEL unit|simulator|contract|scenario SOURCES a_test.cc
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
# NUMERIC: what they include computes for long, and is optimised as what they test is.
function(trailcast_test name)
  cmake_parse_arguments(ARG "TOGETHER;ALONE;REAL_TIME;WAITS;NUMERIC" "LABEL;SHARDS"
                        "SOURCES;APART;DEPS;LONG" ${ARGN})
  add_executable(${name} ${ARG_SOURCES} ${ARG_APART})
  trailcast_target_defaults(${name})
  trailcast_compile_together(${name} ${ARG_APART})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS} trailcast_test_places GTest::gmock
                                        GTest::gtest_main)
  if(TARGET ${ARG_LABEL}s)
    add_dependencies(${ARG_LABEL}s ${name})
  endif()
  if(NOT ARG_NUMERIC)
    trailcast_compile_as_test(${name})
    trailcast_include_precompiled(${name} test)
  endif()
  set(discovery DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60) # from a cold disk, beside other work
  list(JOIN ARG_LONG ":" long)
  if(long)
    gtest_discover_tests(${name} TEST_FILTER "${long}" ${discovery}
                         PROPERTIES LABELS trial TIMEOUT ${trailcast_test_timeout_s})
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
        ${part} PROPERTIES LABELS unit TIMEOUT ${trailcast_test_timeout_s} COST ${ARG_SHARDS}
                           ENVIRONMENT "GTEST_TOTAL_SHARDS=${ARG_SHARDS};GTEST_SHARD_INDEX=${shard}")
    endforeach()
    return()
  endif()
  if(ARG_TOGETHER)
    add_test(NAME ${name} COMMAND ${name} "--gtest_filter=-${long}")
    set_tests_properties(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${trailcast_test_timeout_s} COST 500
                                             PROCESSORS ${takes})
    return()
  endif()
  set(beside RUN_SERIAL ${ARG_ALONE})
  if(ARG_REAL_TIME)
    set(beside COST 1000)
  endif()
  gtest_discover_tests(${name} TEST_FILTER "-${long}" ${discovery}
                       PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${trailcast_test_timeout_s} PROCESSORS ${takes} ${beside})
endfunction()

# trailcast_benchmark(<name> SOURCES a_bench.cc DEPS x): built with the rest, run by hand.
function(trailcast_benchmark name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  trailcast_target_defaults(${name})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS} benchmark::benchmark)
endfunction()
