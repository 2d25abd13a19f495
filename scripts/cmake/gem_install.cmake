# cmake --install: component `program` (the program and its pages), component `development` (library, headers, find_package).
# All places are relative to the prefix, so that an installation may be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Debian has another package called gem, so documents lie under this name.
set(GEM_PACKAGE_NAME gem-pack-ice)
set(doc_folder ${CMAKE_INSTALL_DATAROOTDIR}/doc/${GEM_PACKAGE_NAME})

# The pages are made by the program from its help.
set(pages ${PROJECT_BINARY_DIR}/pages)
add_custom_command(OUTPUT ${pages}/gem.1.gz ${pages}/gem
  COMMAND ${CMAKE_COMMAND} -E make_directory ${pages}
  COMMAND sh -c "$<TARGET_FILE:gem> manual | gzip -9n >${pages}/gem.1.gz"
  COMMAND sh -c "$<TARGET_FILE:gem> completion >${pages}/gem"
  DEPENDS gem COMMENT "Making the manual page and the completion" VERBATIM)
add_custom_target(gem_pages ALL DEPENDS ${pages}/gem.1.gz ${pages}/gem)

# A shared library is found beside the program, wherever both are moved.
if(BUILD_SHARED_LIBS)
  set_target_properties(gem PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
endif()
install(TARGETS gem RUNTIME COMPONENT program)
install(FILES ${pages}/gem.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${pages}/gem DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions COMPONENT program)
install(DIRECTORY cases/ DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/gem/cases COMPONENT program)
install(DIRECTORY gem/manual/ DESTINATION ${doc_folder}/manual COMPONENT program
  FILES_MATCHING PATTERN *.md PATTERN examples EXCLUDE)
# The licence, and those of the header libraries that are compiled in.
install(FILES scripts/package/copyright DESTINATION ${doc_folder} COMPONENT program)
foreach(package IN ITEMS libcli11-dev libeigen3-dev librandom123-dev libtomlplusplus-dev nlohmann-json3-dev)
  if(EXISTS /usr/share/doc/${package}/copyright)
    install(FILES /usr/share/doc/${package}/copyright DESTINATION ${doc_folder}/third_party RENAME ${package}
      COMPONENT program)
  endif()
endforeach()
install(DIRECTORY gem/manual/examples/consumer DESTINATION ${doc_folder}/examples COMPONENT development)

# Public headers. Those that they include are installed beside them, but may change without notice.
set(GEM_PUBLIC_HEADERS
  gem/base/error.h                 # what every call may throw
  gem/scene/scene_def.h            # every setting
  gem/scene/toml/scene_file.h      # a case from a file
  gem/field/field.h                # its bodies
  gem/engine/engine.h              # engines, loads per time step
  gem/record/run_file/run_file.h)  # reads a run file

# gem_header_closure(OUT HEADER...): the headers and all of the tree that they include.
function(gem_header_closure out)
  set(waiting ${ARGN})
  set(found)
  while(waiting)
    list(POP_FRONT waiting header)
    if(NOT header IN_LIST found)
      list(APPEND found ${header})
      file(STRINGS ${header} lines REGEX "^#include \"gem/")
      string(REGEX MATCHALL "gem/[^\";]+" included "${lines}")
      list(APPEND waiting ${included})
    endif()
  endwhile()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# A static build links libraries that find_package cannot name; it is for the program.
if(NOT GEM_STATIC AND NOT GEM_SANITIZE)
  gem_header_closure(headers ${GEM_PUBLIC_HEADERS})
  foreach(header IN LISTS headers)
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder} COMPONENT development)
  endforeach()
  install(TARGETS gem_simulator gem_flags EXPORT gemTargets
    ARCHIVE COMPONENT development LIBRARY COMPONENT development)
  set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/gem)
  install(EXPORT gemTargets NAMESPACE gem:: DESTINATION ${config_folder} COMPONENT development)
  configure_package_config_file(scripts/cmake/gemConfig.cmake.in ${PROJECT_BINARY_DIR}/gemConfig.cmake
    INSTALL_DESTINATION ${config_folder})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/gemConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/gemConfig.cmake ${PROJECT_BINARY_DIR}/gemConfigVersion.cmake
    DESTINATION ${config_folder} COMPONENT development)
endif()

include(gem_package)
