# Writes the notices of third parties: what is compiled into the libraries besides azulejo, with licences and copyright.
#
#   cmake -D CARGO=cargo -D SOURCE=the project's folder -D TO=THIRD-PARTY.txt -P notices.cmake
#
# Each text stands there once. That of the Apache License 2.0 is left out: it is LICENSE-APACHE, which is installed too.
foreach(name CARGO SOURCE TO)
  if(NOT ${name})
    message(FATAL_ERROR "notices.cmake: ${name} is not set")
  endif()
endforeach()

function(cargo output) # ARGUMENT...
  execute_process(COMMAND ${CARGO} ${ARGN} WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

# The crates as a table, and as a list of NAME-VERSION.
function(find_crates table names)
  cargo(tree tree --locked --package azulejo-c --edges normal,no-proc-macro --prefix none --format "{p}|{l}|{r}")
  string(REGEX MATCHALL "[^\n]+" tree "${tree}")
  list(FILTER tree EXCLUDE REGEX "^azulejo|\\(\\*\\)")
  list(SORT tree)
  list(REMOVE_DUPLICATES tree)
  list(TRANSFORM tree REPLACE "^([^ ]+) v([^ |]+).*" "\\1-\\2" OUTPUT_VARIABLE crates)
  list(TRANSFORM tree REPLACE "^([^ ]+) v([^ |]+)[^|]*\\|([^|]*)\\|(.*)$" "  \\1 \\2 (\\3)\n    \\4")
  list(JOIN tree "\n" tree)
  set(${table} "${tree}" PARENT_SCOPE)
  set(${names} "${crates}" PARENT_SCOPE)
endfunction()

# Appends what the crates say about their licences and copyright.
function(append_licences) # NAME-VERSION...
  cargo(version version --verbose)
  string(REGEX MATCH "host: ([^\n]+)" found "${version}")
  # Without a platform cargo would fetch what other systems need.
  cargo(metadata metadata --locked --format-version 1 --filter-platform ${CMAKE_MATCH_1})
  foreach(crate ${ARGN})
    # The folder of a crate in cargo's registry is named after it.
    string(REGEX MATCH "\"manifest_path\":\"([^\"]*/${crate})/Cargo.toml\"" found "${metadata}")
    if(NOT found)
      message(FATAL_ERROR "cargo metadata does not know ${crate}")
    endif()
    file(GLOB texts ${CMAKE_MATCH_1}/[Ll][Ii][Cc][Ee][Nn][CcSs][Ee]* ${CMAKE_MATCH_1}/COPYING* ${CMAKE_MATCH_1}/COPYRIGHT*)
    list(FILTER texts EXCLUDE REGEX "APACHE|apache")
    foreach(text ${texts})
      file(SHA256 ${text} digest)
      list(APPEND crates_of_${digest} ${crate})
      set(text_of_${digest} ${text})
      list(APPEND digests ${digest})
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES digests)
  foreach(digest ${digests})
    list(JOIN crates_of_${digest} ", " names)
    file(READ ${text_of_${digest}} text)
    file(APPEND ${TO} "\n\n--- ${names}:\n\n${text}")
  endforeach()
endfunction()

find_crates(table crates)
file(WRITE ${TO} "The libraries of azulejo contain the standard library of Rust (MIT or Apache-2.0,
https://github.com/rust-lang/rust, copyright: The Rust Project Developers) and
these crates, under their own licences, whose texts follow, and copyright of their
authors:

${table}
")
append_licences(${crates})
