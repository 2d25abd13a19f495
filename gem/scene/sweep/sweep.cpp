// Each draft of a sweep is merged over the rest of the file and read as a scene.
#include "gem/scene/sweep/sweep.h"

#include <algorithm>
#include <optional>
#include <set>

#include "gem/base/error.h"
#include "gem/scene/sweep/member_draws.h"
#include "gem/scene/sweep/sweep_draft.h"
#include "gem/scene/toml/document.h"
#include "gem/scene/toml/scene_tree.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

constexpr std::size_t listed_maximum = 2'000'000;  // about 600 MB in memory

[[noreturn]] void reject_sweep(const TomlPlace& place, const std::string& problem) {
  throw Error(ExitCode::scene_rejected, to_string(place) + ": sweep: " + problem);
}

std::string classes_text(const SceneDef& scene) {
  std::string text = "[";
  for (const IceClassDef& entry : scene.floes.classes) {
    text += text.size() > 1 ? ", {" : "{";
    for (const auto& option : ice_class_options())
      text += (text.back() == '{' ? "" : ", ") + option.path + " = " + value_text(option.get(entry));
    text += "}";
  }
  return text + "]";
}

std::vector<std::string> differences(const SceneDef& base, const SceneDef& scene) {
  std::vector<std::string> out;
  for (const auto& option : scene_options()) {
    const std::string value = value_text(option.get(scene));
    if (option.path != "run.name" && value != value_text(option.get(base))) out.push_back(option.path + "=" + value);
  }
  if (classes_text(scene) != classes_text(base)) out.push_back("ice.class=" + classes_text(scene));
  return out;
}

TomlNode without_sweep(TomlNode document) {
  std::erase_if(document.entries, [](const auto& entry) { return entry.first == "sweep"; });
  return document;
}

/// The case of a draft without its draws.
TomlNode draft_tree(const TomlNode& base, const SweepDraft& draft, const std::vector<std::string>& overrides,
                    const MemberDraws& draws) {
  draws.check_unset(draft.settings);
  TomlNode tree = base;
  merge_toml(tree, draft.settings);
  for (const std::string& text : overrides) {
    const TomlNode settings = without_sweep(parse_override(text));
    draws.check_unset(settings);
    merge_toml(tree, settings);
  }
  return tree;
}

void set_name(TomlNode& tree, const std::string& text, const TomlPlace& place) {
  TomlNode name;
  name.kind = TomlKind::text;
  name.text = text;
  name.place = name.key_place = place;
  merge_toml(tree, nested_toml("run.name", name));
}

/// A drawn value that does not fit the others shows in some of the runs only, so the message names the run.
SceneDef read_member(const TomlNode& tree, const SweepMember& member) {
  if (member.draw.draw == 0) return checked_scene(tree);
  try {
    return checked_scene(tree);
  } catch (const Error& error) {
    throw Error(error.code(), std::string(error.what()) + "\n  in run " + quoted_text(member.name) +
                                  "; narrow the distributions of [sweep.draw] so that every draw is a case");
  }
}

}  // namespace

std::vector<SweepMember> expand_sweep(TomlNode document, const std::vector<std::string>& overrides) {
  apply_overrides(document, overrides);
  const TomlNode* sweep = document.find("sweep");
  if (sweep == nullptr) reject_sweep(document.place, "missing; the file is a single case, not a sweep");
  const TomlNode base = without_sweep(document);
  Problems problems;
  const SceneDef base_scene = scene_from_tree(base, problems);
  problems.throw_if_any();

  const std::vector<SweepDraft> drafts = make_sweep_drafts(*sweep);
  const MemberDraws draws(*sweep, drafts.size());
  const auto check_listed = [sweep](std::size_t bodies) {
    if (bodies > listed_maximum)
      reject_sweep(sweep->key_place, "its runs list too many floes and fixed bodies together (allowed " +
                                         std::to_string(listed_maximum) + "); keep the floes in a file");
  };
  check_listed(drafts.size() * draws.per_draft() * (base_scene.floe.size() + base_scene.fixed.size()));
  std::vector<SweepMember> members;
  std::set<std::string> names;
  std::size_t listed = 0;
  for (const SweepDraft& draft : drafts) {
    const TomlNode undrawn = draft_tree(base, draft, overrides, draws);
    for (std::size_t i = 0; i < draws.per_draft(); ++i) {
      TomlNode tree = undrawn;
      SweepMember member{static_cast<std::int64_t>(members.size()) + 1, draft.name, {}, {}, {}};
      draws.apply(i, member, tree);
      if (!names.insert(member.name).second)
        reject_sweep(sweep->key_place, "two runs have the name " + quoted_text(member.name));
      set_name(tree, member.name, sweep->place);
      member.scene = read_member(tree, member);
      member.differences = differences(base_scene, member.scene);
      listed += member.scene.floe.size() + member.scene.fixed.size();
      check_listed(listed);
      members.push_back(std::move(member));
    }
  }
  return members;
}

bool is_sweep(const std::string& path) { return load_document(path).find("sweep") != nullptr; }

std::vector<SweepMember> expand_sweep(const std::string& path, const std::vector<std::string>& overrides) {
  return expand_sweep(load_document(path), overrides);
}

std::vector<SweepMember> expand_sweep_text(const std::string& text, const std::string& origin,
                                           const std::vector<std::string>& overrides) {
  return expand_sweep(load_text(text, origin), overrides);
}

}  // namespace gem
