# For Debian's emscripten: careen as WebAssembly, see app/web/build.
set(CMAKE_FIND_ROOT_PATH ${CAREEN_WEB_PREFIX})
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES CAREEN_WEB_PREFIX)
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(ENV{PKG_CONFIG_LIBDIR} ${CAREEN_WEB_PREFIX}/lib/pkgconfig)
include_directories(BEFORE SYSTEM ${CMAKE_CURRENT_LIST_DIR}/std)
# Exceptions of WebAssembly itself, which browsers have had since 2022. No -msimd128: what clang 14 makes of vectors then
# differs in last bits, as tests/web shows for tests/scenes/belts.json, and crowds are an eighth faster only.
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions")
