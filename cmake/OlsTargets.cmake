# All our targets get the same warnings, sanitizers and include root.

find_program(OLS_CCACHE ccache)
if(OLS_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${OLS_CCACHE})
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
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  # Debian's libfccp exports an option that only GCC accepts.
  target_compile_options(ols_options INTERFACE -Wno-unknown-warning-option)
endif()
if(OLS_SANITIZE)
  target_compile_options(ols_options INTERFACE -fsanitize=${OLS_SANITIZE} -fno-omit-frame-pointer
                                               -fno-sanitize-recover=all)
  target_link_options(ols_options INTERFACE -fsanitize=${OLS_SANITIZE})
endif()

# ols_library(NAME SOURCES ... LINK ...): one library of the product.
function(ols_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC ols_options ${ARG_LINK})
endfunction()

# ols_program(NAME SOURCES ... LINK ...): one executable of the product.
function(ols_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ols_options ${ARG_LINK})
endfunction()

# ols_test(NAME SOURCES ... LINK ...): a GoogleTest program, one ctest entry per test case.
function(ols_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ols_options ${ARG_LINK} GTest::gtest_main GTest::gmock)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()
