# Writes OUTPUT, a C++ file that holds the text of every one of SHADERS.
set(entries "")
foreach(shader IN LISTS SHADERS)
  get_filename_component(name ${shader} NAME)
  file(READ ${shader} text)
  string(APPEND entries "  if (name == \"${name}\") {\n    return R\"glsl(${text})glsl\";\n  }\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"render/gl/shader.h\"

namespace careen {

std::string_view embeddedShader(std::string_view name) {
${entries}  return {};
}

}  // namespace careen
")
