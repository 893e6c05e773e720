# Debian packages: libazulejo0.3 (of version 0.3), the shared library, libazulejo0.3-dbgsym, its debugging information,
# and libazulejo-dev, what programs are built with.
#
#   cmake -S . -B build -DCMAKE_INSTALL_PREFIX=/usr && cmake --build build && (cd build && cpack -G DEB)
#
# The packages belong to the release of Debian that they are made on, whose Embree they depend on: it is loaded only where
# rays are traced, but that is what iterations do by default. They are named after the SONAME, so that libraries of two
# ABIs can be installed side by side.
set(CPACK_PACKAGE_NAME azulejo)
set(CPACK_PACKAGE_VENDOR azulejo)
set(CPACK_PACKAGE_CONTACT "azulejo developers <developers@azulejo.invalid>" CACHE STRING "The packages' maintainer")
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_COMPONENTS_ALL runtime debug development)
set(CPACK_COMPONENT_DEBUG_DEPENDS runtime)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS runtime)

set(runtime_package libazulejo${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(debug_package ${runtime_package}-dbgsym)
set(development_package libazulejo-dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${runtime_package})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME ${development_package})
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEBUG_PACKAGE_NAME ${debug_package})
set(CPACK_DEBIAN_DEBUG_PACKAGE_SECTION debug)
# The version is that of the headers, down to the minor one: src/trace refuses another.
if(azulejo_EMBREE)
  math(EXPR next "${azulejo_EMBREE_MINOR} + 1")
  set(embree_package lib${azulejo_EMBREE}-${azulejo_EMBREE_MAJOR})
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS
      "${embree_package} (>= ${azulejo_EMBREE_MAJOR}.${azulejo_EMBREE_MINOR}), ${embree_package} (<< ${azulejo_EMBREE_MAJOR}.${next}~)")
endif()

# Without a summary the first line of each description is the summary.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(description
"Maximal Poisson-disk sets in the plane and on triangle meshes, and their
relaxation by distance constraints: deterministic, free of conflicts, for
renderers and geometry programs.")
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "blue-noise sampling of planes and meshes\n${description}")
set(CPACK_DEBIAN_DEBUG_DESCRIPTION "blue-noise sampling of planes and meshes (debugging information)\n${description}
.
This package has the debugging information of the shared library.")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "blue-noise sampling of planes and meshes (development files)\n${description}
.
This package has the C and C++ headers, the static library, the CMake package
and the pkg-config file.")

# cpack's own call of ldconfig comes on top, and cannot be turned off.
file(WRITE ${PROJECT_BINARY_DIR}/debian/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/triggers)

# What Debian wants in share/doc of each package: the licences, also of the crates inside, and a changelog.
file(READ LICENSE-MIT MIT)
string(REGEX REPLACE "\n(\n*)" "\n\\1  " MIT "  ${MIT}")
configure_file(cmake/copyright.in debian/licence @ONLY)
add_custom_command(OUTPUT debian/copyright
  COMMAND ${CMAKE_COMMAND} -E cat debian/licence ${azulejo_NOTICES} > debian/copyright
  DEPENDS ${azulejo_NOTICES} ${PROJECT_BINARY_DIR}/debian/licence VERBATIM)
add_custom_target(azulejo_copyright ALL DEPENDS debian/copyright)
add_dependencies(azulejo_copyright azulejo_notices)
string(TIMESTAMP DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)

foreach(component runtime debug development)
  set(PACKAGE ${${component}_package})
  configure_file(cmake/changelog.in debian/${PACKAGE}/changelog.Debian @ONLY)
  execute_process(COMMAND gzip --force --best --no-name ${PROJECT_BINARY_DIR}/debian/${PACKAGE}/changelog.Debian
                  COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${PROJECT_BINARY_DIR}/debian/copyright ${PROJECT_BINARY_DIR}/debian/${PACKAGE}/changelog.Debian.gz
          DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${PACKAGE} COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

include(CPack)
