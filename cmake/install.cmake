# What `cmake --install` puts in place, in the components that become packages (cmake/packages.cmake):
#   runtime  libpatchproof.so.N        dev  headers, static libraries, CMake and pkg-config files
#   tools    the program               python  (python/CMakeLists.txt)
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/patchproof)
set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(TARGETS patchproof_c EXPORT patchproof-c
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT dev)
install(TARGETS patchproof_c_static ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
install(TARGETS patchproof_exact patchproof_kernels patchproof_all EXPORT patchproof-cxx
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
if(TARGET patchproof_program)
  install(TARGETS patchproof_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
endif()
install(DIRECTORY include/patchproof DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)

# find_package(patchproof COMPONENTS c | c_static | cxx)
install(EXPORT patchproof-c NAMESPACE patchproof:: FILE patchproof-c.cmake DESTINATION ${config_dir} COMPONENT dev)
install(EXPORT patchproof-cxx NAMESPACE patchproof:: FILE patchproof-cxx.cmake DESTINATION ${config_dir} COMPONENT dev)
configure_package_config_file(cmake/patchproof-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/patchproof-config.cmake
  INSTALL_DESTINATION ${config_dir} PATH_VARS CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/patchproof-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/patchproof-config.cmake cmake/patchproof-c_static.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/patchproof-config-version.cmake cmake/number_libraries.cmake
  DESTINATION ${config_dir} COMPONENT dev)

# pkg-config, relative to where the files lie, unless somebody asked for absolute folders.
if(IS_ABSOLUTE ${pkgconfig_dir})
  set(PATCHPROOF_PC_PREFIX ${CMAKE_INSTALL_PREFIX})
else()
  file(RELATIVE_PATH up /${pkgconfig_dir} /)
  string(REGEX REPLACE "/$" "" PATCHPROOF_PC_PREFIX "\${pcfiledir}/${up}")
endif()
cmake_path(APPEND PATCHPROOF_PC_LIBDIR "\${prefix}" "${CMAKE_INSTALL_LIBDIR}")  # of two paths the absolute one
cmake_path(APPEND PATCHPROOF_PC_INCLUDEDIR "\${prefix}" "${CMAKE_INSTALL_INCLUDEDIR}")
set(PATCHPROOF_LINKED "-ltbb -lmpfi -lmpfr -lgmp -lfmt -lpugixml -lmd")
foreach(name patchproof patchproof-static patchproof-cxx)
  configure_file(cmake/${name}.pc.in ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${pkgconfig_dir} COMPONENT dev)
endforeach()

# What the headers point to, and programs to begin with.
set(documents share/doc/libpatchproof-dev)
install(FILES docs/library.md docs/formats.md docs/model.schema.json docs/mathematics.md docs/errata.md docs/licences.md
  DESTINATION ${documents} COMPONENT dev)
file(GLOB c_examples CONFIGURE_DEPENDS examples/c/*.c)
install(FILES ${c_examples} DESTINATION ${documents}/examples COMPONENT dev)
install(FILES examples/cup.json examples/meshes/football.json DESTINATION ${documents}/examples COMPONENT dev)
