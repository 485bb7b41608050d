# Installation: the libraries with their headers and a package for find_package(remodel [COMPONENTS core flow io draw
# design aero]), and the programs. Each install component is a Debian package of its own (RemodelPackages.cmake).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(REMODEL_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/remodel)
get_property(names GLOBAL PROPERTY REMODEL_LIBRARIES)
list(REMOVE_ITEM names study)
foreach(name IN LISTS names)
  install(TARGETS remodel_${name} EXPORT remodel_${name} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          COMPONENT development)
  install(EXPORT remodel_${name} NAMESPACE remodel:: DESTINATION ${REMODEL_PACKAGE_DIR} COMPONENT development)
endforeach()
install(DIRECTORY include/remodel DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
configure_package_config_file(cmake/remodelConfig.cmake.in ${PROJECT_BINARY_DIR}/remodelConfig.cmake
                              INSTALL_DESTINATION ${REMODEL_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/remodelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/remodelConfig.cmake ${PROJECT_BINARY_DIR}/remodelConfigVersion.cmake
        DESTINATION ${REMODEL_PACKAGE_DIR} COMPONENT development)

if(TARGET remodel_program)
  install(TARGETS remodel_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
endif()
if(TARGET remodel_mpi)
  install(TARGETS remodel_mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ranks)
endif()
