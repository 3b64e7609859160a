# Run by cpack once all is in the folder of the package: what Debian asks of a package besides. That is a compressed man
# page, a change log in Debian's form, made from the manual's page changes.md, and a file on the licence.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/program/usr/share)
set(doc ${root}/doc/careen)

file(WRITE ${doc}/copyright
     "careen ${CPACK_PACKAGE_VERSION}\n\nNo licence has been given yet: all rights are with the owner of the project.\n"
     "Copyright 2026 the owner of careen\n")

# "## 0.1.0, 2026-11-23" begins an entry and "- " an item; lines that follow an item go on with it.
file(STRINGS ${CPACK_SOURCE_CHANGES} lines ENCODING UTF-8)
set(log "")
set(signature "")
foreach(line IN LISTS lines)
  if(line MATCHES "^## ([0-9.]+), ([0-9-]+)$")
    execute_process(COMMAND date --utc --rfc-email --date ${CMAKE_MATCH_2} OUTPUT_VARIABLE date
                    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    string(APPEND log "${signature}careen (${CMAKE_MATCH_1}) unstable; urgency=medium\n\n")
    set(signature "\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n\n")
  elseif(line MATCHES "^- (.*)$")
    string(APPEND log "  * ${CMAKE_MATCH_1}\n")
  elseif(line MATCHES "^  (.*)$")
    string(APPEND log "    ${CMAKE_MATCH_1}\n")
  endif()
endforeach()
if(NOT log MATCHES "^careen \\(${CPACK_PACKAGE_VERSION}\\)")
  message(FATAL_ERROR "changes.md: expected ${CPACK_PACKAGE_VERSION}, the project's version, first")
endif()
file(WRITE ${doc}/changelog "${log}${signature}")
execute_process(COMMAND gzip --best --no-name --force ${doc}/changelog ${root}/man/man1/careen.1
                COMMAND_ERROR_IS_FATAL ANY)
