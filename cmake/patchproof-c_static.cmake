# patchproof::c_static. Written by hand: an exported target would ask a C program for the C++ packages (CGAL's CMake files,
# say) of which only the libraries are linked.
set(patchproof_c_static_FOUND TRUE)
set(_patchproof_libraries ${_patchproof_libdir}/libpatchproof_kernels.a ${_patchproof_libdir}/libpatchproof_exact.a)
foreach(_name tbb mpfi mpfr gmp fmt pugixml md)
  string(TOUPPER ${_name} _upper)
  find_library(PATCHPROOF_${_upper}_LIBRARY ${_name})
  mark_as_advanced(PATCHPROOF_${_upper}_LIBRARY)
  if(PATCHPROOF_${_upper}_LIBRARY)
    list(APPEND _patchproof_libraries ${PATCHPROOF_${_upper}_LIBRARY})
  else()
    set(patchproof_c_static_FOUND FALSE)
    set(patchproof_NOT_FOUND_MESSAGE "patchproof, component c_static: not found: lib${_name}")
  endif()
endforeach()
if(patchproof_c_static_FOUND AND NOT TARGET patchproof::c_static)
  add_library(patchproof::c_static STATIC IMPORTED)
  set_target_properties(patchproof::c_static PROPERTIES IMPORTED_LOCATION ${_patchproof_libdir}/libpatchproof.a
    INTERFACE_INCLUDE_DIRECTORIES ${_patchproof_includedir}
    INTERFACE_LINK_LIBRARIES "${_patchproof_libraries};stdc++;m;pthread")
endif()
