vcpkg_from_github(OUT_SOURCE_PATH SOURCE_PATH
                  REPO project-gemmi/gemmi
                  REF "v${VERSION}"
                  SHA512 FILL_GEMMI_SHA512)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}")
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/gemmi)
vcpkg_copy_tools(TOOL_NAMES gemmi AUTO_CLEAN)
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE.txt")
