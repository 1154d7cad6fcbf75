include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/patchproof)

install(TARGETS patchproof_exact patchproof_kernels patchproof_all EXPORT patchproof-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET patchproof_program)
  install(TARGETS patchproof_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY include/patchproof DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT patchproof-targets NAMESPACE patchproof:: DESTINATION ${config_dir})

configure_package_config_file(cmake/patchproof-config.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/patchproof-config.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/patchproof-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/patchproof-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/patchproof-config-version.cmake cmake/dependencies.cmake DESTINATION ${config_dir})
