# Splits the shared library that rustc makes: the code, and beside it the debugging information, which is most of the size
# and which debuggers find by the name and the checksum that the library says, or by its build ID.
#
#   cmake -D FROM=rustc's.so -D TO=libazulejo.so.VERSION -D OBJCOPY=objcopy -P split.cmake      makes TO and TO.debug
foreach(name FROM TO OBJCOPY)
  if(NOT ${name})
    message(FATAL_ERROR "split.cmake: ${name} is not set")
  endif()
endforeach()

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The checksum is of the file at its place, under its own name.
set(new ${TO}.new)
file(MAKE_DIRECTORY ${new})
cmake_path(GET TO FILENAME name)
run(${OBJCOPY} --only-keep-debug ${FROM} ${new}/${name}.debug)
run(${OBJCOPY} --strip-unneeded --add-gnu-debuglink=${new}/${name}.debug ${FROM} ${new}/${name})
run(${CMAKE_COMMAND} -E copy_if_different ${new}/${name} ${TO})
run(${CMAKE_COMMAND} -E copy_if_different ${new}/${name}.debug ${TO}.debug)
file(REMOVE_RECURSE ${new})
