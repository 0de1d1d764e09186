# Defines the target kds::mpfr for the build and for users of the package, because MPFR has no CMake package.
include(FindPackageHandleStandardArgs)
find_path(KDS_MPFR_INCLUDE_DIR mpfr.h)
find_library(KDS_MPFR_LIBRARY mpfr)
mark_as_advanced(KDS_MPFR_INCLUDE_DIR KDS_MPFR_LIBRARY)
find_package_handle_standard_args(KdsMpfr REQUIRED_VARS KDS_MPFR_LIBRARY KDS_MPFR_INCLUDE_DIR)
if(KdsMpfr_FOUND AND NOT TARGET kds::mpfr)
  add_library(kds::mpfr UNKNOWN IMPORTED GLOBAL)
  set_target_properties(kds::mpfr PROPERTIES IMPORTED_LOCATION "${KDS_MPFR_LIBRARY}"
                                             INTERFACE_INCLUDE_DIRECTORIES "${KDS_MPFR_INCLUDE_DIR}")
endif()
