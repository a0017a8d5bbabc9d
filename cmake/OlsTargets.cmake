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

# ols_library(NAME SOURCES ... LINK ... [ALONE ...]): one library of the product. ALONE are those of
# the sources that share local names with others: they are never compiled together with those.
function(ols_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;ALONE" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC ols_options ${ARG_LINK})
  set_source_files_properties(${ARG_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# ols_program(NAME SOURCES ... LINK ... [ALONE ...]): one executable of the product.
function(ols_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;ALONE" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  set_source_files_properties(${ARG_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_link_libraries(${name} PRIVATE ols_options ${ARG_LINK})
  target_compile_definitions(${name} PRIVATE OLS_VERSION="${PROJECT_VERSION}")
endfunction()

# ols_test(NAME SOURCES ... LINK ... [ALONE ...]): a GoogleTest program, one ctest entry per test case.
# Most of a test's compilation is GoogleTest's and Eigen's headers: eight sources are compiled at once.
# Tests are compiled with less optimisation than the libraries, which saves a quarter of the rest; inline
# functions that a test uses too may be run as compiled for it.
# ALONE are those of the sources whose local names are also names of another source.
function(ols_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;ALONE" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ols_options ${ARG_LINK} ols_test_main)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests
                                           UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  set_source_files_properties(${ARG_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()
