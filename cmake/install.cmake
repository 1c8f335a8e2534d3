# find_package(dualdamp [COMPONENTS core friction_models sim identify scenarios bench plugin]) after an install.
include(CMakePackageConfigHelpers)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dualdamp)
if(TARGET MPI::MPI_CXX)
  set(DUALDAMP_MPI TRUE)
else()
  set(DUALDAMP_MPI FALSE)
endif()
configure_package_config_file(cmake/dualdamp-config.cmake.in ${PROJECT_BINARY_DIR}/dualdamp-config.cmake
  INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/dualdamp-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dualdamp-config.cmake ${PROJECT_BINARY_DIR}/dualdamp-config-version.cmake
  DESTINATION ${config_dir})
install(EXPORT dualdamp NAMESPACE dualdamp:: FILE dualdamp-targets.cmake DESTINATION ${config_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
