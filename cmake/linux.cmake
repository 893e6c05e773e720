# Included by cargo.cmake: the libraries as Linux has them. The shared one is named after its version and found by its
# SONAME (which ffi/azulejo-c/build.rs writes into it), with its debugging information in a file beside it; the static one
# is made fit to be linked with others.
#
# Out: AZULEJO_SHARED_LIBRARY, AZULEJO_RUNTIME_LIBRARIES, AZULEJO_DEBUG_FILE, AZULEJO_DEVELOPMENT_LIBRARIES,
# azulejo_SONAME, and layout, the commands that lay out what cargo has built.
set(azulejo_SONAME ${azulejo_SHARED}.${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(AZULEJO_SHARED_LIBRARY ${azulejo_SHARED}.${PROJECT_VERSION})
set(AZULEJO_RUNTIME_LIBRARIES ${AZULEJO_OUTPUT_DIR}/${AZULEJO_SHARED_LIBRARY} ${AZULEJO_OUTPUT_DIR}/${azulejo_SONAME})
set(AZULEJO_DEBUG_FILE ${AZULEJO_OUTPUT_DIR}/${AZULEJO_SHARED_LIBRARY}.debug)
set(AZULEJO_DEVELOPMENT_LIBRARIES ${AZULEJO_OUTPUT_DIR}/${azulejo_SHARED} ${AZULEJO_OUTPUT_DIR}/${azulejo_STATIC})

# GNU's linker, whatever the compiler prefers: LLVM's lacks what static.cmake needs.
find_program(AZULEJO_LINKER NAMES ${CMAKE_LIBRARY_ARCHITECTURE}-ld.bfd ld.bfd REQUIRED
             DOC "The linker that makes the static library")
mark_as_advanced(AZULEJO_LINKER)

set(layout
  COMMAND ${CMAKE_COMMAND} -D FROM=${cargo_output_dir}/${azulejo_SHARED}
          -D TO=${AZULEJO_OUTPUT_DIR}/${AZULEJO_SHARED_LIBRARY} -D OBJCOPY=${CMAKE_OBJCOPY}
          -P ${CMAKE_CURRENT_LIST_DIR}/split.cmake
  COMMAND ${CMAKE_COMMAND} -E create_symlink ${AZULEJO_SHARED_LIBRARY} ${AZULEJO_OUTPUT_DIR}/${azulejo_SONAME}
  COMMAND ${CMAKE_COMMAND} -E create_symlink ${azulejo_SONAME} ${AZULEJO_OUTPUT_DIR}/${azulejo_SHARED}
  COMMAND ${CMAKE_COMMAND} -D FROM=${cargo_output_dir}/${azulejo_STATIC} -D EXPORTS_OF=${cargo_output_dir}/${azulejo_SHARED}
          -D TO=${AZULEJO_OUTPUT_DIR}/${azulejo_STATIC} -D LINKER=${AZULEJO_LINKER} -D NM=${CMAKE_NM}
          -D OBJCOPY=${CMAKE_OBJCOPY} -D AR=${CMAKE_AR} -P ${CMAKE_CURRENT_LIST_DIR}/static.cmake)
