// The energies of compliant contacts at the end of a run, from its file, and in words.
#pragma once

#include <optional>
#include <string>

#include "gem/engine/step/ledger.h"
#include "gem/record/run_file/run_file.h"

namespace gem {

/// Of the last row of the books; nothing for a run of another solver, or without a row.
std::optional<ContactEnergy> contact_energy_of(const RunFile& file);

/// Load through softened corners over all load [-]; 0 without a load.
inline double softened_share(const ContactEnergy& e) { return e.load > 0.0 ? e.softened / e.load : 0.0; }

/// What the contacts took and hold: "12 J crushed, 3 J damped, ...".
std::string contact_energy_text(const ContactEnergy& energy);

/// "0.2 % of the load, through corners with less than half the stiffness of their ice".
std::string softened_text(const ContactEnergy& energy);

}  // namespace gem
