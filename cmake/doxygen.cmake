# The API reference, by Doxygen from the comments of the headers: target docs. The test house.reference checks it.
find_program(PATCHPROOF_DOXYGEN doxygen)
mark_as_advanced(PATCHPROOF_DOXYGEN)
find_package(Python3 COMPONENTS Interpreter)
if(NOT PATCHPROOF_DOXYGEN OR NOT Python3_FOUND)
  message(STATUS "Doxygen not found; no API reference")
  return()
endif()
set(PATCHPROOF_DOCS_DIR ${PROJECT_BINARY_DIR}/docs)
set(PATCHPROOF_DOXYFILE ${PATCHPROOF_DOCS_DIR}/Doxyfile)
configure_file(docs/doxygen/Doxyfile.in ${PATCHPROOF_DOXYFILE} @ONLY)
add_custom_target(docs COMMAND ${PATCHPROOF_DOXYGEN} ${PATCHPROOF_DOXYFILE}
  COMMENT "API reference: ${PATCHPROOF_DOCS_DIR}/html/index.html" VERBATIM)
