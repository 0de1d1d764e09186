# The target kds::gemmi, for the build and for users of the package. Some versions of gemmi are header-only, others have a library,
# and not all packages of either bring a CMake package. The functions that kds calls tell which it is.
include(CheckCXXSourceCompiles)
include(FindPackageHandleStandardArgs)
find_path(KDS_GEMMI_INCLUDE_DIR gemmi/pdb.hpp)
find_library(KDS_GEMMI_LIBRARY gemmi_cpp)
mark_as_advanced(KDS_GEMMI_INCLUDE_DIR KDS_GEMMI_LIBRARY)
set(_kds_gemmi_needed KDS_GEMMI_INCLUDE_DIR)
set(_kds_gemmi_why)
if(KDS_GEMMI_INCLUDE_DIR AND NOT KDS_GEMMI_LIBRARY)
  set(CMAKE_REQUIRED_INCLUDES "${KDS_GEMMI_INCLUDE_DIR}")
  set(CMAKE_REQUIRED_QUIET ON)
  check_cxx_source_compiles([[
    #include <gemmi/pdb.hpp>
    #include <string>
    int main(int count, char** words) { return gemmi::read_pdb_string(words[count - 1], "").models.empty() ? 0 : 1; }
  ]] KDS_GEMMI_IS_HEADER_ONLY)
  unset(CMAKE_REQUIRED_INCLUDES)
  unset(CMAKE_REQUIRED_QUIET)
  if(NOT KDS_GEMMI_IS_HEADER_ONLY)
    list(APPEND _kds_gemmi_needed KDS_GEMMI_LIBRARY)
    set(_kds_gemmi_why REASON_FAILURE_MESSAGE "${KDS_GEMMI_INCLUDE_DIR}/gemmi needs its library, gemmi_cpp, which is not there")
  endif()
endif()
find_package_handle_standard_args(KdsGemmi REQUIRED_VARS ${_kds_gemmi_needed} ${_kds_gemmi_why})
if(KdsGemmi_FOUND AND NOT TARGET kds::gemmi)
  add_library(kds::gemmi INTERFACE IMPORTED GLOBAL)
  target_include_directories(kds::gemmi SYSTEM INTERFACE "${KDS_GEMMI_INCLUDE_DIR}")
  if(KDS_GEMMI_LIBRARY)
    target_link_libraries(kds::gemmi INTERFACE "${KDS_GEMMI_LIBRARY}")
  endif()
endif()
