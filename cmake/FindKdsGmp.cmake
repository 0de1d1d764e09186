# Defines the target kds::gmp for the build and for users of the package, because GMP has no CMake package.
include(FindPackageHandleStandardArgs)
find_path(KDS_GMP_INCLUDE_DIR gmp.h)
find_library(KDS_GMP_LIBRARY gmp)
mark_as_advanced(KDS_GMP_INCLUDE_DIR KDS_GMP_LIBRARY)
find_package_handle_standard_args(KdsGmp REQUIRED_VARS KDS_GMP_LIBRARY KDS_GMP_INCLUDE_DIR)
if(KdsGmp_FOUND AND NOT TARGET kds::gmp)
  add_library(kds::gmp UNKNOWN IMPORTED GLOBAL)
  set_target_properties(kds::gmp PROPERTIES IMPORTED_LOCATION "${KDS_GMP_LIBRARY}"
                                            INTERFACE_INCLUDE_DIRECTORIES "${KDS_GMP_INCLUDE_DIR}")
endif()
