// What a run needs and what the machine has: threads, memory, disk.
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "gem/record/output/output_path.h"
#include "gem/record/schema.h"
#include "gem/record/thruster_record.h"
#include "gem/scene/platform_shape.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <thread>

namespace gem {

namespace {

// Measured on the paper's run and rounded up.
constexpr double bytes_per_floe = 4096.0;             // state, outlines, pair lists and their copies
constexpr double base_memory = 48e6;                  // program, libraries, chunk caches
constexpr double compression = 0.75;                  // compressed size over raw size with gzip and shuffle
constexpr double checkpoint_bytes_per_floe = 1200.0;  // in contact, with rows that wait
constexpr double checkpoint_base = 1e5;
constexpr double checkpoint_files = 3.0;  // two, and the draft of the next one
constexpr double slabs_in_memory = 4.0;   // buffers of output: one being filled, some queued, one being written

double floe_count(const SceneDef& scene) {
  const bool listed = scene.floes.source == FloeSource::listed;
  const FloesDef& f = scene.floes;
  const auto pieces = double(scene.breakup.maximum_pieces);
  if (!listed && f.concentration > 0.0)
    return f.concentration * f.length_m * f.width_m /
               (f.size_mean_m * f.size_mean_m + f.size_deviation_m * f.size_deviation_m) +
           pieces;
  return (listed ? double(scene.floe.size()) : double(f.count)) + pieces;
}

/// MemAvailable of the system [bytes]; infinity if the system does not report it.
double available_memory() {
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("MemAvailable:", 0) != 0) continue;
    const auto first = line.find_first_of("0123456789");
    long long kilobytes = 0;
    std::from_chars(line.data() + first, line.data() + line.size(), kilobytes);
    return 1024.0 * double(kilobytes);
  }
  return HUGE_VAL;
}

}  // namespace

Estimate estimate(const SceneDef& scene, bool checkpoints) {
  const double duration = scene.run.duration_s;
  const double frames = 2.0 + duration / std::max(scene.output.floes_interval_s, scene.numerics.time_step_s);
  const double samples = 2.0 + duration / std::max(scene.output.platform_interval_s, scene.numerics.time_step_s);
  const double frame_bytes = floe_count(scene) * (6.0 * sizeof(float) + 1.0);
  // a jam has about two contacts for each floe; a row of /contacts has 32 bytes
  const double contact_bytes = scene.output.contact_forces ? 2.0 * floe_count(scene) * 32.0 : 0.0;
  Estimate need;
  need.steps = double(steps_of(scene));
  need.memory = base_memory + floe_count(scene) * bytes_per_floe +
                slabs_in_memory * std::min(frames, 64.0) * (frame_bytes + contact_bytes);
  // two columns with four bytes for each side
  const double side_bytes =
      scene.output.side_loads && scene.platform.present ? 8.0 * double(platform_outline(scene.platform).size()) : 0.0;
  const double line_bytes = 8.0 * double(line_columns(scene).size()) * double(scene.mooring_design.lines.size());
  const double thruster_bytes = has_dp(scene) ? 8.0 * (3.0 * double(scene.dp.thruster.size()) + 6.0) : 0.0;
  const double platform_bytes =
      samples * (8.0 * double(platform_columns().size()) + side_bytes + line_bytes + thruster_bytes);
  need.platform_disk = compression * platform_bytes;
  need.disk = compression * (frames * (frame_bytes + contact_bytes) + platform_bytes +
                             frames * 8.0 * double(stats_columns().size()) + floe_count(scene) * 160.0) +
              1e6;
  if (checkpoints)
    need.checkpoint_disk = checkpoint_files * (checkpoint_base + floe_count(scene) * checkpoint_bytes_per_floe);
  need.disk += need.checkpoint_disk;
  return need;
}

void check_resources(const Estimate& need, const std::string& output) {
  if (need.memory > available_memory()) {
    throw Error(ExitCode::resource_limit, "the run needs about " + size_text(need.memory) + " of memory (" +
                                              size_text(available_memory()) + " are free); use fewer floes or --force");
  }
  const double room = double(room_at(output));
  if (need.disk > room) {
    throw Error(ExitCode::resource_limit,
                "the run file and its checkpoints need about " + size_text(need.disk) + " (" + size_text(room) +
                    " are free at " + shown(output) + "); raise output." +
                    (need.platform_disk > 0.5 * need.disk ? "platform" : "floes") + "_interval_s, " +
                    (need.checkpoint_disk > 0.0 ? "keep no checkpoints (--checkpoint-every 0), " : "") +
                    "choose another --out, or use --force");
  }
}

std::string size_text(double bytes) {
  const char* units[] = {"B", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  while (bytes >= 1000.0 && unit < 5) {
    bytes /= 1000.0;
    ++unit;
  }
  return fixed_text(bytes, unit == 0 || bytes >= 100.0 ? 0 : 1) + " " + units[unit];
}

int choose_threads(const std::string& asked, std::string& message) {
  const int machine = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const char* environment = std::getenv("OMP_NUM_THREADS");
  const bool from_option = !asked.empty();
  if (!from_option && environment == nullptr) return machine;
  const std::string text = from_option ? asked : environment;
  const std::string what = from_option ? "--threads " + text : "OMP_NUM_THREADS=" + text;
  int threads = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), threads);
  if (fault == std::errc::invalid_argument || end != text.data() + text.size()) {
    if (from_option)
      throw Error(ExitCode::usage, what + " is not a whole number (1 or more); give a number of threads");
    message = what + " is not a whole number, using " + std::to_string(machine);
    return machine;
  }
  const int limit = 4 * machine;
  if (fault == std::errc::result_out_of_range) threads = text.front() == '-' ? 0 : limit + 1;
  if (from_option && threads < 1)
    throw Error(ExitCode::usage,
                what + " is not a number of threads (it must be 1 or more); leave it out to use all processors");
  if (threads >= 1 && threads <= limit) return threads;
  const int used = threads < 1 ? machine : limit;
  message = what + " is out of range (1 to " + std::to_string(limit) + " here), using " + std::to_string(used);
  return used;
}

}  // namespace gem
