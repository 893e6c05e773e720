# CMake strips only what it has built itself; `cmake --install --strip` and cpack are to strip cargo's libraries, too.
function(strip_installed component name) # STRIP-ARGUMENT...
  set(file "\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/${name}")
  install(CODE "if(CMAKE_INSTALL_DO_STRIP)
    execute_process(COMMAND \"${CMAKE_STRIP}\" ${ARGN} \"${file}\" COMMAND_ERROR_IS_FATAL ANY)
  endif()" COMPONENT ${component})
endfunction()
strip_installed(runtime ${AZULEJO_SHARED_LIBRARY} --strip-unneeded)
strip_installed(development ${azulejo_STATIC} --strip-debug --enable-deterministic-archives)
