// State of the reference engine: bodies, books, and the constants of a time step.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/engine/engine.h"
#include "gem/events/events.h"
#include "gem/geometry/piece_joints.h"

namespace gem::reference {

/// Constants derived once from the scene.
struct Rules {
  SceneDef scene;
  double dt = 0.0;              // [s]
  double contact_margin = 0.0;  // coupled: faces closer than this form a contact [m]
  double asked_residual = std::numeric_limits<double>::quiet_NaN();  // coupled: by which a run is judged [m/s]
  double repair_reach = 0.0;        // coupled: largest repair motion of any point of a body in one time step [m]
  Events events;                    // the laws of the scene
  MooringFlow half_mooring;         // over dt / 2
  bool platform_moves = false;      // present and not fixed
  double stiffness = 0.0;           // of the mooring; 0 without platform [N/m]
  double platform_drag_rate = 0.0;  // of the round law [1/m]; 0: none
  AxisDrag axis_drag;
  double platform_wind_rate = 0.0;        // [1/m]; 0: none
  DriveSchedule drives;                   // of each time step
  MooringTables mooring;                  // of the laws in events.moored
  DpLaw dp;                               // without thrusters: none
  double tow_rate = 0.0;                  // of a ship in transit [1/s]; 0: none
  ThrustLaw thrust;                       // of one that runs free
  std::vector<PieceCorner> piece_corner;  // joints of a platform of several pieces

  bool coupled() const { return scene.contact.solver == ContactSolver::coupled; }
  bool compliant() const { return scene.contact.solver == ContactSolver::compliant; }
};

Rules rules_of(const SceneDef& scene, const Bodies& bodies);

/// Arrays have one entry per body.
struct State {
  Bodies bodies;
  Ledger ledger;  // `now` and the scales are updated on request
  std::int64_t steps = 0;
  LineSet broken = 0;  // lines of the mooring
  DpState dp;          // dynamic positioning

  // of the current time step
  Drive drive;
  std::vector<Vec2> path_correction;     // exact path of the solo events minus velocity x dt [m]
  std::vector<double> angle_correction;  // [rad]
  std::vector<std::uint8_t> struck;      // does not follow the exact path of its solo events
  std::vector<Vec2> repair_shift;        // [m]
  std::vector<double> repair_turn;       // [rad]
  Vec2 platform_start;                   // platform position when the touches were found [m]
  PlatformSpeed before_contacts;         // of the platform
  Vec2 mooring_impulse, drag_impulse;    // on the platform [N s]

  /// Clears the data of the last time step.
  void begin_step(const Rules& rules);
  /// Gives the pieces of the platform the place and the motion of body 0.
  void carry_pieces();
};

}  // namespace gem::reference
