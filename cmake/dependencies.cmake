# What packages.txt installs, as targets. Read by our own build and by users of the installed package.
find_package(CGAL REQUIRED)  # brings GMP, MPFR and Boost's headers; only its LGPL parts are used
find_package(TBB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(pugixml REQUIRED)
find_package(fmt REQUIRED)
if(PROJECT_NAME STREQUAL "patchproof")
  find_package(CLI11 REQUIRED)  # the program only
endif()

find_library(PATCHPROOF_MPFI_LIBRARY mpfi REQUIRED)
find_path(PATCHPROOF_MPFI_INCLUDE_DIR mpfi.h REQUIRED)
find_library(PATCHPROOF_MD_LIBRARY md REQUIRED)  # SHA-256
mark_as_advanced(PATCHPROOF_MPFI_LIBRARY PATCHPROOF_MPFI_INCLUDE_DIR PATCHPROOF_MD_LIBRARY)
foreach(name mpfi md)
  if(NOT TARGET patchproof_${name})
    string(TOUPPER ${name} upper)
    add_library(patchproof_${name} INTERFACE IMPORTED)
    target_link_libraries(patchproof_${name} INTERFACE ${PATCHPROOF_${upper}_LIBRARY})
  endif()
endforeach()
