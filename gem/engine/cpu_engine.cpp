// One moment:
//   find contacts            at the positions of the moment's start
//   solo events              current drag on every floe, first half of the platform's own motion
//   pair events              independent or coupled
//   books                    energy and momentum of every contact
//   motion                   floes with their new velocity, second half of the platform's own motion
#include "gem/engine/cpu_engine.h"

#include <utility>

#include "gem/engine/books.h"
#include "gem/engine/contact_stages.h"
#include "gem/engine/solo_stages.h"

namespace gem {

CpuEngine::CpuEngine(const SceneDef& scene, Bodies bodies, int threads)
    : event_speed_(scene.output.event_speed_m_per_s), threads_(threads) {
  const MomentConstants constants = moment_constants(scene, bodies);
  field_ = make_field_state(std::move(bodies), constants);
  ledger_.start = total(field_);
}

void CpuEngine::advance(std::int64_t moments, MomentLog& log) {
  for (std::int64_t i = 0; i < moments; ++i) one_moment(log);
}

void CpuEngine::one_moment(MomentLog& log) {
  FieldState& f = field_;
  const std::int64_t n = static_cast<std::int64_t>(f.bodies.count());
  const Ledger before = ledger_;
  pairs_.find(f, threads_, contacts_);

#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::int64_t i = 0; i < n; ++i)
    if (f.bodies.kind[i] == BodyKind::floe) kick_floe(f, i);
  platform_first_half(f, ledger_);

  MomentQuality quality = contact_quality(contacts_);
  if (f.constants.resolution == Resolution::coupled) {
    coupled_.resolve(f, contacts_, threads_, quality);
  } else {
    for (Contact& contact : contacts_) {
      prepare_contact(f, contact, 1.0);
      resolve_alone(f, contact);
    }
    for (const Contact& contact : contacts_) apply_impulses(f.bodies, contact, true);
  }
  for (const Contact& contact : contacts_) book_contact(f, contact, ledger_);

#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::int64_t i = 0; i < n; ++i)
    if (f.bodies.kind[i] == BodyKind::floe) drift_floe(f, i);
  log_events(f, contacts_, moment_, event_speed_, log);
  platform_second_half(f, ledger_);
  ++moment_;
  retire_and_check(f, ledger_, moment_);
  log_moment(f, contacts_, before, ledger_, quality, log);
}

Ledger CpuEngine::ledger() { return closed_books(field_, ledger_); }

EngineState CpuEngine::save() {
  return {moment_, field_.bodies, closed_books(field_, ledger_), coupled_.keys(), coupled_.impulses()};
}

void CpuEngine::restore(const EngineState& state) {
  field_ = make_field_state(state.bodies, field_.constants);
  ledger_ = state.ledger;
  moment_ = state.moment;
  coupled_.restore(state.impulse_key, state.impulse_value);
  pairs_.clear();
}

}  // namespace gem
