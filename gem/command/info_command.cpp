// gem info: what a run file holds.
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "gem/command/verdict_output.h"
#include "gem/record/output/output_claim.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/column_pieces.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/report/contact_energy_record.h"
#include "gem/report/run/line_record.h"
#include "gem/run/checkpoint/checkpoint_path.h"

namespace gem {

namespace {

/// Splits, pieces of those that the case allows, and the energy of the cracks.
void describe_splits(const RunFile& file, nlohmann::ordered_json& object) {
  std::int64_t splits = 0;
  double energy = 0.0;
  for_each_piece(file, {"splits/piece_left", "splits/energy"}, [&](const ColumnPiece& piece) {
    const std::vector<double>& left = piece.values[0];
    for (std::size_t i = 0; i < std::min(left.size(), piece.values[1].size()); ++i) {
      if (!(left[i] > 0.0)) continue;
      ++splits;
      energy += piece.values[1][i];
    }
  });
  const std::int64_t most = stored_scene(file).breakup.maximum_pieces;
  object["floes"] = file.floe_count() - std::min(file.floe_count(), static_cast<std::size_t>(most));  // at the start
  object["splits"] = splits;
  object["pieces"] = std::to_string(2 * splits) + " of " + std::to_string(most) + " allowed" +
                     (2 * splits + 2 > most ? ": the limit is reached, floes stayed whole after that" : "");
  object["crack_energy_J"] = energy;
}

nlohmann::ordered_json describe(const RunFile& file) {
  nlohmann::ordered_json object = {{"file", file.path()}};
  for (const char* name : {"title", "gem_status", "source", "gem_build", "gem_engine", "gem_device", "gem_solver",
                           "gem_seed", "gem_case_sha256", "gem_state_hash", "history"}) {
    object[name] = file.attribute(name);
  }
  object["gem_solver"] = file.solver();
  object["floes"] = file.floe_count();
  if (const std::string reached = file.attribute("gem_concentration"); !reached.empty())
    object["concentration"] = reached;
  object["frames"] = file.rows("floes/time");
  object["platform_samples"] = file.rows("platform/time");
  object["events"] = file.rows("events/time");
  if (file.has("platform/line_break_time"))
    object["broken_lines"] = broken_lines_text(last_break_times(file, stored_scene(file)));
  if (file.has_pieces()) describe_splits(file, object);
  object["overlap_largest_m"] = largest_value(file, "stats/maximum_overlap");
  object["overlap_99_9_m"] = overlaps_of(file, "stats/overlap_count").quantile(0.999);
  object["overlap_largest_share"] = largest_value(file, "stats/maximum_overlap_share");
  object["overlap_99_9_share"] = overlaps_of(file, "stats/overlap_share_count").quantile(0.999);
  if (const auto energy = contact_energy_of(file)) {
    object["contact_energy"] = contact_energy_text(*energy);
    object["softened"] = softened_text(*energy);
  }
  object["verdict"] = grade_name(verdict_of(file).grade);
  object["end_s"] = std::max(last_value(file, "floes/time"), last_value(file, "platform/time"));
  return object;
}

/// Text of several lines, such as the history of a run that went on: later lines begin under the first.
std::string shown_lines(const std::string& text, std::size_t indent) {
  std::string lines;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines += (begin == 0 ? "" : "\n" + std::string(indent, ' ')) + shown(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// Ten digits are enough for people: 306.4, not 306.40000000000003.
std::string value_text(const nlohmann::ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? number_text(value.get<double>(), 10) : value.dump();
}

std::string text_of(const nlohmann::ordered_json& object) {
  std::size_t width = 0;
  for (const auto& entry : object.items()) width = std::max(width, entry.key().size() + 1);
  std::string text;
  for (const auto& [name, value] : object.items())
    text += name + std::string(width - name.size(), ' ') + shown_lines(value_text(value), width) + "\n";
  return text;
}

/// What to do with a run that did not end in order: it was killed, or its machine went down, or the file is a copy of
/// one that is written elsewhere. `held`: a process has the file, so the run may go on.
std::string advice_text(const RunFile& file, bool held) {
  if (held || file.status() != "running") return "";
  const std::string known = "the run has not ended in order, and no program has this file open; ";
  if (has_checkpoint(file.path())) return known + "go on with gem run --continue " + shown(file.path()) + "\n";
  return known + "without a checkpoint beside it, run the case again, or close the file with gem repair\n";
}

}  // namespace

void add_info_command(CLI::App& app, Chosen& chosen) {
  struct Options {
    std::string path;
    bool show_case = false;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("info", "describe a run file");
  command->add_option("file", options->path, "run file")->required()->type_name("RUNFILE");
  command->add_flag("--case", options->show_case, "print the case that was run");
  command->add_flag("--json", options->json, "as JSON");
  command->callback([options, &chosen] {
    chosen.reading = {{options->path}};
    chosen.action = [options] {
      const bool held = is_claimed(options->path);  // before this process holds it too
      const RunFile file(options->path, true);
      if (options->show_case) {
        print(stored_case(file));
        return 0;
      }
      nlohmann::ordered_json object = describe(file);
      const RunVerdict verdict = verdict_of(file);
      if (options->json) {
        object["verdict_criteria"] = criteria_json(verdict);
        print(object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
        return 0;
      }
      print(text_of(object) + reasons_text(verdict, "  ") + advice_text(file, held));
      return 0;
    };
  });
}

}  // namespace gem
