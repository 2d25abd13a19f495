#!/usr/bin/env bash
# Tests check_includes.sh: plants one fault of every kind and compares the reports. A line that ends in `// PLANT rule...` must
# be reported by exactly these rules, every other line by none.
set -euo pipefail
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

plant() {
  mkdir -p "$tree/$(dirname "$1")"
  cat >"$tree/$1"
}

plant gem/base/number.h <<'END'
// strtod in a comment is no fault
/* nor is pow(x) here,
   nor sin(x) on the next line */
#include <cuda_runtime.h>  // PLANT cuda
#include "gem/geometry/polygon.h"  // PLANT layer
inline double parse(const char* text) { return strtod(text, nullptr); }  // PLANT locale
inline double parse(const std::string& text) { return std::stod(text); }  // PLANT locale
inline double scan(const char* text) { double x; sscanf(text, "%lf", &x); return x; }  // PLANT locale
inline const char* message() { return "strtod(\"x\") in a literal is no fault"; }
inline const char* raw = R"toml(
  #include "gem/main.h"
  "strtod(x)" )toml"; double after = atof("1");  // PLANT locale
inline bool is_quote(char c) { return c == '"' || c == '\''; } double twice = atof("2") * atof("1");  // PLANT locale locale
inline double scaled = sin(1'000.0);
inline void set_up() { setlocale(LC_ALL, ""); }  // PLANT locale
END
plant gem/base/macros.h <<'END'
#ifdef __CUDACC__
#define GEM_HD __host__ __device__
#endif
END
plant gem/geometry/polygon.h <<'END'
#include "gem/base/number.h"
#include "polygon_detail.h"  // PLANT unknown-layer
#include "gem/shapes/outline.h"  // PLANT unknown-layer
#include "gem/events/impact.h"  // PLANT layer
#include <box2d/box2d.h>  // PLANT box2d
inline double area(double r) { return std::pow(r, 2.0); }  // PLANT bits
inline double strict_area(double r) { return strict::pow(r, 2.0) + strict::log(r); }
END
plant gem/events/impact.h <<'END'
#include "gem/base/number.h"
#include "gem/geometry/polygon.h"
#include "gem/scene/scene_def.h"  // PLANT events-sees
#include "gem/field/bodies.h"  // PLANT events-sees
#include <Eigen/Dense>  // PLANT eigen
double exponent(double p) { return std::pow(p, 0.5) + hypot(p, p); }  // PLANT bits bits
double angle(double power) { const double sin = power; return atan2(sin, power); }  // PLANT bits
__device__ double on_device();  // PLANT cuda
END
plant gem/events/impact_test.cpp <<'END'
#include "gem/events/impact.h"
#include "gem/engine/engine.h"  // PLANT events-sees
double expected() { return std::cos(0.5); }
void comma() { setlocale(LC_NUMERIC, "de_DE.UTF-8"); }
END
plant gem/scene/toml/scene_file.cpp <<'END'
#include <toml++/toml.h>
#include "gem/field/bodies.h"  // PLANT layer
#include <hdf5.h>  // PLANT hdf5
END
plant gem/field/bodies.cpp <<'END'
#include <toml++/toml.h>  // PLANT toml
#include "gem/scene/scene_def.h"
void lines(const std::string& text) {
  std::istringstream rows(text);
  for (std::string row; std::getline(rows, row);) {
    std::istringstream fields(row);
    for (std::string word; fields >> word;) count(word);
    double number;
    fields >> number;  // PLANT locale
    std::cin >> number;  // PLANT locale
  }
}
double read(std::istream& file) { double x; file >> x; return x; }  // PLANT locale
double turn(double angle) { return std::cos(angle); }
END
plant gem/engine/cpu/cpu_engine.cpp <<'END'
#include "gem/field/bodies.h"
#include "gem/record/recorder.h"  // PLANT layer
#include <gsl/gsl_fft.h>  // PLANT gsl
std::atomic<double> total;  // PLANT order
std::atomic<int> count;
#pragma omp parallel for
#pragma omp parallel for reduction(+ : total)  // PLANT order
#pragma omp parallel for reduction(max : largest)
#pragma omp atomic  // PLANT order
double decay(double x) { return std::exp(-x); }  // PLANT bits
void wait() { cudaDeviceSynchronize(); }  // PLANT cuda
END
plant gem/engine/cuda/cuda_engine.cu <<'END'
#include <cub/cub.cuh>
__global__ void kernel(double* sum) { atomicAdd(sum, 1.0); }  // PLANT order
END
plant gem/engine/reference/reference_engine.cpp <<'END'
#include <Eigen/SparseCore>
#include "gem/engine/engine.h"
#include "gem/engine/reference/touch.h"
#include "gem/engine/step/contact.h"  // PLANT oracle
#include "gem/events/impact.h"
END
plant gem/record/recorder.cpp <<'END'
#include <Eigen/SparseCore>  // PLANT eigen
#include <H5DSpublic.h>
#include <hdf5.h>
#include "gem/analysis/spectra/spectrum.h"  // PLANT layer
END
plant gem/record/run_writer.cpp <<'END'
std::atomic<double> saved_time;
END
plant gem/run/run_log.cpp <<'END'
#include "gem/run/run_scene.h"
#include "gem/record/recorder.h"
#include "gem/main.h"  // PLANT layer
END
plant gem/analysis/spectra/spectrum.cpp <<'END'
#include <gsl/gsl_fft.h>
#include <Eigen/Dense>  // PLANT eigen
#include "gem/record/reader.h"
#include "gem/engine/engine.h"  // PLANT analysis-sees
#include <hdf5_hl.h>  // PLANT hdf5
END
plant gem/report/page.cpp <<'END'
#include "gem/analysis/spectra/spectrum.h"
#include "gem/run/run_scene.h"  // PLANT layer
#include "validation/paper/runs/paper_run.h"  // PLANT unknown-layer
#include <CLI/CLI.hpp>  // PLANT cli11
END
plant gem/command/run.cpp <<'END'
#include <CLI/CLI.hpp>
#include "gem/run/run_scene.h"
#include "gem/report/page.h"
#include "gem/main.h"  // PLANT layer
END
plant gem/main.cpp <<'END'
#include <CLI/CLI.hpp>
#include "gem_version.h"
#include "gem/command/run.h"
END
plant gem/orphan.h <<'END'
#pragma once  // PLANT unknown-layer
END
plant validation/verification/drift_test.cpp <<'END'
#include "gem/engine/engine.h"
#include <gsl/gsl_integration.h>  // PLANT gsl
END

plant validation/paper/analysis/fits/line_fit.cpp <<'END'
#include <gsl/gsl_fit.h>
#include "gem/analysis/statistics/moments.h"
END
plant gem/view/page_text.cpp <<'END'
#include "gem/report/page.h"
#include "gem/run/run_scene.h"  // PLANT layer
#include <httplib.h>  // PLANT httplib
#include <zlib.h>  // PLANT zlib
END
plant gem/view/server/view_server.cpp <<'END'
#include <httplib.h>
END
plant validation/paper/runs/paper_run.cpp <<'END'
#include "gem/report/page.h"
#include <gsl/gsl_fit.h>  // PLANT gsl
END

# grep prints file:line:text; keep one "file:line: rule" for each rule named by the marker.
expected=$(cd "$tree" && grep -rn '// PLANT' . | sed 's|^\./||; s|^\([^:]*:[0-9]*\):.*// PLANT |\1 |' |
  awk '{ for (i = 2; i <= NF; i++) print $1 ": " $i }' | sort)

status=0
report=$("$scripts/check_includes.sh" "$tree") || status=$?
reported=$(grep -v '^rules: ' <<<"$report" | sed 's/^\([^:]*:[0-9]*: [a-z0-9-]*\): .*/\1/' | sort)

if [ "$status" -ne 1 ] || [ "$expected" != "$reported" ]; then
  echo "planted (<) and reported (>) faults differ, or the exit code $status is not 1:"
  diff <(echo "$expected") <(echo "$reported") || true
  exit 1
fi

# A rule that no planted fault breaks may be dead. A stale allowance would have to stand in the script itself, so it is not
# planted.
for rule in $("$scripts/check_includes.sh" --rules | grep -v '^allowance$'); do
  grep -q ": $rule\$" <<<"$reported" || { echo "rule $rule has no planted fault" && exit 1; }
done

rm -rf "$tree/gem" "$tree/validation"
plant gem/base/vec2.h <<<'#pragma once'
"$scripts/check_includes.sh" "$tree" >/dev/null || { echo "a clean tree is reported as faulty" && exit 1; }

echo "all $(wc -l <<<"$expected") planted faults are reported and nothing else"
