# Fuzz targets of gem/fuzz. With GEM_FUZZ=ON (clang) libFuzzer drives them: scripts/fuzz. Without it a plain program runs the corpus
# and a fixed number of changed inputs. Both are the tests fuzz.*.
set(fuzzed_commands gem/command/info_command.cpp gem/command/verdict_output.cpp gem/command/case_choice.cpp gem/command/run/branch.cpp
  gem/command/time_option.cpp gem/command/command_line.cpp gem/command/sweep/sweep_settings.cpp
  gem/run/checkpoint/checkpoint_path.cpp)
foreach(source ${fuzzed_commands})  # so that a build without clang sees a file that was moved
  if(NOT EXISTS ${PROJECT_SOURCE_DIR}/${source})
    message(FATAL_ERROR "scripts/cmake/gem_fuzz.cmake: no ${source} (moved or renamed?)")
  endif()
endforeach()
if(GEM_FUZZ)
  # The readers and what they need. Engines are left out: they read no files, and clang does not know all of their vector code.
  gem_sources(reader_sources gem/base gem/geometry gem/events gem/field gem/scene gem/record gem/analysis gem/report)
  list(FILTER reader_sources EXCLUDE REGEX "/recorder\\.cpp$")
  add_library(gem_fuzz_readers STATIC ${reader_sources} ${fuzzed_commands})
  add_dependencies(gem_fuzz_readers gem_version)
  target_include_directories(gem_fuzz_readers PUBLIC ${PROJECT_BINARY_DIR}/generated)
  target_include_directories(gem_fuzz_readers SYSTEM PUBLIC ${RANDOM123_INCLUDE_DIR} PRIVATE ${TOMLPLUSPLUS_INCLUDE_DIR})
  target_link_libraries(gem_fuzz_readers PUBLIC gem_flags Threads::Threads
    PRIVATE CLI11::CLI11 nlohmann_json::nlohmann_json hdf5::hdf5 hdf5::hdf5_hl GSL::gsl GSL::gslcblas)
  gem_together(gem_fuzz_readers gem/field gem/scene gem/record gem/analysis gem/report gem/command)
else()
  add_library(gem_fuzz_readers INTERFACE)
  target_link_libraries(gem_fuzz_readers INTERFACE gem_command)
endif()
add_library(gem_fuzz_shared STATIC gem/fuzz/target.cpp gem/record/testing/described_file.cpp)
target_link_libraries(gem_fuzz_shared PUBLIC gem_fuzz_readers PRIVATE hdf5::hdf5 hdf5::hdf5_hl)
add_custom_target(gem_fuzz)  # all targets

# gem_fuzz_target(NAME RUNS): gem/fuzz/NAME_target.cpp as the program gem_fuzz_NAME. RUNS is chosen so that the test takes a few seconds.
function(gem_fuzz_target name runs)
  set(program gem_fuzz_${name})
  set(corpus ${PROJECT_SOURCE_DIR}/gem/fuzz/corpus/${name})
  add_executable(${program} gem/fuzz/${name}_target.cpp)
  target_link_libraries(${program} PRIVATE gem_fuzz_shared CLI11::CLI11)
  add_dependencies(gem_fuzz ${program})
  if(GEM_FUZZ)
    target_link_options(${program} PRIVATE -fsanitize=fuzzer)
    set(command ${program} -seed=1 -runs=${runs} -detect_leaks=0 -close_fd_mask=1 ${corpus})
  else()
    target_sources(${program} PRIVATE gem/fuzz/corpus_main.cpp)
    set(command ${program} ${corpus} ${runs})
  endif()
  add_test(NAME fuzz.${name} COMMAND ${command})
  set_tests_properties(fuzz.${name} PROPERTIES LABELS fuzz TIMEOUT 300)
endfunction()

gem_fuzz_target(case 10000)
gem_fuzz_target(sweep 10000)
gem_fuzz_target(csv 20000)
gem_fuzz_target(geojson 20000)
gem_fuzz_target(run_file 800)
gem_fuzz_target(summary 1500)
gem_fuzz_target(set 10000)

if(GEM_FUZZ)
  add_executable(gem_fuzz_dictionary gem/fuzz/dictionary.cpp)
  target_link_libraries(gem_fuzz_dictionary PRIVATE gem_fuzz_readers)
  add_dependencies(gem_fuzz gem_fuzz_dictionary)
endif()
