# Defines the target kds::flint for the build and for users of the package, because FLINT 2 has neither a CMake package
# nor a pkg-config file.
include(FindPackageHandleStandardArgs)
find_path(KDS_FLINT_INCLUDE_DIR flint/fmpz_poly.h)
find_library(KDS_FLINT_LIBRARY flint)
mark_as_advanced(KDS_FLINT_INCLUDE_DIR KDS_FLINT_LIBRARY)
find_package_handle_standard_args(KdsFlint REQUIRED_VARS KDS_FLINT_LIBRARY KDS_FLINT_INCLUDE_DIR)
if(KdsFlint_FOUND AND NOT TARGET kds::flint)
  add_library(kds::flint UNKNOWN IMPORTED GLOBAL)
  set_target_properties(kds::flint PROPERTIES IMPORTED_LOCATION "${KDS_FLINT_LIBRARY}"
                                              INTERFACE_INCLUDE_DIRECTORIES "${KDS_FLINT_INCLUDE_DIR}")
endif()
