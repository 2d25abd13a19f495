# Programs for measurements on another, quiet machine: they need neither a benchmark library nor Python. `cmake --build BUILD
# --target gem_measurements` builds them; scripts/pack_measurements.sh packs them.
add_custom_target(gem_measurements)

function(gem_measurement name)
  add_executable(${name} EXCLUDE_FROM_ALL ${ARGN})
  target_link_libraries(${name} PRIVATE gem_command gem_baseline CLI11::CLI11)
  add_dependencies(gem_measurements ${name})
endfunction()

set(ensemble_parts ensemble_plan.cpp ensemble_rows.cpp ensemble_compare.cpp platform_events.cpp)
list(TRANSFORM ensemble_parts PREPEND ${PROJECT_SOURCE_DIR}/validation/baseline/)
gem_measurement(gem_ensembles ${PROJECT_SOURCE_DIR}/validation/baseline/ensembles.cpp ${ensemble_parts})
add_dependencies(gem_measurements gem)

foreach(program IN ITEMS window_errors paired_speed closed_form_errors)
  gem_measurement(${program} ${PROJECT_SOURCE_DIR}/bench/${program}.cpp ${PROJECT_SOURCE_DIR}/bench/setting.cpp
    ${PROJECT_SOURCE_DIR}/bench/overlaps.cpp)
endforeach()

# numerics.iteration in windows of jams: bench/notebook.md, "Operator splitting".
gem_measurement(splitting_study ${PROJECT_SOURCE_DIR}/bench/splitting_study.cpp ${PROJECT_SOURCE_DIR}/bench/setting.cpp)
# Hits on the platform, with and without a release: bench/notebook.md, "Hits".
gem_measurement(hit_study ${PROJECT_SOURCE_DIR}/bench/hit_study.cpp ${PROJECT_SOURCE_DIR}/bench/setting.cpp)
