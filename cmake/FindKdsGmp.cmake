# Defines the target kds::gmp, GMP with its C++ classes, for the build and for users of the package, because GMP has no CMake package.
include(FindPackageHandleStandardArgs)
find_path(KDS_GMP_INCLUDE_DIR gmp.h)
find_path(KDS_GMPXX_INCLUDE_DIR gmpxx.h)
find_library(KDS_GMP_LIBRARY gmp)
find_library(KDS_GMPXX_LIBRARY gmpxx)
mark_as_advanced(KDS_GMP_INCLUDE_DIR KDS_GMPXX_INCLUDE_DIR KDS_GMP_LIBRARY KDS_GMPXX_LIBRARY)
find_package_handle_standard_args(KdsGmp REQUIRED_VARS KDS_GMPXX_LIBRARY KDS_GMP_LIBRARY KDS_GMPXX_INCLUDE_DIR KDS_GMP_INCLUDE_DIR)
if(KdsGmp_FOUND AND NOT TARGET kds::gmp)
  add_library(kds::gmp UNKNOWN IMPORTED GLOBAL)
  set_target_properties(kds::gmp PROPERTIES IMPORTED_LOCATION "${KDS_GMPXX_LIBRARY}"
                                            INTERFACE_LINK_LIBRARIES "${KDS_GMP_LIBRARY}"
                                            INTERFACE_INCLUDE_DIRECTORIES "${KDS_GMPXX_INCLUDE_DIR};${KDS_GMP_INCLUDE_DIR}")
endif()
