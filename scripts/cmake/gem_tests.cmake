# Every *_test.cpp is found by name: those beside the code carry the label `unit`, those in validation/ their folder's label.
find_package(GTest REQUIRED)
include(GoogleTest)

file(GLOB_RECURSE unit_tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/gem/*_test.cpp)
add_executable(gem_unit_tests ${unit_tests})
target_link_libraries(gem_unit_tests PRIVATE gem_command GTest::gtest_main nlohmann_json::nlohmann_json)
target_compile_definitions(gem_unit_tests PRIVATE GEM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
gtest_discover_tests(gem_unit_tests PROPERTIES LABELS unit DISCOVERY_TIMEOUT 60)
