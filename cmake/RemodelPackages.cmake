# Debian packages, by `cpack -G DEB` in the build directory: remodel has the program, remodel-mpi what `remodel study`
# becomes under mpirun, python3-remodel the Python package, and libremodel-dev the static libraries with their headers.
set(CPACK_PACKAGE_NAME remodel)
set(CPACK_PACKAGE_VENDOR "The Remodel authors")
set(CPACK_PACKAGE_CONTACT "The Remodel authors <remodel@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENTS_ALL "")

# debian_package(COMPONENT NAME SECTION DESCRIPTION): the package of an install component. The
# project's description is the summary of all of them.
function(debian_package component name section description)
  string(TOUPPER ${component} key)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/${name} RENAME copyright COMPONENT ${component})
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${description}" PARENT_SCOPE)
endfunction()

# Flows take three times as long with the reference BLAS.
set(fast_blas "libopenblas0-serial | libopenblas0")

if(TARGET remodel_program)
  debian_package(program remodel science
                 "Generates a constrained Delaunay mesh with bounds on its angles and gradation, and remodels it while
an optimiser changes the airfoil or domain inside: most triangles stay.")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "${fast_blas}")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS remodel-mpi)
endif()
if(TARGET remodel_mpi)
  debian_package(ranks remodel-mpi science
                 "The program remodel with MPI: remodel study becomes it under mpirun, so that ranks share the work.")
  set(CPACK_DEBIAN_RANKS_PACKAGE_DEPENDS "remodel (= ${PROJECT_VERSION}), openmpi-bin")
endif()
if(TARGET remodel_python)
  debian_package(python python3-remodel python
                 "The library as a Python package: meshes as numpy arrays, in memory, from design to design.")
  get_property(minor GLOBAL PROPERTY REMODEL_PYTHON_MINOR)
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${minor}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "${fast_blas}")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-scipy")
endif()
debian_package(development libremodel-dev libdevel
               "Static libraries, headers and the CMake package remodel with its components core, flow, io, draw, design and aero.")

# The static libraries are linked with these by whoever uses them; core needs none.
set(used_by_flow "")
if(REMODEL_SPARSE_LU STREQUAL "MUMPS")
  set(used_by_flow libmumps-seq-dev)
endif()
set(used_by_io libhdf5-dev zlib1g-dev libpugixml-dev pkg-config)
set(used_by_draw libcairo2-dev libwebp-dev pkg-config)
set(used_by_design libsqlite3-dev)
set(used "")
get_property(names GLOBAL PROPERTY REMODEL_LIBRARIES)
foreach(name IN LISTS names)
  list(APPEND used ${used_by_${name}})
endforeach()
list(REMOVE_DUPLICATES used)
list(JOIN used ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "${fast_blas}")
include(CPack)
