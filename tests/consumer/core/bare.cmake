# A toolchain of a machine where only header-only libraries can be found, and with BARE_NOTHING not even these. What is
# hidden cannot be found by CMake, and a source that includes it does not compile.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES BARE_SCRATCH BARE_NOTHING)
set(hidden HDF5 SQLite3 CLI11 GTest CGAL Pagmo pagmo MPI Threads PkgConfig ZLIB benchmark)
set(hidden_headers hdf5.h sqlite3.h cairo/cairo.h cairo.h CLI/CLI.hpp gtest/gtest.h CGAL/version.h
                   pagmo/pagmo.hpp mpi.h benchmark/benchmark.h pugixml.hpp dmumps_c.h)
if(BARE_NOTHING)
  list(APPEND hidden Eigen3 Boost nlohmann_json)
  list(APPEND hidden_headers Eigen/Core Eigen/Dense boost/version.hpp nlohmann/json.hpp)
endif()
foreach(package IN LISTS hidden)
  set(CMAKE_DISABLE_FIND_PACKAGE_${package} TRUE)
endforeach()
foreach(header IN LISTS hidden_headers)
  file(CONFIGURE OUTPUT ${BARE_SCRATCH}/hidden/${header} CONTENT "#error ${header} is hidden\n")
endforeach()
set(CMAKE_CXX_FLAGS_INIT "-I${BARE_SCRATCH}/hidden")
# No find_library() or find_program() sees the machine's libraries.
set(CMAKE_FIND_ROOT_PATH ${BARE_SCRATCH}/root)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(PKG_CONFIG_EXECUTABLE ${BARE_SCRATCH}/no-pkg-config)
