// The summary of a run, for people and as JSON.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "gem/command/verdict_output.h"
#include "gem/record/run_file/run_writer.h"
#include "gem/report/contact_energy_record.h"
#include "gem/report/run/line_record.h"

namespace gem {
namespace {

std::string measured_text(double value, const char* unit) {
  return std::isnan(value) ? "not measured" : number_text(value, 3) + unit;
}

/// Bound on 99.9 % of the overlaps. The quantile is the upper edge of a histogram bin and may exceed the largest
/// overlap.
double most_overlap(const RunSummary& s) { return std::min(s.overlap.quantile(0.999), s.worst.maximum_overlap); }
double most_share(const RunSummary& s) { return std::min(s.overlap_share.quantile(0.999), s.worst.maximum_share); }

std::string line(const std::string& name, const std::string& value) {
  return "  " + name + std::string(name.size() < 22 ? 22 - name.size() : 1, ' ') + value + "\n";
}

/// How the contacts were resolved by iterations.
std::string iteration_lines(const RunSummary& s) {
  const std::string asked =
      std::isnan(s.asked_residual) ? "" : ", " + number_text(1e3 * s.asked_residual, 3) + " mm/s asked for";
  return line("largest residual", number_text(1e3 * s.worst.residual, 3) + " mm/s left at a contact" + asked) +
         line("complementarity", measured_text(s.worst.complementarity, " m/s")) +
         line("friction cone", measured_text(s.worst.cone_excess, " N s beyond")) +
         line("energy created", measured_text(s.worst.energy_created, " J"));
}

std::string compliant_lines(const RunSummary& s) {
  return line("contact energy", contact_energy_text(s.contact)) + line("softened", softened_text(s.contact));
}

/// In place of what iterations leave.
void add_compliant(const RunSummary& s, nlohmann::ordered_json& object) {
  for (const char* key : {"iterations", "steps_at_iteration_limit", "closing_residual_m_per_s",
                          "complementarity_m_per_s", "cone_excess_N_s", "energy_created_J"})
    object.erase(key);
  object["substeps"] = s.worst.iterations;
  object["contact_crushed_J"] = s.contact.crushed;
  object["contact_damped_J"] = s.contact.damped;
  object["contact_friction_J"] = s.contact.friction;
  object["contact_stored_J"] = s.contact.stored;
  object["contact_left_J"] = s.contact.left();
  object["softened_share"] = softened_share(s.contact);
}

}  // namespace

std::string summary_text(const RunSummary& s) {
  std::string text = s.status + (s.file.empty() ? "" : ": " + s.file) + "\n";
  text += line("engine", s.engine);
  text += line("simulated", number_text(s.time, 10) + " s in " + std::to_string(s.steps) + " time steps");
  text += line("wall time", fixed_text(s.wall_time, 2) + " s, " + rate_text(s.sim_rate) + " x real time");
  text += line("recorded", std::to_string(s.frames) + " floe frames, " + std::to_string(s.events) + " events");
  text += line("active floes", fixed_text(s.active_floes, 0));
  if (!s.line_break_times.empty()) text += line("broken mooring lines", broken_lines_text(s.line_break_times));
  text += line("most contacts", std::to_string(s.worst.contacts));
  text += s.compliant ? line("substeps", std::to_string(s.worst.iterations) + " of a time step")
                      : line("most iterations", std::to_string(s.worst.iterations) + ", limit reached in " +
                                                    std::to_string(s.at_limit) + " of " + std::to_string(s.steps) +
                                                    " time steps");
  text += line("largest overlap", number_text(s.worst.maximum_overlap, 3) + " m" +
                                      (s.compliant ? " beyond crushed ice, " : ", ") +
                                      number_text(100.0 * s.worst.maximum_share, 3) + " % of the smaller body");
  text += line("99.9 % of overlaps",
               "below " + number_text(most_overlap(s), 3) + " m, " + number_text(100.0 * most_share(s), 3) + " %");
  text += s.compliant ? compliant_lines(s) : iteration_lines(s);
  text += line("momentum residual", number_text(s.residual.momentum, 3));
  text += line("angular residual", number_text(s.residual.angular_momentum, 3));
  text += line("energy residual", number_text(s.residual.energy, 3));
  text += line("peak memory", size_text(s.peak_memory));
  text += line("state hash", hash_text(s.state_hash));
  text += line("verdict", grade_name(s.verdict.grade)) + reasons_text(s.verdict, "    ");
  return text;
}

std::string summary_json(const RunSummary& s) {
  nlohmann::ordered_json object = {{"status", s.status},
                                   {"file", s.file},
                                   {"engine", s.engine},
                                   {"time_s", s.time},
                                   {"steps", s.steps},
                                   {"wall_time_s", s.wall_time},
                                   {"sim_rate", s.sim_rate},
                                   {"frames", s.frames},
                                   {"events", s.events},
                                   {"active_floes", s.active_floes},
                                   {"contacts", s.worst.contacts},
                                   {"iterations", s.worst.iterations},
                                   {"steps_at_iteration_limit", s.at_limit},
                                   {"maximum_overlap_m", s.worst.maximum_overlap},
                                   {"maximum_overlap_share", s.worst.maximum_share},
                                   {"overlap_99_9_m", most_overlap(s)},
                                   {"overlap_99_9_share", most_share(s)},
                                   {"closing_residual_m_per_s", s.worst.residual},
                                   {"complementarity_m_per_s", s.worst.complementarity},
                                   {"cone_excess_N_s", s.worst.cone_excess},
                                   {"energy_created_J", s.worst.energy_created},
                                   {"residual_momentum", s.residual.momentum},
                                   {"residual_angular_momentum", s.residual.angular_momentum},
                                   {"residual_energy", s.residual.energy},
                                   {"peak_memory_bytes", s.peak_memory},
                                   {"state_hash", hash_text(s.state_hash)},
                                   {"verdict", grade_name(s.verdict.grade)},
                                   {"verdict_criteria", criteria_json(s.verdict)}};
  if (s.compliant) add_compliant(s, object);
  if (!s.line_break_times.empty()) object["line_break_times_s"] = s.line_break_times;
  return object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace gem
