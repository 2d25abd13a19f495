# Writes gem_version.h; touches it only when something changed.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --abbrev=12
  OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(COMMIT "unknown")
else()
  # What programs are made of, new files too; results and pages are no part of them.
  execute_process(COMMAND git -C ${SOURCE_DIR} status --porcelain -- CMakeLists.txt CMakePresets.json scripts/cmake
      gem baseline_box2d bench validation ":(exclude)bench/results" ":(exclude)validation/*.md" ":(exclude)validation/*.csv"
      ":(exclude)validation/*/figures/*" ":(exclude)*.md"
    OUTPUT_VARIABLE changed)
  if(changed)
    string(APPEND COMMIT "-dirty")
  endif()
endif()
set(text "// Identity of this build.
#pragma once
#define GEM_VERSION \"${VERSION}\"
#define GEM_COMMIT \"${COMMIT}\"
#define GEM_BUILD_TYPE \"${BUILD_TYPE}\"
#define GEM_COMPILER \"${COMPILER}\"
#define GEM_LIBRARIES \"${LIBRARIES}\"
#define GEM_HAS_CUDA ${HAS_CUDA}
")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT "${old}" STREQUAL "${text}")
  file(WRITE ${OUTPUT} "${text}")
endif()
