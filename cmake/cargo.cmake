# The target azulejo_cargo: runs cargo, which finds out what is out of date, and places its libraries in
# AZULEJO_OUTPUT_DIR as they are installed: AZULEJO_RUNTIME_LIBRARIES and AZULEJO_DEVELOPMENT_LIBRARIES. Cargo reads
# its own variables: RUSTFLAGS, CARGO_BUILD_JOBS, CARGO_BUILD_TARGET and so on; CARGO names another cargo.
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

# Where cargo puts the libraries: below a folder of the target's, if there is one; the profile dev is called debug.
set(cargo_target_dir ${PROJECT_BINARY_DIR}/cargo)
string(REGEX REPLACE "^dev$" "debug" cargo_output_dir "${AZULEJO_CARGO_PROFILE}")
set(cargo_output_dir ${cargo_target_dir}/$ENV{CARGO_BUILD_TARGET}/${cargo_output_dir})

set(AZULEJO_OUTPUT_DIR ${PROJECT_BINARY_DIR}/lib)
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
  include(${CMAKE_CURRENT_LIST_DIR}/linux.cmake)
else()
  set(AZULEJO_SHARED_LIBRARY ${azulejo_SHARED})
  set(AZULEJO_RUNTIME_LIBRARIES ${AZULEJO_OUTPUT_DIR}/${azulejo_SHARED})
  set(AZULEJO_DEVELOPMENT_LIBRARIES ${AZULEJO_OUTPUT_DIR}/${azulejo_STATIC})
  set(layout COMMAND ${CMAKE_COMMAND} -E copy_if_different ${cargo_output_dir}/${azulejo_SHARED}
                     ${cargo_output_dir}/${azulejo_STATIC} ${AZULEJO_OUTPUT_DIR})
endif()

file(MAKE_DIRECTORY ${AZULEJO_OUTPUT_DIR})
add_custom_target(azulejo_cargo ALL
  COMMAND ${AZULEJO_CARGO} build --package azulejo-c --profile ${AZULEJO_CARGO_PROFILE}
          --target-dir ${cargo_target_dir} ${AZULEJO_CARGO_FLAGS}
  ${layout}
  BYPRODUCTS ${AZULEJO_RUNTIME_LIBRARIES} ${AZULEJO_DEVELOPMENT_LIBRARIES}
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
  COMMENT "Building libazulejo with cargo"
  USES_TERMINAL VERBATIM)

# The Embree that a static libazulejo has to be linked with: the one that ffi/embree4-sys/build.rs finds.
if(DEFINED ENV{EMBREE_DIR})
  set(embree_prefixes "$ENV{EMBREE_DIR}")
else()
  set(embree_prefixes /usr/local /usr)
endif()
set(azulejo_EMBREE "")
foreach(major 4 3)
  foreach(prefix ${embree_prefixes})
    if(NOT azulejo_EMBREE AND EXISTS ${prefix}/include/embree${major}/rtcore.h)
      set(azulejo_EMBREE embree${major})
    endif()
  endforeach()
endforeach()
if(NOT azulejo_EMBREE)
  message(FATAL_ERROR "azulejo needs Embree, 4 or 3.13: install libembree-dev, "
                      "or set EMBREE_DIR to a folder that has it in include/ and lib/")
endif()
