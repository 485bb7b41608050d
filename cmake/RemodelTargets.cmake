# How the targets of this project are made: flags, libraries, tests.

# Numerics first: no contraction of a*b+c into one rounding, which breaks the exact predicates. Nobody asks errno
# what a mathematical function thought, or looks at floating-point exceptions: without them square roots and
# comparisons can be vectorised, to the same bits.
add_library(remodel_flags INTERFACE)
target_compile_features(remodel_flags INTERFACE cxx_std_20)
target_compile_options(remodel_flags INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math
                       -Wall -Wextra -Wconversion -Wshadow $<$<BOOL:${REMODEL_WERROR}>:-Werror>)
# GCC 12 sees overlaps in "text" + std::string that are none (its bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(remodel_flags INTERFACE -Wno-restrict)
endif()
if(REMODEL_ASSERTIONS)
  target_compile_options(remodel_flags INTERFACE -UNDEBUG)
endif()
if(REMODEL_DISPATCH)
  include(CheckCXXSourceRuns)
  set(CMAKE_REQUIRED_FLAGS -Werror)
  check_cxx_source_runs("
    namespace {
    __attribute__((target_clones(\"avx2\", \"default\"))) double twice(double x) { return 2 * x; }
    }
    int main(int n, char**) { return twice(n) < 0; }" REMODEL_CAN_DISPATCH)
  unset(CMAKE_REQUIRED_FLAGS)
  if(REMODEL_CAN_DISPATCH)
    target_compile_definitions(remodel_flags INTERFACE REMODEL_DISPATCH)
  endif()
endif()

# Everything that was built, for those who want all of it: remodel::remodel.
add_library(remodel INTERFACE)
add_library(remodel::remodel ALIAS remodel)

# remodel_library(NAME LIBRARY...): the static library remodel::NAME over other targets of this project or others.
# Sources are added by the folders of its layers.
function(remodel_library name)
  set(target remodel_${name})
  add_library(${target} STATIC)
  add_library(remodel::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF
                                             UNITY_BUILD_MODE GROUP)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                              $<INSTALL_INTERFACE:include>
                                       PRIVATE ${PROJECT_SOURCE_DIR}/src)
  # Header-only libraries and flags are of no use to who links the library.
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:remodel_flags> $<BUILD_INTERFACE:Eigen3::Eigen>
                        $<BUILD_INTERFACE:Boost::headers> $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
  target_link_libraries(${target} ${ARGN})
  target_link_libraries(remodel INTERFACE ${target})
  set_property(GLOBAL APPEND PROPERTY REMODEL_LIBRARIES ${name})
endfunction()

# Unity builds join the files of a layer, and no others: helpers' names need to differ within one only.
function(remodel_finish_libraries)
  get_property(names GLOBAL PROPERTY REMODEL_LIBRARIES)
  foreach(name IN LISTS names)
    get_target_property(sources remodel_${name} SOURCES)
    get_target_property(folder remodel_${name} SOURCE_DIR)
    foreach(source IN LISTS sources)
      cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
      cmake_path(GET source PARENT_PATH directory)
      cmake_path(GET directory FILENAME layer)
      set_source_files_properties(${source} TARGET_DIRECTORY remodel_${name} PROPERTIES UNITY_GROUP ${layer})
    endforeach()
  endforeach()
endfunction()

# One test program a layer: remodel_test(name file...), sources beside the code they test.
if(REMODEL_TESTS)
  enable_testing()
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
function(remodel_test_options name)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE REMODEL_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE remodel remodel_flags Eigen3::Eigen Boost::headers
                                        nlohmann_json::nlohmann_json GTest::gtest_main)
  target_compile_options(${name} PRIVATE ${REMODEL_TEST_FLAGS})
  if(CMAKE_UNITY_BUILD)  # what ccache needs to keep objects that compiled headers were used for; see .ci/run
    target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
                                           "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  endif()
  # Tests have unnamed namespaces of the same content, which one translation unit would not bear.
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
endfunction()
# Where sources are compiled together, the headers that nearly every test includes are compiled once: they are a third
# of a test's time. Tests with compiler options of their own cannot use them.
set(remodel_tests_with_own_options test_cmaes_oracle test_differential test_geometry)
function(remodel_test name)
  if(NOT REMODEL_TESTS)
    return()
  endif()
  add_executable(${name} ${ARGN})
  remodel_test_options(${name})
  if(CMAKE_UNITY_BUILD AND NOT name IN_LIST remodel_tests_with_own_options)
    if(NOT TARGET remodel_test_headers)
      add_library(remodel_test_headers OBJECT ${PROJECT_SOURCE_DIR}/tests/headers.cpp)
      remodel_test_options(remodel_test_headers)
      target_precompile_headers(remodel_test_headers PRIVATE ${PROJECT_SOURCE_DIR}/tests/headers.h)
    endif()
    target_precompile_headers(${name} REUSE_FROM remodel_test_headers)
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 900)
endfunction()
