# Makes rustc's static library fit to be linked with others: one object that exports what the shared library exports.
# rustc leaves every symbol of the crates and of Rust's std visible, so that two Rust libraries in one program may
# collide. The bitcode that std brings along goes, too: binutils with a plugin of LLVM's choke on it. So does debugging
# information, which would make every program that links the library ten times as large.
#
#   cmake -D FROM=rustc's.a -D EXPORTS_OF=libazulejo.so -D TO=libazulejo.a
#         -D LINKER=ld -D NM=nm -D OBJCOPY=objcopy -D AR=ar -P static.cmake
foreach(name FROM EXPORTS_OF TO LINKER NM OBJCOPY AR)
  if(NOT ${name})
    message(FATAL_ERROR "static.cmake: ${name} is not set")
  endif()
endforeach()

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(symbols names) # NM-ARGUMENT...
  execute_process(COMMAND ${NM} --format=posix ${ARGN} OUTPUT_VARIABLE table COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" table "${table}")
  list(TRANSFORM table REPLACE " .*" "")
  set(${names} "${table}" PARENT_SCOPE)
endfunction()

function(write_lines file)
  list(JOIN ARGN "\n" lines)
  file(WRITE ${file} "${lines}\n")
endfunction()

symbols(exports --dynamic --defined-only ${EXPORTS_OF})
write_lines(${TO}.symbols ${exports})
list(TRANSFORM exports PREPEND "--undefined=")

# COMDAT groups would still be matched by name with those of another library: they are dissolved.
run(${LINKER} -r --gc-sections --force-group-allocation ${exports} -o ${TO}.o ${FROM})
run(${OBJCOPY} --keep-global-symbols=${TO}.symbols --remove-section=.llvmbc --remove-section=.llvmcmd ${TO}.o)

# What only collected sections asked for is still listed, and std's questions for new functions of libc as demands.
run(${OBJCOPY} --strip-unneeded ${TO}.o ${TO}.bare.o)
symbols(listed --undefined-only ${TO}.o)
symbols(needed --undefined-only ${TO}.bare.o)
list(REMOVE_ITEM listed ${needed})
write_lines(${TO}.symbols ${listed})
run(${OBJCOPY} --strip-debug --strip-symbols=${TO}.symbols ${TO}.o)

file(REMOVE ${TO}.new)
run(${AR} rcsD ${TO}.new ${TO}.o)
run(${CMAKE_COMMAND} -E copy_if_different ${TO}.new ${TO})
file(REMOVE ${TO}.new ${TO}.o ${TO}.bare.o ${TO}.symbols)
