# The target azulejo_cargo: runs cargo, which finds out what is out of date, and places its libraries in
# AZULEJO_OUTPUT_DIR as they are installed: AZULEJO_RUNTIME_LIBRARIES and AZULEJO_DEVELOPMENT_LIBRARIES. On Linux their
# debugging information is in AZULEJO_DEBUG_FILE. Cargo reads
# its own variables: RUSTFLAGS, CARGO_BUILD_JOBS and so on; CARGO names another cargo. With a toolchain file for another
# processor or system cargo builds for that, and links with the compiler of the file.
if(DEFINED ENV{CARGO})
  set(AZULEJO_CARGO "$ENV{CARGO}" CACHE FILEPATH "The cargo to build with")
else()
  find_program(AZULEJO_CARGO cargo HINTS ENV CARGO_HOME "$ENV{HOME}/.cargo" PATH_SUFFIXES bin
               DOC "The cargo to build with")
endif()
if(NOT AZULEJO_CARGO)
  message(FATAL_ERROR "azulejo is built by cargo, which is not installed: see https://rustup.rs")
endif()

# The names of the libraries, which cargo and CMake form by the same rules.
set(azulejo_SHARED ${CMAKE_SHARED_LIBRARY_PREFIX}azulejo${CMAKE_SHARED_LIBRARY_SUFFIX})
set(azulejo_STATIC ${CMAKE_STATIC_LIBRARY_PREFIX}azulejo${CMAKE_STATIC_LIBRARY_SUFFIX})

# What Rust's standard library needs of the system beside threads.
set(azulejo_SYSTEM_LIBRARIES ${CMAKE_DL_LIBS})
if(UNIX)
  list(APPEND azulejo_SYSTEM_LIBRARIES m)
endif()

# What cargo calls the target: its own default, unless CMake builds for another machine than this.
set(target "$ENV{CARGO_BUILD_TARGET}")
if(CMAKE_CROSSCOMPILING AND NOT target)
  set(target_of_Linux-aarch64 aarch64-unknown-linux-gnu)
  set(target_of_Linux-x86_64 x86_64-unknown-linux-gnu)
  set(target_of_Windows-x86_64 x86_64-pc-windows-gnu)
  set(target "${target_of_${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}}")
endif()
set(AZULEJO_CARGO_TARGET "${target}" CACHE STRING "The target to build for, as cargo calls it; empty for this machine")
set(cargo ${AZULEJO_CARGO})
set(cargo_target "")
if(AZULEJO_CARGO_TARGET)
  set(cargo_target --target ${AZULEJO_CARGO_TARGET})
endif()
if(CMAKE_CROSSCOMPILING)
  if(NOT AZULEJO_CARGO_TARGET)
    message(FATAL_ERROR "Set AZULEJO_CARGO_TARGET to what cargo calls ${CMAKE_SYSTEM_NAME} on ${CMAKE_SYSTEM_PROCESSOR}")
  endif()
  string(TOUPPER "CARGO_TARGET_${AZULEJO_CARGO_TARGET}_LINKER" variable)
  string(REPLACE "-" "_" variable "${variable}")
  set(cargo ${CMAKE_COMMAND} -E env ${variable}=${CMAKE_C_COMPILER} ${AZULEJO_CARGO})
endif()

# Where cargo puts the libraries: below a folder of the target's, if there is one; the profile dev is called debug.
set(cargo_target_dir ${PROJECT_BINARY_DIR}/cargo)
string(REGEX REPLACE "^dev$" "debug" cargo_output_dir "${AZULEJO_CARGO_PROFILE}")
set(cargo_output_dir ${cargo_target_dir}/${AZULEJO_CARGO_TARGET}/${cargo_output_dir})

set(AZULEJO_OUTPUT_DIR ${PROJECT_BINARY_DIR}/lib)
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
  include(${CMAKE_CURRENT_LIST_DIR}/linux.cmake)
elseif(WIN32)
  include(${CMAKE_CURRENT_LIST_DIR}/windows.cmake)
else()
  set(AZULEJO_SHARED_LIBRARY ${azulejo_SHARED})
  set(AZULEJO_RUNTIME_LIBRARIES ${AZULEJO_OUTPUT_DIR}/${azulejo_SHARED})
  set(AZULEJO_DEVELOPMENT_LIBRARIES ${AZULEJO_OUTPUT_DIR}/${azulejo_STATIC})
  set(layout COMMAND ${CMAKE_COMMAND} -E copy_if_different ${cargo_output_dir}/${azulejo_SHARED}
                     ${cargo_output_dir}/${azulejo_STATIC} ${AZULEJO_OUTPUT_DIR})
endif()

set(cargo_features "")
if(NOT AZULEJO_EMBREE)
  set(cargo_features --no-default-features)
endif()

file(MAKE_DIRECTORY ${AZULEJO_OUTPUT_DIR})
add_custom_target(azulejo_cargo ALL
  COMMAND ${cargo} build --package azulejo-c --profile ${AZULEJO_CARGO_PROFILE} ${cargo_features} ${cargo_target}
          --target-dir ${cargo_target_dir} ${AZULEJO_CARGO_FLAGS}
  ${layout}
  BYPRODUCTS ${AZULEJO_RUNTIME_LIBRARIES} ${AZULEJO_DEVELOPMENT_LIBRARIES} ${AZULEJO_DEBUG_FILE}
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
  COMMENT "Building libazulejo with cargo"
  USES_TERMINAL VERBATIM)

# The Embree that is loaded where rays are traced, the one whose headers ffi/embree4-sys/build.rs finds, and its version;
# none without.
set(azulejo_EMBREE "")
if(NOT AZULEJO_EMBREE)
  return()
endif()
if(DEFINED ENV{EMBREE_DIR})
  set(embree_prefixes "$ENV{EMBREE_DIR}")
else()
  set(embree_prefixes /usr/local /usr)
endif()
foreach(major 4 3)
  foreach(prefix ${embree_prefixes})
    if(NOT azulejo_EMBREE AND EXISTS ${prefix}/include/embree${major}/rtcore.h)
      set(azulejo_EMBREE embree${major})
      set(embree_headers ${prefix}/include/embree${major})
    endif()
  endforeach()
endforeach()
if(NOT azulejo_EMBREE)
  message(FATAL_ERROR "azulejo needs Embree, 4 or 3.13: install libembree-dev, "
                      "set EMBREE_DIR to a folder that has it in include/, or build with -D AZULEJO_EMBREE=OFF")
endif()
foreach(part MAJOR MINOR)
  file(STRINGS ${embree_headers}/rtcore_config.h line REGEX "#define RTC_VERSION_${part} ")
  string(REGEX MATCH "[0-9]+" azulejo_EMBREE_${part} "${line}")
endforeach()
