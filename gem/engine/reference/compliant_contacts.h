// Compliant contacts as the law says (gem/events/compliant_contact.h), in substeps (symplectic Euler):
//
//   find the corners inside | their forces | velocities | loads of floes and platform | motion
//
// Nothing is kept from one substep to the next but what a corner remembers. All loads act in every substep, as in a
// time step of that length. The substeps are shorter than those of other engines by a factor, so corners need no limits
// of stability: every corner has the stiffness of the ice.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "gem/engine/engine.h"
#include "gem/engine/reference/corners_inside.h"
#include "gem/engine/reference/reference_state.h"
#include "gem/engine/reference/touch.h"
#include "gem/events/crushing.h"

namespace gem::reference {

class CompliantContacts {
 public:
  /// `refinement`: substeps for each one that the scene asks for.
  CompliantContacts(const SceneDef& scene, const Bodies& bodies, int refinement);

  /// A time step of all bodies. Returns the pairs that pressed: one point each, with the impulse of the time step.
  /// Places are those at its start.
  std::vector<Touch> advance(const Rules& rules, State& s, StepQuality& quality, StepLog& log);

  void save(EngineState& state) const;
  void restore(const SceneDef& scene, const EngineState& state);

 private:
  /// By contact_key().
  using Memory = std::map<std::uint64_t, CornerMemory>;

  /// A corner in this substep. Speeds are relative to q.
  struct Corner {
    CornerInside at;
    std::uint64_t key = 0;
    CornerMemory memory;
    bool fresh = false;           // was not inside, or not loaded yet
    double u_n = 0.0, u_t = 0.0;  // [m/s]
    double trial = 0.0;           // force of spring and dashpot [N]
  };
  struct PairLaw {
    CornerLaw corner;
    CrushingIce ice;
    bool crushes = false;
  };
  /// What a body gets in a substep.
  struct Push {
    Vec2 impulse;        // [N s]
    double twist = 0.0;  // about the centroid [N m s]
  };
  /// What a pair did in the time step. Impulses act on b.
  struct PairSum {
    Vec2 impulse, normal_part;                 // [N s]
    double moment = 0.0;                       // about the origin [N m s]
    double pressed = 0.0;                      // [N s]
    Vec2 place;                                // weighted with `pressed` [m N s]
    double deepest = 0.0, most_elastic = 0.0;  // [m]
    double friction = 0.0;                     // mu [-]
    std::set<std::uint64_t> corners;
    // in the substep with the largest force
    double largest_force = 0.0, chord = 0.0, growth = 0.0;
  };

  void set_substeps(const SceneDef& scene, const Bodies& bodies, std::int64_t of_scene);
  void substep(const Rules& rules, State& s);
  PairLaw law_of(const Rules& rules, const Bodies& b, const Overlap& overlap) const;
  std::vector<Corner> recall(const Bodies& b, const Overlap& overlap, Memory& before) const;
  void hand_over(const Overlap& overlap, std::vector<Corner>& corners, Memory& before, ContactEnergy& energy) const;
  void press(const PairLaw& law, const Overlap& overlap, std::vector<Corner>& corners, State& s,
             std::vector<Push>& push);
  void load(const CornerLaw& law, double force, bool crushes, Corner& corner, Ledger& ledger) const;
  void give(const Corner& corner, bool of_b, PairSum& sum, State& s, std::vector<Push>& push) const;
  std::vector<Touch> touches(const Bodies& start) const;

  std::int64_t of_scene_ = 1, refinement_ = 1;
  double h_ = 0.0;    // [s]
  Rules of_substep_;  // of a time step of that length
  Memory memory_;
  std::map<std::pair<std::int32_t, std::int32_t>, PairSum> pairs_;  // of the time step
};

}  // namespace gem::reference
