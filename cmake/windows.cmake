# Included by cargo.cmake: the libraries as MinGW has them. The DLL is installed next to programs, its import library and
# the static library with the other libraries. The static one is rustc's as it is: static.cmake is about ELF.
#
# Out: azulejo_IMPORT, the import library, AZULEJO_RUNTIME_LIBRARIES, AZULEJO_DEVELOPMENT_LIBRARIES and layout, as in
# linux.cmake.
if(NOT MINGW)
  message(FATAL_ERROR "On Windows azulejo is built with MinGW's compiler; others have not been tried")
endif()
# Cargo and CMake call it differently.
set(azulejo_SHARED azulejo.dll)
set(azulejo_IMPORT libazulejo.dll.a)
set(AZULEJO_RUNTIME_LIBRARIES ${AZULEJO_OUTPUT_DIR}/${azulejo_SHARED})
set(AZULEJO_DEVELOPMENT_LIBRARIES ${AZULEJO_OUTPUT_DIR}/${azulejo_IMPORT} ${AZULEJO_OUTPUT_DIR}/${azulejo_STATIC})
set(azulejo_SYSTEM_LIBRARIES ntdll userenv ws2_32 dbghelp)
set(layout COMMAND ${CMAKE_COMMAND} -E copy_if_different ${cargo_output_dir}/${azulejo_SHARED}
                   ${cargo_output_dir}/${azulejo_IMPORT} ${cargo_output_dir}/${azulejo_STATIC} ${AZULEJO_OUTPUT_DIR})
