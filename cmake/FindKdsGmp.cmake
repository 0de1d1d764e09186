# The targets kds::gmp and kds::mpfr, for the build and for who uses the package: neither library brings one of its own.
foreach(library gmp mpfr)
  string(TOUPPER ${library} name)
  find_library(KDS_${name}_LIBRARY ${library} REQUIRED)
  find_path(KDS_${name}_INCLUDE_DIR ${library}.h REQUIRED)
  mark_as_advanced(KDS_${name}_LIBRARY KDS_${name}_INCLUDE_DIR)
  if(NOT TARGET kds::${library})
    add_library(kds::${library} UNKNOWN IMPORTED GLOBAL)
    set_target_properties(kds::${library} PROPERTIES IMPORTED_LOCATION "${KDS_${name}_LIBRARY}"
                                                     INTERFACE_INCLUDE_DIRECTORIES "${KDS_${name}_INCLUDE_DIR}")
  endif()
endforeach()
