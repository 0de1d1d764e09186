# Defines the package for `cmake --install` and for find_package(kds) in the build tree. Each library is a component with its own
# file of targets, so a user of the engine needs none of the packages that only structures require.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Headers include each other as "kds/simulator.h", "motions/curves/...". A folder of their own avoids clashes with other
# projects' headers.
set(KDS_HEADER_FOLDER "${CMAKE_INSTALL_INCLUDEDIR}/kds")
set(KDS_PACKAGE_FOLDER "${CMAKE_INSTALL_LIBDIR}/cmake/kds")
set(KDS_PKGCONFIG_FOLDER "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

# kds_install_component(<component> TARGETS <target>... [REQUIRES <pkg-config packages>...] [LIBRARIES <files>...])
function(kds_install_component component)
  cmake_parse_arguments(ARG "" "" "TARGETS;REQUIRES;LIBRARIES" ${ARGN})
  set(libraries "")
  foreach(target IN LISTS ARG_TARGETS)
    set(headers "")
    get_target_property(sets ${target} INTERFACE_HEADER_SETS)
    if(sets)
      foreach(set IN LISTS sets)
        list(APPEND headers FILE_SET ${set} DESTINATION "${KDS_HEADER_FOLDER}" COMPONENT ${component})
      endforeach()
      string(APPEND libraries " -l${target}")
    endif()
    install(TARGETS ${target} EXPORT kds_${component}
            ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${component} ${headers})
  endforeach()
  install(EXPORT kds_${component} NAMESPACE kds:: FILE kds-${component}.cmake DESTINATION "${KDS_PACKAGE_FOLDER}"
          COMPONENT ${component})
  export(EXPORT kds_${component} NAMESPACE kds:: FILE "${PROJECT_BINARY_DIR}/kds-${component}.cmake")

  # Libraries without a pkg-config package.
  foreach(file IN LISTS ARG_LIBRARIES)
    string(APPEND libraries " ${file}")
  endforeach()

  # pkg-config packages: kds-engine and so on for the components, and kds for all of them.
  set(name kds-${component})
  if(component STREQUAL "kds")
    set(name kds)
  endif()
  list(JOIN ARG_REQUIRES ", " requires)
  file(RELATIVE_PATH prefix "/p/${KDS_PKGCONFIG_FOLDER}" "/p")
  string(REGEX REPLACE "/$" "" prefix "${prefix}")
  configure_file("${PROJECT_SOURCE_DIR}/cmake/kds.pc.in" "${PROJECT_BINARY_DIR}/${name}.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION "${KDS_PKGCONFIG_FOLDER}" COMPONENT ${component})
endfunction()

set(gemmi "")
if(KDS_GEMMI_LIBRARY)
  set(gemmi "${KDS_GEMMI_LIBRARY}")
endif()
kds_install_component(motions TARGETS kds_requirements kds_options kds_motions REQUIRES eigen3 fmt zlib netcdf gmpxx gmp
                      LIBRARIES ${gemmi})
kds_install_component(certificates TARGETS kds_certificates REQUIRES kds-motions LIBRARIES ${KDS_ARB_LIBRARY} "${KDS_FLINT_LIBRARY}")
kds_install_component(engine TARGETS kds_engine REQUIRES kds-certificates)
kds_install_component(structures TARGETS kds_structures REQUIRES kds-engine mpfr)
kds_install_component(kds TARGETS kds_all REQUIRES kds-structures)
install(TARGETS kds_program RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT motions)

write_basic_package_version_file("${PROJECT_BINARY_DIR}/kdsConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
configure_file("${PROJECT_SOURCE_DIR}/cmake/kdsConfig.cmake" "${PROJECT_BINARY_DIR}/kdsConfig.cmake" COPYONLY)
set(modules FindKdsFlint.cmake FindKdsGmp.cmake FindKdsMpfr.cmake FindKdsNetcdf.cmake)
file(REMOVE "${PROJECT_BINARY_DIR}/FindKdsGemmi.cmake")
if(KDS_GEMMI_LIBRARY)
  list(APPEND modules FindKdsGemmi.cmake)
endif()
foreach(module IN LISTS modules)
  configure_file("${PROJECT_SOURCE_DIR}/cmake/${module}" "${PROJECT_BINARY_DIR}/${module}" COPYONLY)
endforeach()
list(TRANSFORM modules PREPEND "${PROJECT_BINARY_DIR}/")
install(FILES "${PROJECT_BINARY_DIR}/kdsConfig.cmake" "${PROJECT_BINARY_DIR}/kdsConfigVersion.cmake" ${modules}
        DESTINATION "${KDS_PACKAGE_FOLDER}" COMPONENT motions)
