# Every bench/*_bench.cpp goes into one program.
find_package(benchmark REQUIRED)

file(GLOB benchmarks CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/bench/*_bench.cpp)
if(benchmarks)
  add_executable(gem_bench ${benchmarks})
  target_link_libraries(gem_bench PRIVATE gem_command benchmark::benchmark_main nlohmann_json::nlohmann_json)
  target_compile_definitions(gem_bench PRIVATE GEM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
endif()
