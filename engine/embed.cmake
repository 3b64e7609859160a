# Writes OUTPUT, a C++ file with the text of every one of FILES, and FUNCTION, which returns it by the file's name and
# is declared in HEADER.
set(entries "")
foreach(path IN LISTS FILES)
  get_filename_component(name ${path} NAME)
  file(READ ${path} text)
  string(FIND "${text}" ")careen\"" end)
  if(NOT end EQUAL -1)
    message(FATAL_ERROR "${path}: found )careen\", which would end its literal")
  endif()
  string(APPEND entries "  if (name == \"${name}\") {\n    return R\"careen(${text})careen\";\n  }\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"${HEADER}\"

namespace careen {

std::string_view ${FUNCTION}(std::string_view name) {
${entries}  return {};
}

}  // namespace careen
")
