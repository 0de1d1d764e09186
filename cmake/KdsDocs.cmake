# Defines the target `docs` if Doxygen is installed: the API reference in docs/html of the build tree. Warnings are errors.
find_package(Doxygen 1.9 QUIET)
if(DOXYGEN_FOUND)
  set(KDS_DOXYGEN_WARNINGS FAIL_ON_WARNINGS)
  configure_file("${PROJECT_SOURCE_DIR}/docs/Doxyfile.in" "${PROJECT_BINARY_DIR}/Doxyfile" @ONLY)
  add_custom_target(docs COMMAND Doxygen::doxygen "${PROJECT_BINARY_DIR}/Doxyfile"
                    COMMENT "API reference: ${PROJECT_BINARY_DIR}/docs/html/index.html" VERBATIM)
else()
  add_custom_target(docs COMMAND ${CMAKE_COMMAND} -E echo "the API reference needs Doxygen (apt-get install doxygen)"
                    COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
endif()
