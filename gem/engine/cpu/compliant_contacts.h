// Compliant contacts of a host engine: corners are found once a time step, forces and motion follow in substeps.
//
//   begin    corners of every near pair, their laws within the stability limits, what they remember
//   run      the substeps: press every pair | move every body
//   finish   velocities and places of the bodies, impulses of the contacts, books
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "gem/engine/contact/substep.h"
#include "gem/engine/cpu/thread_team.h"
#include "gem/engine/engine.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

class CompliantContacts {
 public:
  /// `substeps` of one time step; `of_substep`: the constants of a time step of that length, for the platform's loads.
  void set_up(std::int64_t substeps, const StepConstants& of_substep);

  // called by every thread of a team, in this order
  void begin(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank);
  void run(FieldState& f, Contacts contacts, ThreadTeam& team, int rank);
  void finish(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, StepQuality& quality, StepLog& log);

  /// Velocities before the other loads of the time step, to be set before they act.
  void note_velocities(const FieldState& f);

  std::int64_t substeps() const { return substeps_; }
  const ContactEnergy& energy() const { return energy_; }
  const std::vector<std::uint64_t>& keys() const { return key_; }
  const std::vector<CornerMemory>& memory() const { return memory_; }
  void restore(const EngineState& state);

 private:
  /// A corner within reach.
  struct Found {
    std::int32_t contact = 0, corner = 0, side = 0;
    bool of_b = false;
    bool counts = false;  // for the stability limit: it is within reach of the present motion
  };
  struct alignas(64) Part {  // one per thread
    std::vector<Found> found;
  };

  void find(const FieldState& f, Contacts contacts, const ThreadTeam& team, int rank);
  void lay_out(const FieldState& f, Contacts contacts, int threads);
  std::int32_t enter(const FieldState& f, std::int32_t body);
  void watch_pair(const FieldState& f, Contacts contacts, SubPair& pair);
  void open(const FieldState& f, Contacts contacts, SubPair& pair);
  void press_range(const FieldState& f, Contacts contacts, std::int64_t substep, std::int64_t begin, std::int64_t end);
  // several threads may note the same touch
  std::uint8_t touched_of(std::int32_t entry) {
    return std::atomic_ref<std::uint8_t>(touched_[entry]).load(std::memory_order_relaxed);
  }
  void note_touch(std::int32_t entry) {
    std::atomic_ref<std::uint8_t>(touched_[entry]).store(1, std::memory_order_relaxed);
  }
  bool sum_of(std::int64_t entry, Vec2& impulse, double& twist) const;
  void keep(SubPoint& point, std::uint64_t key);
  void sum_rows();
  void move_bodies(FieldState& f, std::int64_t substep, const ThreadTeam& team, int rank);
  void move_platform(FieldState& f);
  Surface surface_of(const FieldState& f, std::int32_t body) const;
  void hand_back(FieldState& f, std::int32_t entry);
  void tell(FieldState& f, Contacts contacts, StepQuality& quality, StepLog& log);
  void tell_pair(FieldState& f, const SubPair& pair, Contact& contact, StepQuality& quality, StepLog& log);
  void remember();

  std::int64_t substeps_ = 1;
  double h_ = 0.0;  // [s]
  StepConstants of_substep_;
  std::vector<std::uint8_t> hidden_side_, no_corner_;  // of the pieces of the platform, indexed as bodies.vertex

  std::vector<Vec2> velocity_before_;  // [m/s]
  std::vector<double> spin_before_;

  std::vector<Part> part_;
  std::vector<Found> found_;
  std::vector<SubPair> pair_;
  std::vector<SubPoint> point_;
  std::vector<std::uint64_t> point_key_;
  std::vector<SubBody> body_;                  // entries: bodies with corners within reach, and the platform
  std::vector<std::int32_t> body_id_;          // per entry
  std::vector<std::int32_t> entry_of_;         // per body; -1: none
  std::vector<std::int32_t> corners_;          // per entry: corners within reach
  std::vector<double> stray_;                  // per entry [m]
  std::vector<std::uint8_t> touched_;          // per entry: 0 free, 1 touched in this substep, 2 before
  std::vector<std::int32_t> row_begin_, row_;  // per entry: its points; 2 x point + (1: of b)
  std::int32_t platform_ = -1;                 // its entry

  std::vector<std::uint64_t> key_;
  std::vector<CornerMemory> memory_;
  ContactEnergy energy_;
};

}  // namespace gem
