# The targets of azulejo, for this tree and for the installed package: azulejo::azulejo, the shared library, and
# azulejo::azulejo_static, which brings its link line along and is defined only where Embree's library is found.
#
# In: azulejo_INCLUDE_DIR, azulejo_LIBRARY_DIR, the names of the files azulejo_SHARED and azulejo_STATIC, azulejo_SONAME
# where there is one, azulejo_EMBREE, the name of Embree's library, and the azulejo_SYSTEM_LIBRARIES.
if(TARGET azulejo::azulejo)
  return()
endif()

add_library(azulejo::azulejo SHARED IMPORTED GLOBAL)
set_target_properties(azulejo::azulejo PROPERTIES
  IMPORTED_LOCATION ${azulejo_LIBRARY_DIR}/${azulejo_SHARED}
  INTERFACE_INCLUDE_DIRECTORIES ${azulejo_INCLUDE_DIR})
if(azulejo_SONAME)
  set_target_properties(azulejo::azulejo PROPERTIES IMPORTED_SONAME ${azulejo_SONAME})
endif()

find_library(azulejo_EMBREE_LIBRARY ${azulejo_EMBREE} HINTS ENV EMBREE_DIR PATH_SUFFIXES lib lib64)
mark_as_advanced(azulejo_EMBREE_LIBRARY)
if(azulejo_EMBREE_LIBRARY)
  set(THREADS_PREFER_PTHREAD_FLAG ON)
  find_package(Threads REQUIRED)
  add_library(azulejo::azulejo_static STATIC IMPORTED GLOBAL)
  set_target_properties(azulejo::azulejo_static PROPERTIES
    IMPORTED_LOCATION ${azulejo_LIBRARY_DIR}/${azulejo_STATIC}
    INTERFACE_INCLUDE_DIRECTORIES ${azulejo_INCLUDE_DIR}
    INTERFACE_LINK_LIBRARIES "${azulejo_EMBREE_LIBRARY};Threads::Threads;${azulejo_SYSTEM_LIBRARIES}")
endif()
