# For Debian's emscripten: careen as WebAssembly, see app/web/build.
set(CMAKE_FIND_ROOT_PATH ${CAREEN_WEB_PREFIX})
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES CAREEN_WEB_PREFIX)
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(ENV{PKG_CONFIG_LIBDIR} ${CAREEN_WEB_PREFIX}/lib/pkgconfig)
include_directories(BEFORE SYSTEM ${CMAKE_CURRENT_LIST_DIR}/std)
# Exceptions and vectors of WebAssembly itself: Chromium 95, Firefox 100 and Safari 16.4 have both.
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -msimd128")
