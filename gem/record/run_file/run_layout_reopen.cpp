// A run file that a later process goes on with.
#include "gem/field/floe_reserve.h"
#include "gem/record/hdf5/column_file.h"
#include "gem/record/run_file/run_layout.h"
#include "gem/record/run_file/run_layout_parts.h"
#include "gem/record/run_file/verdict_attributes.h"

namespace gem {

using hdf5::check;

namespace {

/// The growing columns of a group, and the width of their rows.
struct Growing {
  std::vector<Column> columns;
  hsize_t width, rows;
};

std::vector<Growing> growing_columns(const std::map<std::string, hsize_t>& size, const FilePosition& from,
                                     const SceneDef& scene) {
  const auto columns_of = [](const auto& entries) {
    std::vector<Column> columns;
    for (const auto& entry : entries) columns.push_back(entry.column);
    return columns;
  };
  std::vector<Growing> groups = {{{floe_time_column()}, 1, from.frames},
                                 {columns_of(floe_columns()), size.at("floe"), from.frames},
                                 {columns_of(platform_columns()), 1, from.platform},
                                 {columns_of(event_columns()), 1, from.events},
                                 {columns_of(stats_columns()), 1, from.stats},
                                 {columns_of(count_columns()), size.at("overlap_class"), from.stats}};
  if (records_sides(scene)) groups.push_back({columns_of(side_columns()), size.at("platform_side"), from.platform});
  for (const PartColumn& part : part_columns(scene))
    groups.push_back({{part.column}, width_of_part(part.column, size), from.platform});
  if (scene.output.contact_forces) groups.push_back({columns_of(contact_columns()), 1, from.contacts});
  if (is_compliant(scene)) {
    groups.push_back({columns_of(compliant_event_columns()), 1, from.events});
    groups.push_back({columns_of(compliant_stats_columns()), 1, from.stats});
  }
  if (records_splits(scene)) {
    groups.push_back({columns_of(crack_columns()), 1, from.stats});
    groups.push_back({columns_of(split_columns()), 1, from.splits});
  }
  return groups;
}

void check_rows(const std::string& path, hsize_t rows, hsize_t needed) {
  if (rows < needed)
    throw hdf5::Failure{path + " has " + std::to_string(rows) + " rows, the checkpoint counts on " +
                        std::to_string(needed)};
}

/// An attribute keeps the size of its first text, so a longer one needs a new attribute.
void replace_text(hid_t file, const char* name, const std::string& text) {
  if (H5Aexists(file, name) > 0) check(H5Adelete(file, name), name);
  hdf5::write_text(file, name, text);
}

}  // namespace

RunLayout::RunLayout(const std::string& path, const SceneDef& scene, const Bodies& bodies, const Provenance& provenance,
                     const FilePosition& from)
    : size_(sizes_of(scene, bodies)),
      chunk_(chunk_shape(size_["floe"])),
      has_contacts_(scene.output.contact_forces),
      has_splits_(records_splits(scene)),
      is_compliant_(is_compliant(scene)),
      has_sides_(records_sides(scene)),
      parts_(part_columns(scene)),
      file_(ColumnFile::reopened(path, size_, chunk_)),
      waiting_(from.waiting),
      written_{from.platform, from.events, from.stats, from.frames, from.contacts, from.splits},
      last_time_(from.last_time),
      saved_time_(from.last_time) {
  const std::vector<Growing> groups = growing_columns(size_, from, scene);
  check_rows("/events/event", file_.open_dimension("/events/event"), from.events);
  if (has_contacts_) check_rows("/contacts/contact", file_.open_dimension("/contacts/contact"), from.contacts);
  if (has_splits_) check_rows("/splits/split", file_.open_dimension("/splits/split"), from.splits);
  for (const Growing& group : groups)
    for (const Column& column : group.columns)
      check_rows(path_of(column), file_.open_column(column, group.width), group.rows);
  file_.cut("/events/event", from.events);
  if (has_contacts_) file_.cut("/contacts/contact", from.contacts);
  if (has_splits_) file_.cut("/splits/split", from.splits);
  for (const Growing& group : groups)
    for (const Column& column : group.columns) file_.cut(path_of(column), group.rows);
  if (has_splits_) write_pieces(pieces_of(bodies, first_piece(bodies, scene)));
  renew_header(provenance);
  file_.flush();  // the file takes its shorter length now, not while others read
  file_.start();
}

void RunLayout::renew_header(const Provenance& provenance) {
  const std::string line = utc_now() + " " + provenance.command_line;
  const std::string history = hdf5::read_text(file_.id(), "history") + "\n" + line;
  if (history.size() <= attribute_limit) replace_text(file_.id(), "history", history);
  replace_text(file_.id(), "gem_engine", provenance.engine);
  replace_text(file_.id(), "gem_threads", std::to_string(provenance.threads));
  replace_text(file_.id(), "gem_device", provenance.device.empty() ? "none" : provenance.device);
  replace_text(file_.id(), "gem_build", build_text());
  hdf5::write_text(file_.id(), "gem_state_hash", "");
  hdf5::write_text(file_.id(), "gem_status", "running");
  reserve_verdict(file_.id());
}

FilePosition RunLayout::position() const {
  return {written_.platform, written_.events, written_.stats, written_.frames,
          written_.contacts, written_.splits, last_time_,     waiting_};
}

}  // namespace gem
