# An overlay port, which builds the tree that it is part of, without Embree: vcpkg install azulejo
# --overlay-ports=packaging/vcpkg. Needs cargo. The package has both libraries, so it has one linkage for all triplets.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../.." ABSOLUTE)

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DAZULEJO_EMBREE=OFF "-DAZULEJO_CARGO_FLAGS=--locked"
  OPTIONS_DEBUG -DAZULEJO_CARGO_PROFILE=dev
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/azulejo)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE-MIT" "${SOURCE_PATH}/LICENSE-APACHE")
