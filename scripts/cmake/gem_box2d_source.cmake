# Builds Box2D from sources as a static library, with this build's optimisation and without assertions, for programs that are
# copied to another machine. scripts/box2d_source.sh fetches the sources.
file(GLOB_RECURSE box2d_sources ${GEM_BOX2D_SOURCE}/src/*.cpp)
if(NOT box2d_sources OR NOT EXISTS ${GEM_BOX2D_SOURCE}/include/box2d/box2d.h)
  message(FATAL_ERROR "GEM_BOX2D_SOURCE=${GEM_BOX2D_SOURCE} holds no Box2D (no src/*.cpp or include/box2d/box2d.h): "
    "name the folder that scripts/box2d_source.sh prints")
endif()
add_library(box2d_from_source STATIC ${box2d_sources})
target_include_directories(box2d_from_source SYSTEM PUBLIC ${GEM_BOX2D_SOURCE}/include PRIVATE ${GEM_BOX2D_SOURCE}/src)
target_compile_options(box2d_from_source PRIVATE -ffp-contract=off)
add_library(box2d::box2d ALIAS box2d_from_source)

# One experiment changes the slop, a compile-time constant of Box2D: it is redefined after the header that defines it.
if(GEM_BOX2D_SLOP)
  file(WRITE ${PROJECT_BINARY_DIR}/generated/box2d_slop.h
    "#include <box2d/b2_common.h>\n#undef b2_linearSlop\n#define b2_linearSlop (${GEM_BOX2D_SLOP}f)\n")
  target_compile_options(box2d_from_source PUBLIC
    -include ${PROJECT_BINARY_DIR}/generated/box2d_slop.h)
endif()
