# All our targets get the same warnings, sanitizers and include root.

find_program(OLS_CCACHE ccache)
if(OLS_CCACHE)
  # A precompiled header has its own time in it; its contents are what counts.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${OLS_CCACHE})
endif()

add_library(ols_options INTERFACE)
target_include_directories(ols_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(
  ols_options
  INTERFACE -Wall
            -Wextra
            -Wpedantic
            -Wshadow
            -Wnon-virtual-dtor
            -Wold-style-cast
            -Woverloaded-virtual
            -Werror
            # Bit-for-bit the same arithmetic on every machine of one architecture.
            -ffp-contract=off)
# A program loads only the libraries that it calls: OpenCV's video input alone brings 200 along.
target_link_options(ols_options INTERFACE -Wl,--as-needed)
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  # Debian's libfccp exports an option that only GCC accepts.
  target_compile_options(ols_options INTERFACE -Wno-unknown-warning-option)
endif()
if(OLS_QUICK_BUILD)
  # One precompiled header serves all: the same definitions, threads and position independence everywhere.
  target_compile_options(ols_options INTERFACE -fPIC -pthread)
  foreach(package Boost::headers PkgConfig::tomlplusplus spdlog::spdlog)
    target_compile_definitions(
      ols_options INTERFACE $<TARGET_PROPERTY:${package},INTERFACE_COMPILE_DEFINITIONS>)
    target_compile_options(
      ols_options INTERFACE $<TARGET_PROPERTY:${package},INTERFACE_COMPILE_OPTIONS>)
  endforeach()
endif()
if(CMAKE_UNITY_BUILD)
  # A local name may hide one of a source that happens to be compiled with it. The debug preset
  # compiles each source by itself: it is the one that checks.
  target_compile_options(ols_options INTERFACE -Wno-shadow)
endif()
if(OLS_SANITIZE)
  target_compile_options(ols_options INTERFACE -fsanitize=${OLS_SANITIZE} -fno-omit-frame-pointer
                                               -fno-sanitize-recover=all)
  target_link_options(ols_options INTERFACE -fsanitize=${OLS_SANITIZE})
endif()

# ols_library(NAME [HOT] SOURCES ... LINK ... [ALONE ...]): one library of the product. HOT: it computes for each
# frame, bearing or simulated picture, or with large matrices: the linker may take its compilation of Eigen for all.
# ALONE are those of the sources that share local names with others: they are never compiled together with those.
function(ols_library name)
  cmake_parse_arguments(ARG "HOT" "" "SOURCES;LINK;ALONE" ${ARGN})
  add_library(${name} ${OLS_LIBRARY_TYPE} ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC ols_options ${ARG_LINK})
  set_source_files_properties(${ARG_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  if(NOT ARG_HOT)
    ols_compile_quickly(${name} ols_common_headers)
  endif()
endfunction()

# ols_precompile(NAME HEADERS...): reads long headers once in a quick build. The inline functions that they bring with
# them are compiled once, too, and optimised: the targets of ols_compile_quickly only call them.
function(ols_precompile name)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "") # untouched where it is there
  add_library(${name} STATIC ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE ols_options ols_opencv Eigen3::Eigen)
  # Without the time of the list of headers: the compiler cache has the result of an earlier, equal list.
  target_compile_options(${name} PRIVATE -O0 "SHELL:-Xclang -fmodules-codegen" "SHELL:-Xclang -fno-pch-timestamp")
  target_precompile_headers(${name} PRIVATE ${ARGN})

  set(folder ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${name}.dir)
  add_custom_command(
    OUTPUT ${folder}/inline_functions.o
    DEPENDS ${folder}/cmake_pch.hxx.pch
    COMMAND ${CMAKE_CXX_COMPILER} -std=c++20 -O1 -fPIC -pthread -ffp-contract=off -ffunction-sections -w
            -c ${folder}/cmake_pch.hxx.pch -o ${folder}/inline_functions.o)
  add_library(${name}_code STATIC ${folder}/inline_functions.o)
  set_target_properties(${name}_code PROPERTIES LINKER_LANGUAGE CXX)
  # Functions that a program does not call need none of the libraries that they call.
  target_link_options(${name}_code INTERFACE -Wl,--gc-sections)
endfunction()

# ols_compile_quickly(TARGET HEADERS): for what waits for people, disks and networks. It is not optimised in a quick
# build.
function(ols_compile_quickly target headers)
  if(OLS_QUICK_BUILD)
    target_compile_options(${target} PRIVATE -O0)
    target_precompile_headers(${target} REUSE_FROM ${headers})
    target_link_libraries(${target} PRIVATE ${headers}_code)
  endif()
endfunction()

if(OLS_QUICK_BUILD)
  # What most sources include, and is long to read.
  set(ols_long_headers
      <CLI/CLI.hpp>
      <Eigen/Dense>
      <nlohmann/json.hpp>
      <opencv2/core.hpp>
      <opencv2/imgproc.hpp>
      <algorithm>
      <chrono>
      <cmath>
      <filesystem>
      <fstream>
      <functional>
      <iostream>
      <map>
      <memory>
      <mutex>
      <optional>
      <random>
      <set>
      <sstream>
      <string>
      <thread>
      <unordered_map>
      <variant>
      <vector>)
  ols_precompile(ols_common_headers ${ols_long_headers})
endif()

# ols_program(NAME SOURCES ... LINK ... [ALONE ...]): one executable of the product.
function(ols_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;ALONE" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  set_source_files_properties(${ARG_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_link_libraries(${name} PRIVATE ols_options ${ARG_LINK})
  target_compile_definitions(${name} PRIVATE OLS_VERSION="${PROJECT_VERSION}")
  ols_compile_quickly(${name} ols_common_headers)
endfunction()

# ols_test(NAME [HOT] SOURCES ... LINK ... [ALONE ...]): a GoogleTest program, one process and one ctest entry.
# Most of a test's compilation is GoogleTest's and Eigen's headers: eight sources are compiled at once.
# Tests are optimised less than the libraries, in a quick build not at all unless they are HOT: inline functions
# that a test uses too may be run as compiled for it, and these tests compute for minutes.
# ALONE are those of the sources whose local names are also names of another source.
function(ols_test name)
  cmake_parse_arguments(ARG "HOT" "" "SOURCES;LINK;ALONE" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ols_options ${ARG_LINK} ols_test_main)
  if(OLS_QUICK_BUILD AND NOT ARG_HOT)
    ols_compile_quickly(${name} ols_test_headers)
  else()
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests
                                           UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  set_source_files_properties(${ARG_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_test(NAME ${name} COMMAND ${name} --gtest_brief=1)
  set_tests_properties(${name} PROPERTIES TIMEOUT 600)
  if(${name} IN_LIST ols_longest_tests)
    set_tests_properties(${name} PROPERTIES COST 100) # [s] ctest has only the times of earlier runs
  endif()
endfunction()

# They begin first: one that began late would be waited for.
set(ols_longest_tests
    calibration_pictures_test
    indi_test
    test_calibrate_procedures
    test_camera_wire
    test_central_fusion
    test_rtsp_wire
    test_sim_lockstep
    test_skyline
    test_station_process
    tracker_test)
