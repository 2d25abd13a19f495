# Prefers static libraries, so that a single copied file runs on a machine without these packages.

function(gem_static_library target file)
  find_library(GEM_STATIC_${file} NAMES lib${file}.a PATH_SUFFIXES hdf5/serial REQUIRED)
  add_library(${target} STATIC IMPORTED)
  set_target_properties(${target} PROPERTIES IMPORTED_LOCATION ${GEM_STATIC_${file}})
  target_link_libraries(${target} INTERFACE ${ARGN})
endfunction()

find_path(GEM_STATIC_HDF5_INCLUDE hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)
gem_static_library(aec aec)
gem_static_library(sz sz aec)
gem_static_library(z z)
# The archive also depends on curl and crypto, but only in its network reader, which is not used here.
gem_static_library(hdf5::hdf5 hdf5 sz z ${CMAKE_DL_LIBS} m)
gem_static_library(hdf5::hdf5_hl hdf5_hl hdf5::hdf5)
target_include_directories(hdf5::hdf5 INTERFACE ${GEM_STATIC_HDF5_INCLUDE})

gem_static_library(GSL::gslcblas gslcblas m)
gem_static_library(GSL::gsl gsl GSL::gslcblas)
