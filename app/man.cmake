# Writes OUTPUT, the man page of PROGRAM (version VERSION), from what it and its commands print with --help.
function(roff text variable)
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  string(REPLACE "'" "\\(aq" text "${text}")
  string(REGEX REPLACE "(^|\n)\\." "\\1\\\\&." text "${text}")
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

function(help_of variable)
  execute_process(COMMAND ${PROGRAM} ${ARGN} --help OUTPUT_VARIABLE text RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    file(REMOVE ${OUTPUT})
    message(FATAL_ERROR "${PROGRAM} ${ARGN} --help: exit code ${code}")
  endif()
  string(STRIP "${text}" text)
  roff("${text}" text)
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

help_of(all)
set(page ".TH CAREEN 1 \"\" \"careen ${VERSION}\" \"User Commands\"
.SH NAME
careen \\- films rigid boxes that tumble and collide with walls
.SH SYNOPSIS
.B careen
.I COMMAND
.RI [ OPTION ...]
.SH DESCRIPTION
.nf
${all}
.fi
.SH COMMANDS
")
# Each line of the list of commands begins with two blanks and its name.
string(REGEX REPLACE ".*\nSubcommands:\n" "" list "${all}")
string(REGEX MATCHALL "(^|\n)  [a-z]+" names "${list}")
foreach(name IN LISTS names)
  string(STRIP "${name}" name)
  help_of(text ${name})
  string(APPEND page ".SS ${name}\n.nf\n${text}\n.fi\n")
endforeach()
string(APPEND page ".SH SEE ALSO\nThe manual: careen help, or the folder doc/careen of the installation.\n")
file(WRITE ${OUTPUT} "${page}")
