# Run by cpack once all is in the folders of the packages: what Debian asks of them besides. That is a compressed man
# page, a change log in Debian's form, made from the manual's page changes.md, and a file on the licence.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()

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

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr)
  set(doc ${root}/share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  file(WRITE ${doc}/copyright
       "careen ${CPACK_PACKAGE_VERSION}\n\nNo licence has been given yet: all rights are with the owner of the project.\n"
       "Copyright 2026 the owner of careen\n")
  file(WRITE ${doc}/changelog "${log}${signature}")
  execute_process(COMMAND gzip --best --no-name --force ${doc}/changelog COMMAND_ERROR_IS_FATAL ANY)
  # Modules are where Python looks, and find the library where the system has it.
  file(GLOB_RECURSE modules ${root}/lib/python3*/careen.*.so)
  foreach(module IN LISTS modules)
    file(RPATH_REMOVE FILE ${module})
    get_filename_component(name ${module} NAME)
    file(MAKE_DIRECTORY ${root}/lib/python3/dist-packages)
    file(RENAME ${module} ${root}/lib/python3/dist-packages/${name})
    get_filename_component(folder ${module} DIRECTORY)
    get_filename_component(folder ${folder} DIRECTORY)
    file(REMOVE_RECURSE ${folder})
  endforeach()
endforeach()
# The manual is listed where the desktop looks for documents.
if(CPACK_COMPONENTS_ALL MATCHES documentation)
  set(html /usr/share/doc/careen-doc/html)
  file(WRITE ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/documentation/usr/share/doc-base/careen-doc.careen
       "Document: careen\nTitle: careen: films of rigid boxes\nAuthor: The owner of careen\n"
       "Abstract: How to simulate boxes that tumble and collide, film them and check the runs.\n"
       "Section: Science/Physics\n\nFormat: HTML\nIndex: ${html}/index.html\nFiles: ${html}/*.html\n")
endif()
# cpack's own scripts do what the trigger does already.
file(WRITE ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/library/usr/share/lintian/overrides/${CPACK_DEBIAN_LIBRARY_PACKAGE_NAME}
     "${CPACK_DEBIAN_LIBRARY_PACKAGE_NAME}: maintscript-calls-ldconfig\n")
execute_process(COMMAND gzip --best --no-name --force
                        ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/program/usr/share/man/man1/careen.1 COMMAND_ERROR_IS_FATAL ANY)
