# A room is a folder with one library. Its public headers lie in ROOM/include/vicon/..., its private ones in ROOM/src, and
# no target has the project's root on its include path: what is not linked cannot be included.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# Nothing reads errno after a root; as long as something might, no loop with one can use vector registers.
add_compile_options(-fno-math-errno)
# The compiler cache needs it where headers are precompiled.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)

# It links the tests in a fraction of the time.
find_program(MOLD mold)
if(MOLD)
  add_link_options(-fuse-ld=mold)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  # It caches nothing that uses a precompiled header unless told that such a header's macros and times do not matter.
  # Paths are relative to the checkout, so that another one finds them too.
  set(CCACHE ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
             CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

# What nearly every file includes; each still includes what it uses, so that it compiles without them as well.
set(VICON_PRECOMPILED <algorithm> <array> <atomic> <cmath> <cstdint> <cstdio> <filesystem> <functional> <limits> <map> <memory>
    <mutex> <numbers> <optional> <set> <string> <string_view> <thread> <vector>
    <json_without_literal.h> <tbb/blocked_range.h> <tbb/parallel_for.h>)
# By its name alone: a path in what is precompiled would keep one checkout from finding in the compiler cache what another made.
include_directories(${PROJECT_SOURCE_DIR}/cmake/precompiled)

# Warnings that the project's own code is held to; libraries' headers are system headers.
add_library(vicon_warnings INTERFACE)
# -Wno-restrict: GCC 12 warns falsely in std::string operator+ (GCC bug 105651). -Wno-missing-field-initializers: a designated
# initialiser that leaves the rest to the struct's own defaults is what options structs are for.
target_compile_options(vicon_warnings INTERFACE -Wall -Wextra $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> -Wno-missing-field-initializers)

# vicon_unity(TARGET ...) compiles files of a target together, twenty at a time: what they include is read, and its templates
# are instantiated, once for all of them. For targets where that is most of the work.
option(VICON_UNITY_BUILD "Compile files of large targets together" ON)
function(vicon_unity)
  if(VICON_UNITY_BUILD)
    set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 20)
  endif()
endfunction()

# What only composes, asks, keeps, shows or tests is compiled in two thirds of the time so; nothing in it takes long to run.
function(vicon_compile_quickly TARGET)
  target_compile_options(${TARGET} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Most rooms share what is precompiled; those with a library whose headers take long to read have their own.
add_library(vicon_precompiled OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
target_link_libraries(vicon_precompiled PRIVATE nlohmann_json::nlohmann_json TBB::tbb vicon_warnings)
target_precompile_headers(vicon_precompiled PRIVATE ${VICON_PRECOMPILED})

# vicon_room(NAME SOURCES src/a.cpp ... PUBLIC targets ... PRIVATE targets ... [PRECOMPILE "<header>" ...])
# makes the library vicon_NAME from the current folder. PRECOMPILE: libraries' headers that take long to read and that many
# of its files need, besides those that all rooms share.
function(vicon_room NAME)
  cmake_parse_arguments(ROOM "" "" "SOURCES;PUBLIC;PRIVATE;PRECOMPILE" ${ARGN})
  add_library(vicon_${NAME} STATIC ${ROOM_SOURCES})
  target_include_directories(vicon_${NAME} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/include
                                           PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_link_libraries(vicon_${NAME} PUBLIC ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE} vicon_warnings)
  if(ROOM_PRECOMPILE)
    target_precompile_headers(vicon_${NAME} PRIVATE ${VICON_PRECOMPILED} ${ROOM_PRECOMPILE})
  else()
    target_precompile_headers(vicon_${NAME} REUSE_FROM vicon_precompiled)
  endif()
endfunction()

# vicon_test(NAME SOURCES a_test.cpp ... LINK targets ... [LABELS long] [TIMEOUT s] [FILTER pattern] [TOGETHER])
# makes one GoogleTest program; every TEST becomes one CTest test. TOGETHER: the program is one CTest test, because its TESTs
# share what takes seconds to make, and each process would make it anew. POSTGRESQL: as well, beside a server. scripts/test-summary counts its TESTs one by one.
# FILTER: only TESTs of such names, as GoogleTest's --gtest_filter takes it.
function(vicon_test NAME)
  cmake_parse_arguments(TEST "TOGETHER;POSTGRESQL" "TIMEOUT;FILTER" "SOURCES;LINK;LABELS" ${ARGN})
  add_executable(${NAME} ${TEST_SOURCES})
  target_precompile_headers(${NAME} REUSE_FROM vicon_test_precompiled)
  vicon_compile_quickly(${NAME})
  target_compile_options(${NAME} PRIVATE -fPIC)  # as what is linked with Qt must be: they share what is precompiled
  target_link_libraries(${NAME} PRIVATE ${TEST_LINK} vicon_test_support GTest::gmock_main vicon_warnings)
  add_dependencies(${NAME} vicon_decoder)  # whatever imports or decodes asks it
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 300)
  endif()
  if(TEST_POSTGRESQL)
    add_test(NAME ${NAME}.together COMMAND ${PROJECT_SOURCE_DIR}/tests/support/with-postgresql $<TARGET_FILE:${NAME}>)
  elseif(TEST_TOGETHER)
    add_test(NAME ${NAME}.together COMMAND ${NAME})
  endif()
  if(TEST_POSTGRESQL OR TEST_TOGETHER)
    set_tests_properties(${NAME}.together PROPERTIES TIMEOUT ${TEST_TIMEOUT} LABELS "${TEST_LABELS}")
    return()
  endif()
  # Without the values of parameters: of a plain struct they are bytes, and a name must stay the same from run to run.
  gtest_discover_tests(${NAME} TEST_PREFIX ${NAME}. TEST_FILTER "${TEST_FILTER}" NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT ${TEST_TIMEOUT} LABELS "${TEST_LABELS}")
endfunction()

# vicon_long_test(NAME [TIMEOUT s] [FILTER pattern] [TOGETHER]) runs a test's program, which takes a sample, once more in
# full (support::inFull), with the label long: of a_test as a_long_test.
function(vicon_long_test NAME)
  cmake_parse_arguments(TEST "TOGETHER" "TIMEOUT;FILTER" "" ${ARGN})
  string(REGEX REPLACE "_test$" "_long_test" LONG_NAME ${NAME})
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 3600)
  endif()
  set(PROPERTIES TIMEOUT ${TEST_TIMEOUT} LABELS long ENVIRONMENT VICON_IN_FULL=1)
  if(TEST_TOGETHER)
    add_test(NAME ${LONG_NAME}.together COMMAND ${NAME})
    set_tests_properties(${LONG_NAME}.together PROPERTIES ${PROPERTIES})
    return()
  endif()
  gtest_discover_tests(${NAME} TEST_PREFIX ${LONG_NAME}. TEST_LIST ${LONG_NAME}_TESTS TEST_FILTER "${TEST_FILTER}" NO_PRETTY_VALUES
                       DISCOVERY_TIMEOUT 60 PROPERTIES ${PROPERTIES})
endfunction()

# vicon_postgresql_test(NAME) runs all TESTs of a program once more, as one CTest test beside one server, with its stores in
# PostgreSQL. Those with Sqlite in their names are of SQLite alone.
function(vicon_postgresql_test NAME)
  add_test(NAME ${NAME}.with_postgresql
           COMMAND ${PROJECT_SOURCE_DIR}/tests/support/with-postgresql $<TARGET_FILE:${NAME}> --gtest_filter=-*Sqlite*)
  set_tests_properties(${NAME}.with_postgresql PROPERTIES TIMEOUT 300)
endfunction()
