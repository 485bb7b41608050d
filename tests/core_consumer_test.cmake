# Builds and runs a consumer of remodel::core where HDF5, SQLite, cairo, MUMPS, the libraries of tests, MPI, threads and
# pkg-config cannot be found: from Remodel's sources, and from what that installs, core alone, where not even the
# header-only libraries are left that core is built with.
# The core that is built there is of another compiler, where clang++ is there, without optimisation and vector clones:
# its meshes are the bytes of the build's own (tests/determinism), which TRACE prints.
#   cmake -DSOURCE=... -DSCRATCH=... -DTRACE=... -P core_consumer_test.cmake
include(${SOURCE}/tests/run.cmake)

file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})
set(consumer ${SOURCE}/tests/consumer/core)
# Not optimised: core is built for its own sake. The release build that scripts/long-tests makes is the one file by file,
# which finds includes that lack.
set(bare -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_UNITY_BUILD=ON -DCMAKE_TOOLCHAIN_FILE=${consumer}/bare.cmake
         -DBARE_SCRATCH=${SCRATCH}/bare)
find_program(COMPILER NAMES clang++ c++ REQUIRED)
list(APPEND bare -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=-w)
find_program(CCACHE ccache)
if(CCACHE)
  list(APPEND bare -DCMAKE_CXX_COMPILER_LAUNCHER=${CCACHE})
endif()

# The toolchain hides what it says: the whole project cannot be configured with it.
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH}/whole ${bare} RESULT_VARIABLE status OUTPUT_QUIET
                ERROR_VARIABLE errors)
if(status EQUAL 0 OR NOT errors MATCHES "MUMPS")
  message(FATAL_ERROR "the whole project was configured, expected that MUMPS is not found: ${errors}")
endif()

# run_consumer(BUILD): builds and runs the consumer that was configured there, and looks at what it is linked with.
function(run_consumer build)
  run(${CMAKE_COMMAND} --build ${build} --target consumer)
  run(${build}/consumer)
  file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${build}/consumer RESOLVED_DEPENDENCIES_VAR libraries)
  list(TRANSFORM libraries REPLACE ".*/" "")
  list(FILTER libraries EXCLUDE REGEX "^(libc|libm|libgcc_s|libstdc\\+\\+|ld-linux.*)\\.so")
  if(libraries)
    message(FATAL_ERROR "${build}/consumer is linked with ${libraries}, expected the C++ library alone")
  endif()
endfunction()

run(${CMAKE_COMMAND} -S ${consumer} -B ${SCRATCH}/sources ${bare} -DREMODEL_SOURCE=${SOURCE} -DREMODEL_INSTALL=ON
    -DREMODEL_DISPATCH=OFF)
run_consumer(${SCRATCH}/sources)
file(GLOB_RECURSE core ${SCRATCH}/sources/remodel/libremodel_core.a)
run(${COMPILER} -std=c++20 -ffp-contract=off -fno-math-errno -fno-trapping-math -w -I${SOURCE}/include -I${SOURCE}/src
    ${SOURCE}/tests/determinism/trace.cpp ${core} -pthread -o ${SCRATCH}/trace)
foreach(program ${TRACE} ${SCRATCH}/trace)
  string(MD5 name ${program})
  execute_process(COMMAND ${program} OUTPUT_FILE ${SCRATCH}/${name}.txt COMMAND_ERROR_IS_FATAL ANY)
  list(APPEND traces ${SCRATCH}/${name}.txt)
endforeach()
run(${CMAKE_COMMAND} -E compare_files ${traces})
file(GLOB_RECURSE others ${SCRATCH}/sources/remodel/*.a)
list(FILTER others EXCLUDE REGEX "libremodel_core\\.a$")
if(others)
  message(FATAL_ERROR "a consumer of core built ${others} too")
endif()

run(${CMAKE_COMMAND} --install ${SCRATCH}/sources --prefix ${SCRATCH}/prefix)
run(${CMAKE_COMMAND} -S ${consumer} -B ${SCRATCH}/installed ${bare} -DBARE_NOTHING=ON
    -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix)
run_consumer(${SCRATCH}/installed)
file(REMOVE_RECURSE ${SCRATCH})
