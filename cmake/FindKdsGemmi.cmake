# Finds gemmi: sets KDS_GEMMI_INCLUDE_DIR and, if gemmi has a library, KDS_GEMMI_LIBRARY and the target kds::gemmi. Some versions
# are header-only, and not all packages include a CMake package. Linking a program that reads a PDB file shows whether the
# library is needed.
include(CheckCXXSourceCompiles)
include(CMakePushCheckState)
include(FindPackageHandleStandardArgs)
find_path(KDS_GEMMI_INCLUDE_DIR gemmi/pdb.hpp)
find_library(KDS_GEMMI_LIBRARY gemmi_cpp)
mark_as_advanced(KDS_GEMMI_INCLUDE_DIR KDS_GEMMI_LIBRARY)
set(_kds_gemmi_needed KDS_GEMMI_INCLUDE_DIR)
set(_kds_gemmi_why)
if(KDS_GEMMI_INCLUDE_DIR AND NOT KDS_GEMMI_LIBRARY)
  cmake_push_check_state(RESET)
  set(CMAKE_REQUIRED_INCLUDES "${KDS_GEMMI_INCLUDE_DIR}")
  set(CMAKE_REQUIRED_QUIET ON)
  check_cxx_source_compiles([[
    #include <gemmi/pdb.hpp>
    #include <string>
    int main(int count, char** words) { return gemmi::read_pdb_string(words[count - 1], "").models.empty() ? 0 : 1; }
  ]] KDS_GEMMI_IS_HEADER_ONLY)
  cmake_pop_check_state()
  if(NOT KDS_GEMMI_IS_HEADER_ONLY)
    list(APPEND _kds_gemmi_needed KDS_GEMMI_LIBRARY)
    set(_kds_gemmi_why REASON_FAILURE_MESSAGE "${KDS_GEMMI_INCLUDE_DIR}/gemmi needs its library, gemmi_cpp, which is not there")
  endif()
endif()
find_package_handle_standard_args(KdsGemmi REQUIRED_VARS ${_kds_gemmi_needed} ${_kds_gemmi_why})
if(KdsGemmi_FOUND AND KDS_GEMMI_LIBRARY AND NOT TARGET kds::gemmi)
  add_library(kds::gemmi INTERFACE IMPORTED GLOBAL)
  target_include_directories(kds::gemmi SYSTEM INTERFACE "${KDS_GEMMI_INCLUDE_DIR}")
  target_link_libraries(kds::gemmi INTERFACE "${KDS_GEMMI_LIBRARY}")
endif()
