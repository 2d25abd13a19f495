# One library per licence and audience: the simulator without GSL, the analysis with GSL, and the program.

# Same bits on every machine: a*b+c must not be contracted to a fused operation. g++ 12 fuses alternating sums in spite of this
# flag if the instruction set has fused multiply-add. So -march with avx2 also needs -mno-fma.
add_library(gem_flags INTERFACE)
# Programs on an installed gem need the flag too: they compile functions of its headers again, and the linker keeps either.
target_compile_options(gem_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>
  $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wshadow;-Wconversion;-Wno-sign-conversion$<$<BOOL:${GEM_WERROR}>:;-Werror>>>)
# g++ 12 warns about its own std::string at -O3 in "text" + string.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(gem_flags INTERFACE $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict>>)
endif()
target_compile_features(gem_flags INTERFACE $<INSTALL_INTERFACE:cxx_std_20>)
target_include_directories(gem_flags INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include>)
if(GEM_STATIC)
  target_link_options(gem_flags INTERFACE -static-libstdc++ -static-libgcc)
endif()
if(GEM_SANITIZE)
  target_compile_options(gem_flags INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-fsanitize=${GEM_SANITIZE} -fno-sanitize-recover=undefined -fno-omit-frame-pointer>)
  target_link_options(gem_flags INTERFACE -fsanitize=${GEM_SANITIZE})
endif()

function(gem_sources out)
  set(found)
  foreach(folder IN LISTS ARGN)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
    list(APPEND found ${files})
  endforeach()
  list(FILTER found EXCLUDE REGEX "_(test|bench)\\.cpp$|/record/testing/")
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# gem_cold(TARGET FOLDER...): code that runs once per run or output. It gets light optimisation, which no result depends on, and
# the files of each folder are one translation unit, so that heavy headers (command line, JSON, TOML) are read once. Names
# without linkage must therefore differ within a folder. GEM_UNITY=OFF compiles each file alone.
function(gem_cold target)
  target_compile_options(${target} PRIVATE $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CONFIG:Release>>:-O1>)
  gem_together(${target} ${ARGN})
endfunction()

# gem_together(TARGET FOLDER...): the files of each folder as one translation unit, without a change of optimisation.
function(gem_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${GEM_UNITY} UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(folder IN LISTS ARGN)
    set(files ${sources})
    list(FILTER files INCLUDE REGEX "^${PROJECT_SOURCE_DIR}/${folder}/")
    string(REPLACE "/" "_" group ${folder})
    set_source_files_properties(${files} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# The commit is read at build time, so that a run file never names an older one.
add_custom_target(gem_version
  COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DOUTPUT=${PROJECT_BINARY_DIR}/generated/gem_version.h
    -DVERSION=${PROJECT_VERSION} -DBUILD_TYPE=${CMAKE_BUILD_TYPE}
    "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
    "-DLIBRARIES=${GEM_LIBRARIES}" -DHAS_CUDA=$<IF:$<BOOL:${GEM_HAS_CUDA}>,true,false>
    -P ${PROJECT_SOURCE_DIR}/scripts/cmake/gem_version.cmake
  BYPRODUCTS ${PROJECT_BINARY_DIR}/generated/gem_version.h COMMENT "Reading the version of the tree" VERBATIM)

gem_sources(simulator_sources gem/base gem/geometry gem/events gem/field gem/engine)
if(GEM_HAS_CUDA)
  list(FILTER simulator_sources EXCLUDE REGEX "cuda_missing\\.cpp$")
  file(GLOB cuda_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/gem/engine/cuda/*.cu)
  list(APPEND simulator_sources ${cuda_sources})
  # As on the host: a*b+c is never contracted.
  set_source_files_properties(${cuda_sources} PROPERTIES COMPILE_OPTIONS
    "--fmad=false;-Xcompiler=-ffp-contract=off")
else()
  set(no_cuda_because "no CUDA compiler was found when it was configured")
  if(GEM_CUDA STREQUAL OFF)
    set(no_cuda_because "it was configured with GEM_CUDA=OFF")
  endif()
  set_source_files_properties(${PROJECT_SOURCE_DIR}/gem/engine/cuda/cuda_missing.cpp PROPERTIES COMPILE_DEFINITIONS
    "GEM_NO_CUDA_BECAUSE=\"${no_cuda_because}\"")
endif()
# The compiler warns about passing vectors of numbers although every function on them is inlined. The pragma in the header does
# not reach warnings at the end of the file.
set_source_files_properties(${PROJECT_SOURCE_DIR}/gem/engine/solver/coupled_rounds.cpp PROPERTIES COMPILE_OPTIONS -Wno-psabi)
# A false warning of g++ 12: each use is under the condition under which the value was set.
set_source_files_properties(${PROJECT_SOURCE_DIR}/gem/engine/device/resident_steps_test.cpp PROPERTIES COMPILE_OPTIONS
  -Wno-uninitialized)
# Scenes and records are parts of the simulator with compile flags of their own.
gem_sources(scene_and_record_sources gem/scene gem/record)
add_library(gem_scene_and_record OBJECT ${scene_and_record_sources})
add_dependencies(gem_scene_and_record gem_version)
target_include_directories(gem_scene_and_record PRIVATE ${PROJECT_BINARY_DIR}/generated)
target_include_directories(gem_scene_and_record SYSTEM PRIVATE ${TOMLPLUSPLUS_INCLUDE_DIR})
target_link_libraries(gem_scene_and_record PRIVATE gem_flags nlohmann_json::nlohmann_json hdf5::hdf5 hdf5::hdf5_hl)
gem_cold(gem_scene_and_record gem/scene gem/record)

# A static library, or a shared one with -DBUILD_SHARED_LIBS=ON.
add_library(gem_simulator ${simulator_sources} $<TARGET_OBJECTS:gem_scene_and_record>)
set_target_properties(gem_simulator gem_scene_and_record PROPERTIES POSITION_INDEPENDENT_CODE ${BUILD_SHARED_LIBS})
set_target_properties(gem_simulator PROPERTIES VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
add_dependencies(gem_simulator gem_version)
target_include_directories(gem_simulator PUBLIC $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>)
target_include_directories(gem_simulator SYSTEM PUBLIC $<BUILD_INTERFACE:${RANDOM123_INCLUDE_DIR}>)
target_link_libraries(gem_simulator PUBLIC gem_flags Threads::Threads PRIVATE $<BUILD_INTERFACE:Eigen3::Eigen>
  $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> hdf5::hdf5 hdf5::hdf5_hl)
gem_together(gem_simulator gem/field)

gem_sources(report_sources gem/report gem/export gem/film)
add_library(gem_report OBJECT ${report_sources})
target_link_libraries(gem_report PRIVATE gem_simulator nlohmann_json::nlohmann_json GSL::gsl)
gem_cold(gem_report gem/report gem/export gem/film)
# every pixel of a film passes here
set_source_files_properties(${PROJECT_SOURCE_DIR}/gem/film/canvas.cpp PROPERTIES COMPILE_OPTIONS -O2 SKIP_UNITY_BUILD_INCLUSION ON)

gem_sources(analysis_sources gem/analysis)
add_library(gem_analysis STATIC ${analysis_sources} $<TARGET_OBJECTS:gem_report>)
target_link_libraries(gem_analysis PUBLIC gem_simulator PRIVATE GSL::gsl GSL::gslcblas nlohmann_json::nlohmann_json)
gem_together(gem_analysis gem/analysis)

# The page of gem view, embedded in the program, and what packs a run for it.
file(GLOB_RECURSE page_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/gem/view/page/*)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/generated/gem_page.cpp
  COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR}/gem/view/page
    -DOUTPUT=${PROJECT_BINARY_DIR}/generated/gem_page.cpp -P ${PROJECT_SOURCE_DIR}/scripts/cmake/gem_page.cmake
  DEPENDS ${page_files} ${PROJECT_SOURCE_DIR}/scripts/cmake/gem_page.cmake VERBATIM)
gem_sources(view_sources gem/view)
if(TARGET PkgConfig::HTTPLIB)
  list(FILTER view_sources EXCLUDE REGEX "/without_server\\.cpp$")
else()
  list(FILTER view_sources EXCLUDE REGEX "/view_server\\.cpp$")
endif()
add_library(gem_view STATIC ${view_sources} ${PROJECT_BINARY_DIR}/generated/gem_page.cpp)
target_link_libraries(gem_view PUBLIC gem_simulator gem_analysis PRIVATE nlohmann_json::nlohmann_json ${GEM_ZLIB}
  $<TARGET_NAME_IF_EXISTS:PkgConfig::HTTPLIB>)
gem_cold(gem_view gem/view)
# The header of the server library is large and defines many names.
set_source_files_properties(${PROJECT_SOURCE_DIR}/gem/view/server/view_server.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

gem_sources(command_sources gem/command gem/run)
add_library(gem_command STATIC ${command_sources})
target_link_libraries(gem_command PUBLIC gem_simulator gem_analysis PRIVATE gem_view CLI11::CLI11 nlohmann_json::nlohmann_json)
gem_cold(gem_command gem/run gem/command)

# The same scenes in Box2D; without it the program has one engine less.
gem_sources(baseline_sources baseline_box2d)
if(TARGET box2d::box2d)
  list(FILTER baseline_sources EXCLUDE REGEX "/without_box2d\\.cpp$")
else()
  list(FILTER baseline_sources INCLUDE REGEX "/(without_box2d|box2d_options)\\.cpp$")
endif()
add_library(gem_baseline STATIC ${baseline_sources})
target_link_libraries(gem_baseline PUBLIC gem_simulator $<TARGET_NAME_IF_EXISTS:box2d::box2d>)

add_executable(gem gem/main.cpp)
target_link_libraries(gem PRIVATE gem_command gem_baseline CLI11::CLI11)
gem_cold(gem)

# The judge of the reference paper is a separate program. experiments/ has the programs that write its rows.
gem_sources(paper_sources validation/paper)
list(FILTER paper_sources EXCLUDE REGEX "/validation/paper/(experiments/.*|gem_paper)\\.cpp$")
add_library(gem_paper_judge STATIC ${paper_sources})
target_link_libraries(gem_paper_judge PUBLIC gem_analysis
  PRIVATE GSL::gsl GSL::gslcblas nlohmann_json::nlohmann_json)
gem_cold(gem_paper_judge)
add_executable(gem_paper validation/paper/gem_paper.cpp)
target_link_libraries(gem_paper PRIVATE gem_paper_judge gem_command CLI11::CLI11)
gem_cold(gem_paper)

# Needs no benchmark library, because it is copied to the machine with the GPU.
if(GEM_HAS_CUDA)
  add_executable(gem_cuda_speed bench/cuda_speed.cpp)
  target_link_libraries(gem_cuda_speed PRIVATE gem_simulator)
  add_executable(gem_cuda_splitting bench/cuda_splitting.cpp)
  target_link_libraries(gem_cuda_splitting PRIVATE gem_simulator)
endif()
