# Finds the libraries. Everything comes from the distribution's packages; scripts/packages.txt lists them.
if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(CCACHE ccache)
  if(CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
  endif()
endif()

if(GEM_STATIC)
  include(gem_static)
else()
  find_package(HDF5 REQUIRED COMPONENTS C HL)
  find_package(GSL REQUIRED)
endif()
find_package(Eigen3 3.4 REQUIRED CONFIG)
find_package(Threads REQUIRED)
# Header-only on purpose: the packaged library reads numbers through a stream instead of std::from_chars.
find_path(TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h REQUIRED)
find_package(CLI11 REQUIRED CONFIG)
find_package(nlohmann_json REQUIRED CONFIG)
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)

# The baseline's library comes as a shared one only, so a static build goes without.
if(GEM_BOX2D AND NOT GEM_STATIC)
  find_package(box2d 2.4.1 REQUIRED CONFIG)
endif()

if(NOT GEM_CUDA STREQUAL OFF)
  include(CheckLanguage)
  check_language(CUDA)
  if(NOT CMAKE_CUDA_COMPILER AND GEM_CUDA STREQUAL ON)
    message(FATAL_ERROR "GEM_CUDA=ON but no CUDA compiler was found")
  endif()
endif()
