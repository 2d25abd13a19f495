# The rules of the tree as tests: who may include whom, which library stays where, how the code is laid out.
add_test(NAME rules.includes COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_includes.sh)
add_test(NAME rules.includes_self_test COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_includes_test.sh)
add_test(NAME rules.format COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_format.sh)
set_tests_properties(rules.includes rules.includes_self_test rules.format PROPERTIES LABELS unit)
set_tests_properties(rules.format PROPERTIES SKIP_RETURN_CODE 77)
