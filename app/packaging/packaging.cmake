# `cpack` makes Debian packages from what `cmake --install` installs: the program, the library, what programs that use
# it are built with, and the module for Python where it is built. Libraries that they are linked with are found by
# dpkg-shlibdeps; what is loaded or started only when asked to is recommended.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME careen)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The owner of careen <careen@careen.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
    WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/engine/library)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(drawing "libosmesa6 | libegl1, fonts-dejavu-core")

# careen_package(COMPONENT NAME SECTION SUMMARY TEXT…): the Debian package NAME of what is installed of COMPONENT.
set(CPACK_COMPONENTS_ALL "")
function(careen_package component name section summary)
  string(TOUPPER ${component} upper)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_FILE_NAME DEB-DEFAULT PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  string(JOIN "" text ${ARGN})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${text}" PARENT_SCOPE)
endfunction()

careen_package(program careen science "films of rigid boxes that tumble and collide"
    "careen simulates rigid boxes that tumble, collide, slide and stack, in
closed form where there is one and to a given tolerance elsewhere, and films
them frame by frame without a display. Every run says how fast and how wrong
it is. It also compares films and runs, audits runs of other programs, and
writes labels of every pixel.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "${drawing}, ffmpeg, gnuplot-nox | gnuplot, libglfw3")

careen_package(library libcareen${PROJECT_VERSION_MAJOR} libs "rigid boxes that tumble and collide - library"
    "careen simulates rigid boxes that tumble, collide, slide and stack, and
draws pictures of them without a display. This is the library that programs
built with libcareen-dev, and the module for Python, run with.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS ${drawing})
file(WRITE ${PROJECT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/triggers)

careen_package(development libcareen-dev libdevel "rigid boxes that tumble and collide - development files"
    "careen simulates rigid boxes that tumble, collide, slide and stack, and
draws pictures of them without a display. This is its header for C++20, and
what find_package of CMake needs to find it.")
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS library)

if(CAREEN_PYTHON)
  careen_package(python python3-careen python "rigid boxes that tumble and collide - module for Python"
      "careen simulates rigid boxes that tumble, collide, slide and stack, and
draws pictures of them without a display. This module gives states, impacts
and pictures as arrays of NumPy.")
  set(CPACK_COMPONENT_PYTHON_DEPENDS library)
  # The module is compiled for one version of Python.
  math(EXPR next "${CAREEN_PYTHON_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${CAREEN_PYTHON_MINOR}), python3 (<< 3.${next}), python3-numpy")
endif()

if(CAREEN_CMARK)
  careen_package(documentation careen-doc doc "rigid boxes that tumble and collide - manual"
      "careen simulates rigid boxes that tumble, collide, slide and stack, and
films them frame by frame without a display. This is its manual as HTML, with
its pictures.")
  set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SHLIBDEPS OFF)
endif()

# What Debian asks of a package besides: a compressed man page, a change log, the licence.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_files.cmake)
set(CPACK_SOURCE_CHANGES ${PROJECT_SOURCE_DIR}/assets/manual/changes.md)
include(CPack)
