# Installs the build into a scratch prefix and builds and runs the example against it.
#   cmake -DBUILD=... -DSOURCE=... -DSCRATCH=... -P installed_consumer_test.cmake
include(${SOURCE}/tests/run.cmake)

file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)
run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/tests/consumer/whole -B ${SCRATCH}/build -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix -DEXAMPLE=${SOURCE}/examples/example.cpp)
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
run(${CMAKE_COMMAND} -E chdir ${SCRATCH} ${SCRATCH}/build/consumer)
run(${SCRATCH}/prefix/bin/remodel shapes)
file(REMOVE_RECURSE ${SCRATCH})
