# Debian packages, one for each component of cmake/install.cmake: `./dev packages`, or `cpack` in the build folder.
if(NOT PROJECT_IS_TOP_LEVEL)
  return()  # the packages of a project that contains this one are its own business
endif()
set(PATCHPROOF_MAINTAINER "patchproof maintainers <maintainers@patchproof.example>" CACHE STRING "Of Debian packages")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME patchproof)
set(CPACK_PACKAGE_VENDOR patchproof)
set(CPACK_PACKAGE_CONTACT "${PATCHPROOF_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_THREADS 0)  # as many as there are processors
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${PATCHPROOF_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_SECTION math)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})  # the module finds our own shared library
set(debian_version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
set(runtime_package libpatchproof${PATCHPROOF_ABI_VERSION})

set(texts ${PROJECT_BINARY_DIR}/packaging)
file(TIMESTAMP ${PROJECT_SOURCE_DIR}/CHANGELOG.md changed "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(packaging/debian/changelog.in ${texts}/changelog @ONLY)
foreach(text ${texts}/changelog ${PROJECT_SOURCE_DIR}/packaging/patchproof.1)
  get_filename_component(name ${text} NAME)
  execute_process(COMMAND gzip -9nc ${text} OUTPUT_FILE ${texts}/${name}.gz COMMAND_ERROR_IS_FATAL ANY)
endforeach()

# patchproof_package(COMPONENT NAME SECTION DESCRIPTION COPYRIGHT…): its texts of packaging/debian, one after the other
function(patchproof_package component name section description)
  string(TOUPPER ${component} upper)
  set(copyright)
  foreach(part ${ARGN})
    file(READ ${PROJECT_SOURCE_DIR}/packaging/debian/copyright_${part}.txt text)
    string(APPEND copyright "${text}")
  endforeach()
  file(WRITE ${texts}/${name}.copyright "${copyright}")
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${name})
  install(FILES ${texts}/${name}.copyright DESTINATION ${folder} RENAME copyright COMPONENT ${component})
  install(FILES ${texts}/changelog.gz DESTINATION ${folder} RENAME changelog.Debian.gz COMPONENT ${component})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${description}" PARENT_SCOPE)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
endfunction()

set(CPACK_COMPONENTS_ALL)
set(about "patchproof proves how the patches of a free-form model join (C0, C1, C2,
G1), bounds gaps and normal angles along whole edges, and evaluates Bezier,
B-spline, NURBS, Gregory and GERBS patches fast, with bounds, or exactly.")
patchproof_package(runtime ${runtime_package} libs "exact and certified free-form geometry (shared library)
${about}
.
This is the shared library with its C interface." ours libraries)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/triggers)

patchproof_package(dev libpatchproof-dev libdevel "exact and certified free-form geometry (development files)
${about}
.
Headers of the C and the C++ interface, static libraries, files for CMake and
pkg-config. The C interface needs nothing else; the recommended packages are
for programs that use the C++ headers or link statically." ours libraries)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${runtime_package} (= ${debian_version})")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "libboost-dev, libcgal-dev, libfmt-dev, libgmp-dev, libmd-dev, libmpfi-dev, \
libmpfr-dev, libpugixml-dev, libtbb-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEV_PACKAGE_GENERATE_SHLIBS OFF)

if(TARGET patchproof_program)
  patchproof_package(tools patchproof-tools math "exact and certified free-form geometry (program)
${about}
.
This is the program: it certifies, evaluates, fills, tessellates, converts and
draws models, STEP, IGES and BREP files among them." ours libraries tools bsd)
  set(CPACK_DEBIAN_TOOLS_PACKAGE_GENERATE_SHLIBS OFF)
  install(FILES ${texts}/patchproof.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
endif()

get_cmake_property(components COMPONENTS)
if("python" IN_LIST components)  # what python/CMakeLists.txt installs
  patchproof_package(python python3-patchproof python "exact and certified free-form geometry (Python module)
${about}
.
This is the Python module; it takes and returns arrays of numpy without copies." ours python bsd)
  get_directory_property(major DIRECTORY ${PROJECT_SOURCE_DIR}/python DEFINITION Python_VERSION_MAJOR)
  get_directory_property(minor DIRECTORY ${PROJECT_SOURCE_DIR}/python DEFINITION Python_VERSION_MINOR)
  math(EXPR next "${minor} + 1")  # the module is for one version's binary interface
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "${runtime_package} (= ${debian_version}), python3 (>= ${major}.${minor}), python3 (<< ${major}.${next}), \
python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_GENERATE_SHLIBS OFF)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/python/postinst
    ${PROJECT_SOURCE_DIR}/packaging/debian/python/prerm)
endif()
include(CPack)

# Builds what is installed, no more, and packs it.
add_custom_target(packages
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${CPACK_OUTPUT_FILE_PREFIX}
  COMMAND ${CMAKE_CPACK_COMMAND} --config ${PROJECT_BINARY_DIR}/CPackConfig.cmake
  DEPENDS patchproof_c patchproof_c_static patchproof_exact patchproof_kernels
          $<TARGET_NAME_IF_EXISTS:patchproof_program> $<TARGET_NAME_IF_EXISTS:patchproof_python>
  WORKING_DIRECTORY ${PROJECT_BINARY_DIR} USES_TERMINAL)
