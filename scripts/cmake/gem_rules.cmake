# Rule checks as tests: the order of includes, the place of libraries, the layout of the code.
add_test(NAME rules.includes COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_includes.sh)
add_test(NAME rules.includes_self_test COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_includes_test.sh)
add_test(NAME rules.format COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_format.sh)
add_test(NAME rules.links COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_links.sh)
set_tests_properties(rules.includes rules.includes_self_test rules.format rules.links PROPERTIES LABELS unit)
set_tests_properties(rules.format PROPERTIES SKIP_RETURN_CODE 77)
if(GEM_STATIC)
  add_test(NAME rules.portable COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_portable.sh $<TARGET_FILE:gem>)
  set_tests_properties(rules.portable PROPERTIES LABELS unit)
endif()
# Checks the doc comments of the public headers with the settings of the target `manual` (gem_manual.cmake).
if(DOXYGEN_FOUND)
  add_test(NAME rules.api_pages COMMAND Doxygen::doxygen ${PROJECT_BINARY_DIR}/Doxyfile.manual
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
else()
  add_test(NAME rules.api_pages COMMAND ${CMAKE_COMMAND} -E echo "skipped: doxygen is not installed (package doxygen)")
endif()
set_tests_properties(rules.api_pages PROPERTIES LABELS unit SKIP_REGULAR_EXPRESSION "^skipped:")
