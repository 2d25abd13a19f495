// Compliant contacts of a host engine: corners are found once a time step, forces and motion follow in substeps.
//
//   begin    corners of every near pair
//   run      the substeps: press every pair that may overlap | move every body that was touched
//   finish   velocities and places of the bodies, impulses of the contacts, books
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "gem/engine/cpu/pair_blocks.h"
#include "gem/engine/cpu/pairs_in_reach.h"
#include "gem/engine/cpu/thread_team.h"
#include "gem/engine/engine.h"

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
  void note_velocities(const FieldState& f) { near_.note_velocities(f); }

  std::int64_t substeps() const { return substeps_; }
  const ContactEnergy& energy() const { return energy_; }
  const std::vector<std::uint64_t>& keys() const { return key_; }
  const std::vector<CornerMemory>& memory() const { return memory_; }
  void restore(const EngineState& state);

 private:
  // of an entry
  static constexpr std::uint8_t free = 0, touched = 1, moves = 2;
  struct alignas(64) Part {  // one per thread
    PairBlocks blocks;
  };
  struct Opened {
    std::int32_t part = -1;  // -1: not opened in this time step
    PairLane lane;
  };

  void lay_out();
  void open(const FieldState& f, Contacts contacts, std::int32_t pair, int part);
  CornerMemory* remembered(std::uint64_t key);
  void look_and_press(const FieldState& f, Contacts contacts, std::int64_t substep, std::int64_t begin,
                      std::int64_t end, int rank);
  void move_bodies(FieldState& f, std::int64_t substep, const ThreadTeam& team, int rank);
  void move_platform(FieldState& f);
  PairPush sum_of(std::int64_t entry) const;
  void hand_back(FieldState& f, std::int32_t entry);
  void tell(FieldState& f, Contacts contacts, StepQuality& quality, StepLog& log);
  void tell_pair(FieldState& f, std::int32_t pair, Contact& contact, StepQuality& quality, StepLog& log);
  void remember();
  // several threads may note the same touch
  std::uint8_t state_of(std::int32_t entry) {
    return std::atomic_ref<std::uint8_t>(state_[entry]).load(std::memory_order_relaxed);
  }
  void note_touch(std::int32_t entry) {
    if (state_of(entry) == free) std::atomic_ref<std::uint8_t>(state_[entry]).store(touched, std::memory_order_relaxed);
  }

  std::int64_t substeps_ = 1;
  double h_ = 0.0;  // [s]
  StepConstants of_substep_;
  PairsInReach near_;

  std::vector<Part> part_;
  std::vector<Opened> opened_;                 // per pair
  std::vector<PairPush> push_;                 // per pair, of the last substep
  std::vector<std::uint8_t> presses_;          // per pair: a corner overlapped in the last substep
  std::vector<std::uint64_t> corner_key_;      // per corner within reach
  std::vector<SubMotion> motion_;              // per entry; of a free body: at the start
  std::vector<double> stray_;                  // per entry [m]
  std::vector<std::uint8_t> state_;            // per entry
  std::vector<std::int32_t> row_begin_, row_;  // per entry: its pairs; 2 x pair + (1: it is b)

  std::vector<std::uint64_t> key_;
  std::vector<CornerMemory> memory_;
  ContactEnergy energy_;
};

}  // namespace gem
