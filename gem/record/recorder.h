// Turns the log of every time step into the rows of a run file: platform samples, floe frames, events and statistics.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "gem/record/hits.h"
#include "gem/record/line_tensions.h"
#include "gem/record/run_file/run_writer.h"
#include "gem/record/side_loads.h"
#include "gem/record/thruster_record.h"

namespace gem {

/// The time steps that are recorded, one every `interval` seconds. No time step is recorded twice.
class Cadence {
 public:
  Cadence(double interval, double time_step) : interval_(interval), time_step_(time_step) {}
  /// The next time step to record after `step`.
  std::int64_t next_after(std::int64_t step) const;

 private:
  double interval_;
  double time_step_;
};

/// What a recorder carries from one time step to the next.
struct RecorderState {
  /// A part that can be copied byte by byte.
  struct Numbers {
    std::int64_t step = 0;
    std::int64_t sample_step = 0;
    std::int64_t frame_step = 0;
    std::int64_t hits_taken = 0;
    double frame_wall_time = 0.0;
    double yaw = 0.0;
    PlatformStep since_sample;  // sums since the last platform sample
    PlatformStep last;          // the last time step
    StepQuality worst;          // since the last frame
    OverlapCount overlap, overlap_share;
  };
  Numbers now;
  std::vector<Vec2> window;            // ice impulses of the last time steps, the oldest first
  std::vector<OpenHit> hits;           // of floes that press
  SideSums sides = {};                 // empty unless they are recorded
  LineSums lines = {};                 // empty without lines
  std::vector<double> thrusters = {};  // empty without thrusters: see ThrusterRecord::sums()
};

/// Most forces between bodies that are recorded of a floe frame: the largest. A frame of a jam has about two for each
/// floe.
inline constexpr std::size_t contacts_of_frame_maximum = 65536;

/// Samples one run. It does not write files: the recorded rows are taken from it as slabs.
class Recorder {
 public:
  /// Records t = 0.
  Recorder(const SceneDef& scene, Engine& engine);

  /// Adds the time steps in `log`, which follow those added before: samples the platform and keeps the events. Always
  /// samples the platform at `last_step`.
  void add(const StepLog& log, std::int64_t last_step);
  /// Keeps the outlines of the pieces of floes that split in the time steps just added.
  void keep_pieces(const StepLog& log, const Bodies& bodies);
  /// Records all floes and the books after the last added time step. Returns the row of statistics.
  StatsRow add_frame(Engine& engine, double wall_time);
  /// Samples the platform at the last added time step if it is not sampled yet.
  void sample_rest();
  std::int64_t next_frame() const { return frames_.next_after(now_.frame_step); }
  /// Ends the hits of floes that still press. For the end of a run.
  void end_hits() { hits_.end_all(slab_.events); }
  /// Returns what was recorded since the last call.
  Slab take();
  std::size_t frames_waiting() const { return slab_.floes.time.size(); }
  /// Rows of the platform, hits and forces between bodies since the last take().
  std::size_t rows_waiting() const {
    return slab_.platform.size() + slab_.events.size() + slab_.contacts.size() + slab_.splits.size();
  }
  /// When each mooring line broke [s]; 0: it holds. Empty without lines.
  const std::vector<double>& line_break_times() const { return lines_.sums().break_time; }
  std::int64_t hits_seen() const { return now_.hits_taken + static_cast<std::int64_t>(slab_.events.size()); }
  /// The rows that were not taken are not part of the state.
  RecorderState state() const {
    return {now_, {window_.begin(), window_.end()}, hits_.open(), sides_.sums(), lines_.sums(), thrusters_.sums()};
  }
  /// Whether the state is one of a run of this scene.
  bool fits(const RecorderState& state) const;
  /// Goes on from a state that fits, without rows that wait.
  void restore(const RecorderState& state);

 private:
  void record_start(const SceneDef& scene, const Bodies& bodies);
  void sample(const PlatformStep& now, std::int64_t step);
  void keep_frame(const Bodies& bodies);
  void keep_stats(Engine& engine, double wall_time);
  void keep_contacts(Engine& engine);
  void number_as_in_files();

  double time_step_;
  bool has_platform_;
  bool has_contacts_;            // the forces between bodies are recorded
  bool has_hits_;                // events are recorded
  std::int32_t further_pieces_;  // of the platform: bodies that files do not count
  Cadence platform_;
  Cadence frames_;
  std::size_t window_steps_;
  RecorderState::Numbers now_;
  std::deque<Vec2> window_;  // ice impulses of the last time steps
  Hits hits_;
  SideLoads sides_;
  LineTensions lines_;
  ThrusterRecord thrusters_;
  Slab slab_;
};

}  // namespace gem
