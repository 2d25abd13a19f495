# Every bench/*_bench.cpp goes into one program.
find_package(benchmark REQUIRED)

file(GLOB benchmarks CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/bench/*_bench.cpp)
if(benchmarks)
  add_executable(gem_bench ${benchmarks})
  target_link_libraries(gem_bench PRIVATE gem_command benchmark::benchmark_main nlohmann_json::nlohmann_json)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
  string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} -ffp-contract=off" bench_flags)
  target_compile_definitions(gem_bench PRIVATE GEM_SOURCE_DIR="${PROJECT_SOURCE_DIR}" GEM_BENCH_FLAGS="${bench_flags}")
  if(GEM_TESTS)
    # A short run of the cheapest phase, so that the benchmarks keep building and their own checks keep holding; a
    # benchmark that reports an error still exits with 0.
    add_test(NAME bench.smoke COMMAND gem_bench "--benchmark_filter=^(moment|stage)/drift/")
    set_tests_properties(bench.smoke PROPERTIES LABELS unit FAIL_REGULAR_EXPRESSION "ERROR OCCURRED"
      PASS_REGULAR_EXPRESSION "moment/drift/independent/threads:2.*stage/drift/drift")
  endif()
endif()

add_executable(speed_against_error bench/speed_against_error.cpp bench/setting.cpp bench/overlaps.cpp)
target_link_libraries(speed_against_error PRIVATE gem_command gem_baseline CLI11::CLI11)

# Repeated runs with sums without a fixed order: validation/paper/README.md.
add_executable(unordered_sums ${PROJECT_SOURCE_DIR}/validation/paper/experiments/unordered_sums.cpp
  ${PROJECT_SOURCE_DIR}/validation/paper/experiments/unordered_engine.cpp)
target_link_libraries(unordered_sums PRIVATE gem_analysis)

# Divergence of the ice of two runs in which one floe is shifted: the same page.
add_executable(ice_distances ${PROJECT_SOURCE_DIR}/validation/paper/experiments/ice_distances.cpp)
target_link_libraries(ice_distances PRIVATE gem_simulator)

# The error in time of each law: validation/time_step_study.md.
add_executable(law_study EXCLUDE_FROM_ALL bench/law_study.cpp)
target_link_libraries(law_study PRIVATE gem_simulator)

# How much loads depend on a setting: bench/results.
add_executable(load_ensemble EXCLUDE_FROM_ALL bench/load_ensemble.cpp)
target_link_libraries(load_ensemble PRIVATE gem_simulator)
