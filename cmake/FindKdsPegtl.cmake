# Finds PEGTL, the parser that gemmi reads CIF with: KDS_PEGTL_INCLUDE_DIR. Most packages of gemmi bring it along, Debian's does not.
include(FindPackageHandleStandardArgs)
find_path(KDS_PEGTL_INCLUDE_DIR tao/pegtl.hpp HINTS "${KDS_GEMMI_INCLUDE_DIR}/gemmi/third_party")
mark_as_advanced(KDS_PEGTL_INCLUDE_DIR)
find_package_handle_standard_args(KdsPegtl REQUIRED_VARS KDS_PEGTL_INCLUDE_DIR)
