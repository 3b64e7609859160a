# `cpack` makes the Debian package from what `cmake --install` installs. Libraries that the program is linked with are
# found by dpkg-shlibdeps; what it loads or starts only when asked to is recommended.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME careen)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME careen)
set(CPACK_DEBIAN_PROGRAM_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGE_CONTACT "The owner of careen <careen@careen.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "films of rigid boxes that tumble and collide")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "careen simulates rigid boxes that tumble, collide, slide and stack, in
closed form where there is one and to a given tolerance elsewhere, and films
them frame by frame without a display. Every run says how fast and how wrong
it is. It also compares films and runs, audits runs of other programs, and
writes labels of every pixel.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS
    "libosmesa6 | libegl1, fonts-dejavu-core, ffmpeg, gnuplot-nox | gnuplot, libglfw3")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
    WORLD_EXECUTE)
# What Debian asks of a package besides: a compressed man page, a change log, the licence.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_files.cmake)
set(CPACK_SOURCE_CHANGES ${PROJECT_SOURCE_DIR}/assets/manual/changes.md)
include(CPack)
