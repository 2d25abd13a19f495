#include "gem/report/contact_energy_record.h"

#include "gem/base/number_text.h"
#include "gem/record/run_file/column_pieces.h"

namespace gem {

std::optional<ContactEnergy> contact_energy_of(const RunFile& file) {
  if (!file.has("stats/energy_contact_left") || file.rows("stats/time") == 0) return std::nullopt;
  const auto last = [&file](const char* name) { return last_value(file, std::string("stats/") + name); };
  ContactEnergy energy;
  energy.stored = last("energy_contact_stored");
  energy.crushed = last("energy_contact_crushed");
  energy.damped = last("energy_contact_damped");
  energy.friction = last("energy_contact_friction");
  energy.work = last("energy_contact_left") - energy.left();
  energy.load = last("contact_load");
  energy.softened = last("contact_softened");
  return energy;
}

std::string contact_energy_text(const ContactEnergy& energy) {
  const auto joules = [](double value) { return number_text(value, 3) + " J"; };
  return joules(energy.crushed) + " crushed, " + joules(energy.damped) + " damped, " + joules(energy.friction) +
         " by friction, " + joules(energy.stored) + " stored; " + joules(energy.left()) + " unexplained";
}

std::string softened_text(const ContactEnergy& energy) {
  return number_text(100.0 * softened_share(energy), 3) +
         " % of the load, through corners with less than half the stiffness of their ice";
}

}  // namespace gem
