# Defines the target kds::flint, FLINT with Arb, for the build and for users of the package, because FLINT 2 has neither a CMake
# package nor a pkg-config file. FLINT 3 contains Arb; with FLINT 2, Arb is a separate library.
include(FindPackageHandleStandardArgs)
find_package(KdsGmp QUIET)
find_package(KdsMpfr QUIET)
find_path(KDS_FLINT_INCLUDE_DIR flint/fmpz_poly.h)
find_library(KDS_FLINT_LIBRARY flint)
mark_as_advanced(KDS_FLINT_INCLUDE_DIR KDS_FLINT_LIBRARY)
set(KDS_FLINT_PARTS KDS_FLINT_LIBRARY KDS_FLINT_INCLUDE_DIR)
if(KDS_FLINT_INCLUDE_DIR)
  file(STRINGS "${KDS_FLINT_INCLUDE_DIR}/flint/flint.h" KdsFlint_VERSION REGEX "^#define __FLINT_VERSION(_MINOR|_PATCHLEVEL)? ")
  string(REGEX MATCHALL "[0-9]+" KdsFlint_VERSION "${KdsFlint_VERSION}")
  list(JOIN KdsFlint_VERSION "." KdsFlint_VERSION)
  if(KdsFlint_VERSION VERSION_LESS 3)
    find_path(KDS_ARB_INCLUDE_DIR arb.h)
    find_library(KDS_ARB_LIBRARY NAMES flint-arb arb)
    mark_as_advanced(KDS_ARB_INCLUDE_DIR KDS_ARB_LIBRARY)
    list(PREPEND KDS_FLINT_PARTS KDS_ARB_LIBRARY KDS_ARB_INCLUDE_DIR)
    if(NOT KDS_ARB_LIBRARY OR NOT KDS_ARB_INCLUDE_DIR)
      set(KdsFlint_NOT_FOUND_MESSAGE "FLINT ${KdsFlint_VERSION} is there, but not Arb, which is a part of FLINT 3 only")
    endif()
  endif()
endif()
find_package_handle_standard_args(KdsFlint REQUIRED_VARS ${KDS_FLINT_PARTS} KdsGmp_FOUND KdsMpfr_FOUND
                                           VERSION_VAR KdsFlint_VERSION)
if(KdsFlint_FOUND AND NOT TARGET kds::flint)
  add_library(kds::flint UNKNOWN IMPORTED GLOBAL)
  set_target_properties(kds::flint PROPERTIES IMPORTED_LOCATION "${KDS_FLINT_LIBRARY}"
                                              INTERFACE_LINK_LIBRARIES "kds::mpfr;kds::gmp"
                                              INTERFACE_INCLUDE_DIRECTORIES "${KDS_FLINT_INCLUDE_DIR}")
  if(KDS_ARB_LIBRARY)
    set_target_properties(kds::flint PROPERTIES
      IMPORTED_LOCATION "${KDS_ARB_LIBRARY}" INTERFACE_LINK_LIBRARIES "${KDS_FLINT_LIBRARY};kds::mpfr;kds::gmp"
      INTERFACE_INCLUDE_DIRECTORIES "${KDS_FLINT_INCLUDE_DIR};${KDS_ARB_INCLUDE_DIR}")
  endif()
endif()
