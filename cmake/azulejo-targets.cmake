# The targets of azulejo, for this tree and for the installed package: azulejo::azulejo, the shared library, and
# azulejo::azulejo_static, which brings its link line along.
#
# In: azulejo_INCLUDE_DIR, azulejo_LIBRARY_DIR, azulejo_RUNTIME_DIR, which has the shared library, the names of the files
# azulejo_SHARED and azulejo_STATIC, azulejo_IMPORT, a DLL's import library, and azulejo_SONAME where there is one, and
# the azulejo_SYSTEM_LIBRARIES.
if(TARGET azulejo::azulejo)
  return()
endif()

add_library(azulejo::azulejo SHARED IMPORTED GLOBAL)
set_target_properties(azulejo::azulejo PROPERTIES
  IMPORTED_LOCATION ${azulejo_RUNTIME_DIR}/${azulejo_SHARED}
  INTERFACE_INCLUDE_DIRECTORIES ${azulejo_INCLUDE_DIR})
if(azulejo_SONAME)
  set_target_properties(azulejo::azulejo PROPERTIES IMPORTED_SONAME ${azulejo_SONAME})
endif()
if(azulejo_IMPORT)
  set_target_properties(azulejo::azulejo PROPERTIES IMPORTED_IMPLIB ${azulejo_LIBRARY_DIR}/${azulejo_IMPORT})
endif()

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
add_library(azulejo::azulejo_static STATIC IMPORTED GLOBAL)
set_target_properties(azulejo::azulejo_static PROPERTIES
  IMPORTED_LOCATION ${azulejo_LIBRARY_DIR}/${azulejo_STATIC}
  INTERFACE_INCLUDE_DIRECTORIES ${azulejo_INCLUDE_DIR}
  INTERFACE_LINK_LIBRARIES "${azulejo_SYSTEM_LIBRARIES};Threads::Threads")
