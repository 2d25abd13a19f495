# The Debian package, with the program only: cpack --config BUILD/CPackConfig.cmake -G DEB, checked by scripts/check_package.sh.
set(GEM_MAINTAINER "The gem developers <noreply@gem.invalid>" CACHE STRING "who publishes the package: NAME <MAIL>")
set(CPACK_PACKAGE_NAME ${GEM_PACKAGE_NAME})
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_VENDOR "The gem developers")
set(CPACK_PACKAGE_CONTACT "${GEM_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_COMPONENTS_ALL program package)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS gnuplot-nox)  # the figures of `gem report`
set(CPACK_DEBIAN_PACKAGE_CONFLICTS ruby-rubygems)  # has a program of the same name
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "loads of drifting pack ice on moored platforms
Thousands of convex floes drift, collide and crush against each other and
against a moored platform. Every contact is an event with a closed-form law.
A case is one text file, a run is one HDF5 file, and the same case gives the
same bits with any number of threads.

The program runs cases and sweeps, and writes reports with figures.")

# Files that only a package has: the changelogs.
set(folder ${PROJECT_BINARY_DIR}/package)
find_program(GZIP_PROGRAM gzip)
execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} log -1 --format=%aD OUTPUT_VARIABLE date
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(date "Thu, 01 Jan 1970 00:00:00 +0000")
endif()
file(WRITE ${folder}/changelog.Debian "${GEM_PACKAGE_NAME} (${PROJECT_VERSION}-1) unstable; urgency=medium

  * Version ${PROJECT_VERSION}. What changed is in changelog.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
configure_file(CHANGELOG.md ${folder}/changelog COPYONLY)
if(GZIP_PROGRAM)
  foreach(name IN ITEMS changelog changelog.Debian)
    execute_process(COMMAND ${GZIP_PROGRAM} -9nf ${folder}/${name})
    install(FILES ${folder}/${name}.gz DESTINATION ${doc_folder} COMPONENT package EXCLUDE_FROM_ALL)
  endforeach()
endif()
include(CPack)
