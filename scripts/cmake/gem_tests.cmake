# Every *_test.cpp is found by name. Tests beside the code get the label `unit`, tests in validation/ the label of their folder.
find_package(GTest REQUIRED)
include(GoogleTest)
include(gem_rules)

# Programs that run on another machine need "." here: they find cases/ in the folder where they are called.
set(GEM_TEST_ROOT ${PROJECT_SOURCE_DIR} CACHE STRING "where tests find the tree with cases/ and validation/")

# gem_test_program(NAME LABEL SOURCES...): one executable of tests with the label LABEL. The files of a folder compile together, as in
# gem_cold. Tests whose name starts with Long get the label `long` instead. NO_PRETTY_VALUES: the name of a parameterised test ends in
# what its name generator returns, without the printed parameter behind it.
function(gem_test_program name label)
  add_executable(${name} ${ARGN})
  set(folders)
  foreach(source IN LISTS ARGN)
    cmake_path(GET source PARENT_PATH folder)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
    if(NOT folder MATCHES "^gem/engine/")
      string(REGEX REPLACE "^(gem/[^/]+)/.*" "\\1" folder ${folder})
    endif()
    list(APPEND folders ${folder})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  gem_cold(${name} ${folders})
  target_link_libraries(${name} PRIVATE gem_command gem_baseline GTest::gtest_main nlohmann_json::nlohmann_json)
  target_compile_definitions(${name} PRIVATE GEM_SOURCE_DIR="${GEM_TEST_ROOT}"
    GEM_PROGRAM="$<TARGET_FILE:gem>")
  add_dependencies(${name} gem)
  gtest_discover_tests(${name} TEST_FILTER "-Long*:*/Long*" NO_PRETTY_VALUES PROPERTIES LABELS ${label} DISCOVERY_TIMEOUT 60)
  gtest_discover_tests(${name} TEST_FILTER "Long*:*/Long*" NO_PRETTY_VALUES PROPERTIES LABELS long TIMEOUT 14400 DISCOVERY_TIMEOUT 60)
endfunction()

# These files define names without linkage that other files of their folder also define.
foreach(file IN ITEMS verification/platform_test verification/crushing_test verification/row_test hard/contact_residuals
    contact/crush_test contact/miss_test contact/rest_test contact/switch_test)
  set_source_files_properties(${PROJECT_SOURCE_DIR}/validation/${file}.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endforeach()

file(GLOB_RECURSE unit_tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/gem/*_test.cpp)
# The manual's examples need their patch: scripts/check_example_law.sh compiles them.
list(FILTER unit_tests EXCLUDE REGEX "/gem/manual/")
gem_test_program(gem_unit_tests unit ${unit_tests})
target_link_libraries(gem_unit_tests PRIVATE hdf5::hdf5 hdf5::hdf5_hl  # the tests of gem/record read what was written
  Eigen3::Eigen)  # and those of the reference engine's solver set up its problems

if(TARGET box2d::box2d)
  file(GLOB baseline_tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/baseline_box2d/*_test.cpp)
  list(APPEND baseline_tests ${PROJECT_SOURCE_DIR}/validation/baseline/ensembles_test.cpp ${ensemble_parts})
  gem_test_program(gem_baseline_tests unit ${baseline_tests})
endif()

# The judge of the paper, and the engine of the repeats whose rows it reads.
file(GLOB_RECURSE paper_tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/validation/paper/*_test.cpp)
gem_test_program(gem_paper_tests unit ${paper_tests}
  ${PROJECT_SOURCE_DIR}/validation/paper/experiments/unordered_engine.cpp)
target_link_libraries(gem_paper_tests PRIVATE gem_paper_judge)
target_compile_definitions(gem_paper_tests PRIVATE GEM_PAPER_PROGRAM="$<TARGET_FILE:gem_paper>")
add_dependencies(gem_paper_tests gem_paper)

# Clipper checks the overlap of outlines. Without it that test is skipped with the reason.
find_path(POLYCLIPPING_INCLUDE_DIR polyclipping/clipper.hpp)
find_library(POLYCLIPPING_LIBRARY polyclipping)
if(POLYCLIPPING_INCLUDE_DIR AND POLYCLIPPING_LIBRARY)
  target_include_directories(gem_unit_tests SYSTEM PRIVATE ${POLYCLIPPING_INCLUDE_DIR})
  target_compile_definitions(gem_unit_tests PRIVATE GEM_HAS_CLIPPER)
  target_link_libraries(gem_unit_tests PRIVATE ${POLYCLIPPING_LIBRARY})
endif()

# Shared parts of the closed-form cases (settings, checks, rows of results), also used by the hard cases.
file(GLOB shared_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/validation/verification/*.cpp)
list(FILTER shared_sources EXCLUDE REGEX "_test\\.cpp$")

add_custom_target(gem_validation_tests)
foreach(pair IN ITEMS verification:verify agreement:agree hard:hard contact:contact regression:regression)
  string(REPLACE ":" ";" pair ${pair})
  list(POP_FRONT pair folder label)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/validation/${folder}/*.cpp)
  if(sources AND folder STREQUAL hard)
    list(APPEND sources ${shared_sources})
  endif()
  if(sources)
    gem_test_program(gem_${folder}_tests ${label} ${sources})
    add_dependencies(gem_validation_tests gem_${folder}_tests)
  endif()
endforeach()

# The runs of the regression table are tests with their own names, so a changed list must be discovered again.
set_target_properties(gem_regression_tests PROPERTIES LINK_DEPENDS ${PROJECT_SOURCE_DIR}/validation/regression/runs.txt)

# Programs that print tables for the comparison with a baseline; they judge nothing.
file(GLOB verification_parts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/validation/verification/*.cpp)
list(FILTER verification_parts EXCLUDE REGEX "_test\\.cpp$")
add_executable(gem_sustained_survey ${PROJECT_SOURCE_DIR}/validation/baseline/sustained_survey.cpp ${verification_parts})
target_link_libraries(gem_sustained_survey PRIVATE gem_command gem_baseline GTest::gtest)
target_compile_definitions(gem_sustained_survey PRIVATE GEM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")

# The manual's key reference must equal the output of the program.
add_test(NAME rules.keys COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_keys.sh $<TARGET_FILE:gem>)
set_tests_properties(rules.keys PROPERTIES LABELS unit)
# The numbers of the user guide's example must be those of the program.
if(GEM_SANITIZE)
  add_test(NAME manual.guide_numbers COMMAND sh -c "echo skipped: a build with sanitizers is too slow for it; exit 77")
else()
  add_test(NAME manual.guide_numbers COMMAND python3 ${PROJECT_SOURCE_DIR}/scripts/studies guide_numbers $<TARGET_FILE:gem> --check)
endif()
set_tests_properties(manual.guide_numbers PROPERTIES LABELS unit PROCESSORS 2 SKIP_RETURN_CODE 77 TIMEOUT 300)
# The page of the paper's converged runs must hold what their summaries say.
if(GEM_SANITIZE)
  add_test(NAME manual.converged_page COMMAND sh -c "echo skipped: a build with sanitizers is too slow for it; exit 77")
else()
  add_test(NAME manual.converged_page COMMAND python3 ${PROJECT_SOURCE_DIR}/scripts/studies converged $<TARGET_FILE:gem_paper> --check)
endif()
set_tests_properties(manual.converged_page PROPERTIES LABELS unit SKIP_RETURN_CODE 77 TIMEOUT 300)

# The manual's example of a new law: in a copy of the tree, with its patch, against closed form and against this program.
add_test(NAME manual.slope_example COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_example_law.sh $<TARGET_FILE:gem>
  ${PROJECT_BINARY_DIR}/slope_example ${PROJECT_SOURCE_DIR}/gem/manual/examples/slope)
set_tests_properties(manual.slope_example PROPERTIES LABELS unit PROCESSORS 2 TIMEOUT 600
  ENVIRONMENT "CXX=${CMAKE_CXX_COMPILER}")

# An installation, and the Debian package.
add_test(NAME install.moved COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_install.sh ${PROJECT_BINARY_DIR} ${CMAKE_COMMAND}
  ${CMAKE_CXX_COMPILER})
add_test(NAME install.package COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_package.sh ${PROJECT_BINARY_DIR} ${CMAKE_CPACK_COMMAND})
set_tests_properties(install.moved install.package PROPERTIES LABELS unit SKIP_RETURN_CODE 77 TIMEOUT 300)

# A run file, and the summary of a sweep, read the way their users read them; skipped with the reason without the readers.
find_program(GEM_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)  # the distribution's, which has the readers of its packages
function(gem_reader_test name what case)
  if(GEM_PYTHON)
    add_test(NAME ${name} COMMAND ${GEM_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/check_files.py ${what} $<TARGET_FILE:gem>
      ${PROJECT_SOURCE_DIR}/cases/${case}.toml)
  else()
    add_test(NAME ${name} COMMAND sh -c "echo skipped: no /usr/bin/python3; exit 77")
  endif()
  set_tests_properties(${name} PROPERTIES LABELS unit SKIP_RETURN_CODE 77)
endfunction()
gem_reader_test(run_file_readers run analytic/V10_floe_on_moored_platform)
gem_reader_test(sweep_summary_readers summary small_sweep)

# gem view from outside: its server, and its page in Chromium, where there is one.
foreach(what IN ITEMS server browser)
  if(GEM_PYTHON AND TARGET PkgConfig::HTTPLIB)
    add_test(NAME view_${what} COMMAND ${GEM_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/check_view.py ${what} $<TARGET_FILE:gem>
      ${PROJECT_SOURCE_DIR}/cases)
  else()
    add_test(NAME view_${what} COMMAND sh -c "echo skipped: no /usr/bin/python3 or no libcpp-httplib-dev; exit 77")
  endif()
  set_tests_properties(view_${what} PROPERTIES LABELS unit SKIP_RETURN_CODE 77 TIMEOUT 300)
endforeach()
# Exports read by VTK, run files by Octave, the trend of a ship's resistance, the Python package and its examples; each is skipped with the reason without them.
function(gem_python_test name script timeout)
  if(GEM_PYTHON)
    add_test(NAME ${name} COMMAND ${GEM_PYTHON} ${PROJECT_SOURCE_DIR}/${script} ${ARGN})
  else()
    add_test(NAME ${name} COMMAND sh -c "echo skipped: no /usr/bin/python3; exit 77")
  endif()
  set_tests_properties(${name} PROPERTIES LABELS unit SKIP_RETURN_CODE 77 TIMEOUT ${timeout} ENVIRONMENT
    "PYTHONPATH=${PROJECT_SOURCE_DIR}/gem/python;PYTHONDONTWRITEBYTECODE=1;GEM_PROGRAM=$<TARGET_FILE:gem>")
endfunction()
gem_python_test(export_readers scripts/check_export.py 120 $<TARGET_FILE:gem> ${PROJECT_SOURCE_DIR}/cases/first.toml)
gem_python_test(resistance_trend scripts/studies 300 resistance --check $<TARGET_FILE:gem>)
gem_python_test(octave_reader scripts/check_octave.py 120 $<TARGET_FILE:gem> ${PROJECT_SOURCE_DIR}/cases/first.toml)
gem_python_test(python_package gem/python/tests 300)

# Failing system calls, kills, full disks, several processes: a few of each as a test, the whole round with the label `long`; .ci/run
# calls the short one.
add_library(gem_fail_nth SHARED ${PROJECT_SOURCE_DIR}/scripts/faults/fail_nth.c)
target_link_libraries(gem_fail_nth PRIVATE ${CMAKE_DL_LIBS})
function(gem_faults_test name label timeout)
  if(GEM_PYTHON AND NOT GEM_SANITIZE)
    add_test(NAME ${name} COMMAND ${GEM_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/faults/faults.py $<TARGET_FILE:gem>
      $<TARGET_FILE:gem_fail_nth> ${ARGN})
  else()
    add_test(NAME ${name} COMMAND sh -c "echo skipped: no /usr/bin/python3, or a build with sanitizers; exit 77")
  endif()
  set_tests_properties(${name} PROPERTIES LABELS ${label} SKIP_RETURN_CODE 77 TIMEOUT ${timeout} PROCESSORS 2)
endfunction()
gem_faults_test(faults unit 300 --few)
gem_faults_test(faults_long long 7200)

# Runs that are killed at random moments and go on to the same bits.
if(GEM_PYTHON AND NOT GEM_SANITIZE)
  add_test(NAME continue_kills COMMAND ${GEM_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/check_continue.py $<TARGET_FILE:gem>
    ${PROJECT_SOURCE_DIR}/cases/004_400_25.toml --kills 20 -- --set run.duration_s=300)
  set_tests_properties(continue_kills PROPERTIES LABELS long SKIP_RETURN_CODE 77 TIMEOUT 1800)
endif()
