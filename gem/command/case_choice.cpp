// What several commands share: the choice of a case, and writing to standard output.
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <map>
#include <system_error>
#include <tuple>
#include <utility>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "gem/field/files/floe_file.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/run_start.h"
#include "gem/scene/check_scene.h"
#include "gem/scene/sweep/sweep.h"
#include "gem/scene/toml/document.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {

CLI::Validator not_empty() {
  return {[](const std::string& text) {
            return text.empty() ? std::string("it is empty; give a name or leave the option out") : std::string();
          },
          ""};
}

void add_case_options(CLI::App& command, CaseChoice& choice, bool required) {
  auto* path = command.add_option("case", choice.path, "case file (TOML); default: the built-in case");
  if (required) path->required();
  command.add_option("--set", choice.overrides, "override an option: key.path=value, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--index", choice.index, "number of a run in a sweep file, see `gem sweep list`")->type_name("N");
}

SceneDef read_case(const CaseChoice& choice) {
  if (choice.path.empty()) {
    if (choice.index) throw Error(ExitCode::usage, "--index needs a sweep file (no file was given); name one");
    return begun_from(choice, parse_scene("", "built-in case", choice.overrides));
  }
  TomlNode document = load_document(choice.path);
  if (document.entries.empty())
    throw Error(ExitCode::scene_rejected,
                shown(choice.path) + ": no settings (the file is empty); give it keys; `gem case explain` lists them");
  if (document.find("sweep") == nullptr) {
    if (choice.index) {
      throw Error(ExitCode::usage, choice.path + " is a single case (no [sweep] table); leave out --index");
    }
    return begun_from(choice, scene_of(std::move(document), choice.overrides));
  }
  const std::vector<SweepMember> members = expand_sweep(std::move(document), choice.overrides);
  for (const SweepMember& member : members) {
    if (member.index == choice.index) return begun_from(choice, member.scene);
  }
  const std::string range =
      members.empty() ? "none" : std::to_string(members.front().index) + " to " + std::to_string(members.back().index);
  if (!choice.index) {
    throw Error(ExitCode::usage, choice.path + " is a sweep (runs " + range + "); choose one with --index");
  }
  throw Error(ExitCode::usage, "no run " + std::to_string(*choice.index) + " in " + choice.path + " (runs " + range +
                                   "); see `gem sweep list`");
}

SceneDef named_floes(SceneDef scene) {
  if (scene.floes.source != FloeSource::file) return scene;
  std::string& path = scene.floes.path;
  std::error_code fault;
  const std::filesystem::path absolute = std::filesystem::absolute(path, fault);
  if (!fault) path = absolute.lexically_normal().string();
  if (scene.floes.time_s != 0.0 && !is_run_file(path))
    throw Error(ExitCode::scene_rejected, "floes.time_s: has no effect (value " + number_text(scene.floes.time_s) +
                                              ", " + shown(path) + " is not a run file); remove it or name a run file");
  if (scene.floes.concave != ConcaveFloes::refuse && is_run_file(path))
    throw Error(ExitCode::scene_rejected, "floes.concave: has no effect (" + shown(path) +
                                              " is a run file, whose floes are convex); remove it or name a floe file");
  if (is_run_file(path)) tried_in_child({{path}}, [&] { floes_of_run_file(path, scene.floes.time_s); });
  const std::vector<FloeDef> floes = is_run_file(path) ? floes_of_run_file(path, scene.floes.time_s).floes
                                                       : read_floe_file(path, scene.floes.concave).floes;
  check_same_floes(scene, floes);
  scene.floes.sha256 = floes_sha256(floes);
  return scene;
}

std::vector<SweepMember> read_sweep(const std::string& path, const std::vector<std::string>& overrides) {
  std::vector<SweepMember> members = expand_sweep(path, overrides);
  std::map<std::tuple<std::string, double, std::string>, FloesDef> known;  // a sweep names few files in many members
  for (SweepMember& member : members) {
    FloesDef& floes = member.scene.floes;
    if (floes.source != FloeSource::file) continue;
    const auto [entry, is_new] = known.try_emplace({floes.path, floes.time_s, floes.sha256});
    if (is_new) entry->second = named_floes(member.scene).floes;
    floes.path = entry->second.path;
    floes.sha256 = entry->second.sha256;
  }
  return members;
}

SceneDef with_floes_of_run_file(const SceneDef& scene) {
  if (scene.floes.source != FloeSource::file || !is_run_file(scene.floes.path)) return scene;
  FloesStart start = floes_of_run_file(scene.floes.path, scene.floes.time_s);
  check_same_floes(scene, start.floes);
  if (start.floes.empty())
    throw Error(ExitCode::scene_rejected,
                scene.floes.path + ": no floes (the run had none); name another file or set floes.source = \"listed\"");
  SceneDef listed = with_listed_floes(scene, std::move(start.floes));
  listed.floes.overlap = start.overlap;
  return listed;
}

std::string run_file_name(const std::string& run_name) {
  std::string name = run_name.empty() ? "run" : run_name;
  for (char& c : name) c = c == '/' ? '_' : c;
  return name + ".h5";
}

ProgressMode progress_mode(const std::string& name) {
  if (name == "none") return ProgressMode::none;
  if (name == "line") return ProgressMode::line;
  return name == "json" ? ProgressMode::json : ProgressMode::automatic;
}

namespace {

/// Writes to standard output. Returns the number of the fault, 0 if there was none.
int written(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const auto part = ::write(STDOUT_FILENO, text.data() + done, text.size() - done);
    if (part > 0)
      done += static_cast<std::size_t>(part);
    else if (errno != EINTR)
      return errno;
  }
  return 0;
}

void refuse_output(int fault) {
  if (fault == 0) return;
  const std::string why = fault == EBADF   ? "it is closed"
                          : fault == EPIPE ? "its reader has gone"
                                           : std::generic_category().message(fault);
  throw Error(ExitCode::file_system, "cannot write to standard output (" + why + "); check where it goes");
}

}  // namespace

void print(const std::string& text) {
  const int fault = written(text);
  if (fault != EPIPE) refuse_output(fault);
}

void print_about_file(const std::string& text) {
  const int fault = written(text);
  if (fault != EPIPE && fault != EBADF) refuse_output(fault);
}

void print_needed(const std::string& text) { refuse_output(written(text)); }

}  // namespace gem
