# The target azulejo_cargo: runs cargo, which knows best what is out of date, and lays its libraries out in
# AZULEJO_OUTPUT_DIR as they are installed: AZULEJO_RUNTIME_LIBRARIES and AZULEJO_DEVELOPMENT_LIBRARIES. Cargo heeds
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

set(AZULEJO_OUTPUT_DIR ${PROJECT_BINARY_DIR}/lib)
set(AZULEJO_SHARED_LIBRARY libazulejo.so.${PROJECT_VERSION})
set(AZULEJO_RUNTIME_LIBRARIES ${AZULEJO_OUTPUT_DIR}/${AZULEJO_SHARED_LIBRARY}
                              ${AZULEJO_OUTPUT_DIR}/libazulejo.so.${PROJECT_VERSION_MAJOR})
set(AZULEJO_DEVELOPMENT_LIBRARIES ${AZULEJO_OUTPUT_DIR}/libazulejo.so ${AZULEJO_OUTPUT_DIR}/libazulejo.a)

# Where cargo puts the libraries: below a folder of the target's, if there is one; the profile dev is called debug.
set(cargo_target_dir ${PROJECT_BINARY_DIR}/cargo)
string(REGEX REPLACE "^dev$" "debug" cargo_output_dir "${AZULEJO_CARGO_PROFILE}")
set(cargo_output_dir ${cargo_target_dir}/$ENV{CARGO_BUILD_TARGET}/${cargo_output_dir})

# GNU's linker, whatever the compiler prefers: LLVM's lacks what static.cmake needs.
find_program(AZULEJO_LINKER NAMES ${CMAKE_LIBRARY_ARCHITECTURE}-ld.bfd ld.bfd REQUIRED
             DOC "The linker that makes the static library")
mark_as_advanced(AZULEJO_LINKER)

file(MAKE_DIRECTORY ${AZULEJO_OUTPUT_DIR})
add_custom_target(azulejo_cargo ALL
  COMMAND ${AZULEJO_CARGO} build --package azulejo-c --profile ${AZULEJO_CARGO_PROFILE}
          --target-dir ${cargo_target_dir} ${AZULEJO_CARGO_FLAGS}
  COMMAND ${CMAKE_COMMAND} -E copy_if_different ${cargo_output_dir}/libazulejo.so
          ${AZULEJO_OUTPUT_DIR}/${AZULEJO_SHARED_LIBRARY}
  COMMAND ${CMAKE_COMMAND} -E create_symlink ${AZULEJO_SHARED_LIBRARY}
          ${AZULEJO_OUTPUT_DIR}/libazulejo.so.${PROJECT_VERSION_MAJOR}
  COMMAND ${CMAKE_COMMAND} -E create_symlink libazulejo.so.${PROJECT_VERSION_MAJOR} ${AZULEJO_OUTPUT_DIR}/libazulejo.so
  COMMAND ${CMAKE_COMMAND} -D FROM=${cargo_output_dir}/libazulejo.a -D EXPORTS_OF=${cargo_output_dir}/libazulejo.so
          -D TO=${AZULEJO_OUTPUT_DIR}/libazulejo.a -D LINKER=${AZULEJO_LINKER} -D NM=${CMAKE_NM}
          -D OBJCOPY=${CMAKE_OBJCOPY} -D AR=${CMAKE_AR} -P ${CMAKE_CURRENT_LIST_DIR}/static.cmake
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
