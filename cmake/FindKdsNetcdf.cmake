# Defines the target kds::netcdf, the C library of NetCDF, for the build and for users of the package. The CMake package of
# netCDF also links HDF5, curl and others, which a shared libnetcdf brings along.
include(FindPackageHandleStandardArgs)
find_path(KDS_NETCDF_INCLUDE_DIR netcdf.h)
find_library(KDS_NETCDF_LIBRARY netcdf)
mark_as_advanced(KDS_NETCDF_INCLUDE_DIR KDS_NETCDF_LIBRARY)
find_package_handle_standard_args(KdsNetcdf REQUIRED_VARS KDS_NETCDF_LIBRARY KDS_NETCDF_INCLUDE_DIR)
if(KdsNetcdf_FOUND AND NOT TARGET kds::netcdf)
  add_library(kds::netcdf UNKNOWN IMPORTED GLOBAL)
  set_target_properties(kds::netcdf PROPERTIES IMPORTED_LOCATION "${KDS_NETCDF_LIBRARY}"
                                               INTERFACE_INCLUDE_DIRECTORIES "${KDS_NETCDF_INCLUDE_DIR}")
endif()
