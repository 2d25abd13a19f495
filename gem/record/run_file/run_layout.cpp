// Contents of a run file: attributes, groups, columns and the rows of slabs.
#include "gem/record/run_file/run_layout.h"

#include <algorithm>
#include <ctime>

#include "gem/field/floe_reserve.h"
#include "gem/field/reached_concentration.h"
#include "gem/record/run_file/run_layout_parts.h"
#include "gem/record/run_file/verdict_attributes.h"
#include "gem_version.h"

namespace gem {

using hdf5::check;
using hdf5::checked;
using hdf5::Handle;

namespace {

constexpr std::size_t status_size = 240;  // reserved, so that a later status fits

}  // namespace

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::map<std::string, hsize_t> sizes_of(const SceneDef& scene, const Bodies& bodies) {
  const auto vertices = [&](std::size_t first, std::size_t end) {
    return first < end ? static_cast<hsize_t>(bodies.vertex_begin[end] - bodies.vertex_begin[first]) : hsize_t{0};
  };
  const std::size_t fixed = first_fixed(bodies);
  const std::size_t floe = first_floe(bodies);
  return {{"floe", bodies.count() - floe},
          {"vertex", vertices(floe, first_piece(bodies, scene)) + piece_corners_maximum(scene)},
          {"xy", 2},
          {"overlap_class", OverlapCount::classes},
          {"boundary", floe - fixed},
          {"boundary_vertex", vertices(fixed, floe)},
          {"platform_vertex", scene.platform.present ? vertices(0, fixed) : 0},
          {"platform_piece", has_pieces(scene) ? hsize_t(platform_bodies(bodies)) : 0},
          {"platform_side", scene.platform.present ? vertices(0, fixed) : 0},
          {"mooring_line", scene.mooring_design.lines.size()},
          {"thruster", scene.dp.thruster.size()}};
}

bool is_by(const Column& column, const std::string& dimension) { return column.dimensions == "time " + dimension; }

hsize_t RunLayout::width_of(const Column& column) const { return width_of_part(column, size_); }

hsize_t width_of_part(const Column& column, const std::map<std::string, hsize_t>& size) {
  for (const char* name : {"mooring_line", "thruster"})
    if (is_by(column, name)) return size.at(name);
  return 1;
}

bool records_sides(const SceneDef& scene) { return scene.output.side_loads && scene.platform.present; }

Column floe_time_column() { return {"floes", "time", "time", Stored::f8, "s", "time since the start of the run", ""}; }

RunLayout::RunLayout(const std::string& path, const SceneDef& scene, const Bodies& bodies, const Provenance& provenance)
    : size_(sizes_of(scene, bodies)),
      chunk_(chunk_shape(size_["floe"])),
      has_contacts_(scene.output.contact_forces),
      has_splits_(records_splits(scene)),
      is_compliant_(is_compliant(scene)),
      has_sides_(records_sides(scene)),
      parts_(part_columns(scene)),
      file_(path, size_, chunk_) {
  write_header(scene, bodies, provenance);
  for (const char* name : {"floe", "vertex", "xy", "overlap_class"})
    file_.add_dimension(file_.id(), name, size_[name], false);
  // not in /platform: there it would count as a column with rows
  if (has_sides_) file_.add_dimension(file_.id(), "platform_side", size_["platform_side"], false);
  for (const char* name : {"mooring_line", "thruster"})
    if (std::any_of(parts_.begin(), parts_.end(), [&](const auto& part) { return is_by(part.column, name); }))
      file_.add_dimension(file_.id(), name, size_[name], false);
  add_group("shape");
  add_group("boundary");
  add_group("floes");
  add_group("platform");
  add_group("events");
  add_group("stats");
  if (has_contacts_) add_group("contacts");
  if (has_splits_) add_group("splits");
  for (const auto& entry : shape_columns(scene)) {
    std::vector<double> values = entry.values(bodies);
    if (entry.column.dimensions == "vertex xy") values.resize(2 * size_["vertex"]);  // room for pieces
    file_.add_column(entry.column, &values);
  }
  file_.add_column(floe_time_column(), nullptr);
  for (const auto& entry : floe_columns()) file_.add_column(entry.column, nullptr);
  for (const auto& entry : platform_columns()) file_.add_column(entry.column, nullptr);
  if (has_sides_)
    for (const auto& entry : side_columns()) file_.add_column(entry.column, nullptr);
  for (const auto& entry : parts_) file_.add_column(entry.column, nullptr);
  for (const auto& entry : event_columns()) file_.add_column(entry.column, nullptr);
  for (const auto& entry : stats_columns()) file_.add_column(entry.column, nullptr);
  for (const auto& entry : count_columns()) file_.add_column(entry.column, nullptr);
  if (is_compliant_) {
    for (const auto& entry : compliant_event_columns()) file_.add_column(entry.column, nullptr);
    for (const auto& entry : compliant_stats_columns()) file_.add_column(entry.column, nullptr);
  }
  if (has_contacts_)
    for (const auto& entry : contact_columns()) file_.add_column(entry.column, nullptr);
  if (has_splits_) {
    for (const auto& entry : crack_columns()) file_.add_column(entry.column, nullptr);
    for (const auto& entry : split_columns()) file_.add_column(entry.column, nullptr);
  }
  file_.start();
}

void RunLayout::write_header(const SceneDef& scene, const Bodies& bodies, const Provenance& provenance) {
  hdf5::write_text(file_.id(), "Conventions", "CF-1.10");
  hdf5::write_text(file_.id(), "title", provenance.title);
  hdf5::write_text(file_.id(), "source", "gem " GEM_VERSION " (" GEM_COMMIT ")");
  hdf5::write_text(file_.id(), "history", utc_now() + " " + provenance.command_line);
  hdf5::write_text(file_.id(), "gem_schema", schema_version);
  hdf5::write_text(file_.id(), "gem_status", "running", status_size);
  hdf5::write_text(file_.id(), "gem_state_hash", "", 16);
  reserve_verdict(file_.id());
  hdf5::write_text(file_.id(), "gem_case_sha256", provenance.case_sha256);
  hdf5::write_text(file_.id(), "gem_seed", std::to_string(scene.run.seed));
  if (scene.floes.concentration > 0.0)
    hdf5::write_text(file_.id(), "gem_concentration", concentration_text(reached_concentration(scene, bodies)));
  hdf5::write_text(file_.id(), "gem_engine", provenance.engine);
  hdf5::write_text(file_.id(), "gem_solver", provenance.solver);
  hdf5::write_text(file_.id(), "gem_threads", std::to_string(provenance.threads));
  hdf5::write_text(file_.id(), "gem_device", provenance.device.empty() ? "none" : provenance.device);
  hdf5::write_text(file_.id(), "gem_arithmetic", provenance.arithmetic);
  hdf5::write_text(file_.id(), "gem_build", build_text());
  hdf5::write_text(file_.id(), "gem_platform", scene.platform.present ? "present" : "absent");
  hdf5::write_text(
      file_.id(), "gem_signs",
      "forces and impulses in /platform act on the platform; impulses in /events act on the ice, along the "
      "normal that points from the platform into the ice; angles are counter-clockwise");
  hdf5::write_numbers(file_.id(), "gem_first_floe_body", H5T_STD_I32LE,
                      {double(recorded_body(bodies, std::int32_t(first_floe(bodies))))});
  hdf5::write_numbers(file_.id(), "gem_force_window_s", H5T_IEEE_F64LE, {scene.output.force_window_s});
  if (provenance.case_toml.size() <= attribute_limit) {
    hdf5::write_text(file_.id(), "gem_case_toml", provenance.case_toml);
    return;
  }
  hdf5::write_text(file_.id(), "gem_case_toml", "in dataset /gem_case_toml");
  const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, "case type");
  check(H5Tset_size(type, H5T_VARIABLE), "case type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "case type");
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, "case space");
  const Handle dataset = checked(
      H5Dcreate2(file_.id(), "gem_case_toml", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose, "case");
  const char* text = provenance.case_toml.c_str();
  check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &text), "case");
}

void RunLayout::add_group(const std::string& group) {
  const hdf5::Handle id = file_.add_group(group);
  if (group == "events") file_.add_dimension(id, "event", 0, true);
  if (group == "contacts") file_.add_dimension(id, "contact", 0, true);
  if (group == "splits") file_.add_dimension(id, "split", 0, true);
  if (group == "boundary") {
    file_.add_dimension(id, "boundary", size_["boundary"], false);
    file_.add_dimension(id, "boundary_vertex", size_["boundary_vertex"], false);
  }
  if (group == "shape") {
    file_.add_dimension(id, "platform_vertex", size_["platform_vertex"], false);
    if (size_["platform_piece"] > 0) file_.add_dimension(id, "platform_piece", size_["platform_piece"], false);
  }
}

template <class Row>
void RunLayout::append_rows(const std::vector<RowColumn<Row>>& columns, const std::vector<Row>& rows, std::size_t count,
                            Rows kind) {
  std::vector<double> values(count);
  for (const auto& entry : columns) {
    std::transform(rows.begin(), rows.begin() + std::ptrdiff_t(count), values.begin(), entry.value);
    file_.append(path_of(entry.column), values, count, kind);
  }
}

/// The first `rows` rows of `width` values each.
template <class Number>
std::vector<Number> first_rows(const std::vector<Number>& all, std::size_t rows, hsize_t width) {
  return {all.begin(), all.begin() + std::ptrdiff_t(rows * width)};
}

void RunLayout::append_platform(std::size_t count, Rows kind) {
  append_rows(platform_columns(), waiting_.platform, count, kind);
  for (const auto& entry : parts_)
    file_.append(path_of(entry.column), first_rows(waiting_.*(entry.values), count, width_of(entry.column)), count,
                 kind);
  if (!has_sides_) return;
  for (const auto& entry : side_columns())
    file_.append(path_of(entry.column), first_rows(waiting_.*(entry.values), count, size_.at("platform_side")), count,
                 kind);
}

void RunLayout::append_stats(std::size_t count, Rows kind) {
  for (const auto& entry : count_columns()) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i)
      for (const std::int64_t n : (waiting_.stats[i].*(entry.counts)).count) values.push_back(double(n));
    file_.append("/stats/" + entry.column.name, values, count, kind);
  }
  append_rows(stats_columns(), waiting_.stats, count, kind);
  if (is_compliant_) append_rows(compliant_stats_columns(), waiting_.stats, count, kind);
  if (has_splits_) append_rows(crack_columns(), waiting_.stats, count, kind);
}

void RunLayout::append_events(std::size_t count, Rows kind) {
  append_rows(event_columns(), waiting_.events, count, kind);
  if (is_compliant_) append_rows(compliant_event_columns(), waiting_.events, count, kind);
  file_.append("/events/event", std::vector<double>{}, count, kind);
}

void RunLayout::append_contacts(std::size_t count, Rows kind) {
  if (!has_contacts_) return;
  append_rows(contact_columns(), waiting_.contacts, count, kind);
  file_.append("/contacts/contact", std::vector<double>{}, count, kind);
}

void RunLayout::append_splits(std::size_t count, Rows kind) {
  if (!has_splits_) return;
  append_rows(split_columns(), waiting_.splits, count, kind);
  file_.append("/splits/split", std::vector<double>{}, count, kind);
}

/// Fills the free rows of /shape. A run that goes on from a checkpoint fills them anew.
void RunLayout::write_pieces(const PieceShapes& pieces) {
  if (pieces.vertex_count.empty()) return;
  file_.overwrite("/shape/vertex_xy", pieces.vertex_xy, pieces.first_vertex, 2);
  for (const auto& [name, values] : pieces.columns()) file_.overwrite("/shape/" + name, *values, pieces.first_floe, 1);
}

void RunLayout::append_frames(std::size_t count, Rows kind) {
  const FloeFrames& floes = waiting_.floes;
  for (const auto& entry : floe_columns())
    file_.append("/floes/" + entry.column.name, first_rows(floes.*(entry.values), count, size_.at("floe")), count,
                 kind);
  file_.append("/floes/time", std::vector<double>(floes.time.begin(), floes.time.begin() + std::ptrdiff_t(count)),
               count, kind);
}

void RunLayout::append_waiting(const RowCount& count, Rows kind) {
  append_platform(count.platform, kind);
  append_events(count.events, kind);
  append_stats(count.stats, kind);
  append_contacts(count.contacts, kind);
  append_splits(count.splits, kind);
  append_frames(count.frames, kind);
}

RowCount RunLayout::waiting() const {
  return {waiting_.platform.size(),   waiting_.events.size(),   waiting_.stats.size(),
          waiting_.floes.time.size(), waiting_.contacts.size(), waiting_.splits.size()};
}

void RunLayout::drop_waiting(const RowCount& count) {
  const auto drop = [](auto& rows, std::size_t n) { rows.erase(rows.begin(), rows.begin() + std::ptrdiff_t(n)); };
  FloeFrames& floes = waiting_.floes;
  if (count.frames > 0) last_time_ = floes.time[count.frames - 1];
  drop(waiting_.platform, count.platform);
  if (has_sides_)
    for (const auto& entry : side_columns()) drop(waiting_.*(entry.values), count.platform * size_.at("platform_side"));
  for (const auto& entry : parts_) drop(waiting_.*(entry.values), count.platform * width_of(entry.column));
  drop(waiting_.events, count.events);
  drop(waiting_.stats, count.stats);
  drop(waiting_.contacts, count.contacts);
  drop(waiting_.splits, count.splits);
  drop(floes.time, count.frames);
  for (const auto& entry : floe_columns()) drop(floes.*(entry.values), count.frames * size_.at("floe"));
  written_.platform += count.platform;
  written_.events += count.events;
  written_.stats += count.stats;
  written_.frames += count.frames;
  written_.contacts += count.contacts;
  written_.splits += count.splits;
}

void RunLayout::append(Slab slab) {
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(waiting_.platform, slab.platform);
  for (const auto& entry : side_columns()) add(waiting_.*(entry.values), slab.*(entry.values));
  for (const auto& entry : parts_) add(waiting_.*(entry.values), slab.*(entry.values));
  add(waiting_.events, slab.events);
  add(waiting_.stats, slab.stats);
  add(waiting_.contacts, slab.contacts);
  add(waiting_.splits, slab.splits);
  write_pieces(slab.pieces);
  add(waiting_.floes.time, slab.floes.time);
  for (const auto& entry : floe_columns()) add(waiting_.floes.*(entry.values), slab.floes.*(entry.values));

  const auto whole = [](std::size_t rows, hsize_t chunk) { return rows - rows % chunk; };
  const RowCount all = waiting();
  const RowCount full = {whole(all.platform, chunk_.rows), whole(all.events, chunk_.rows),
                         whole(all.stats, chunk_.frames),  whole(all.frames, chunk_.frames),
                         whole(all.contacts, chunk_.rows), whole(all.splits, chunk_.rows)};
  append_waiting(full, Rows::whole);
  drop_waiting(full);
}

void RunLayout::append_rest() {
  const RowCount rest = waiting();
  append_waiting(rest, Rows::last);
  drop_waiting(rest);
}

void RunLayout::flush(const std::function<void()>& sync) {
  const RowCount rest = waiting();
  append_waiting(rest, Rows::part);
  sync();
  file_.flush();
  sync();
  visible_ = {written_.platform + rest.platform, written_.events + rest.events,     written_.stats + rest.stats,
              written_.frames + rest.frames,     written_.contacts + rest.contacts, written_.splits + rest.splits};
  saved_time_ = rest.frames > 0 ? waiting_.floes.time.back() : last_time_;
}

std::uint64_t RunLayout::room_for(const Slab& slab) const {
  const RowCount now = waiting();
  const auto rows_of = [&](const std::string& group) {
    if (group == "platform") return now.platform + slab.platform.size();
    if (group == "events") return now.events + slab.events.size();
    if (group == "contacts") return now.contacts + slab.contacts.size();
    if (group == "splits") return now.splits + slab.splits.size();
    if (group == "stats") return now.stats + slab.stats.size();
    return now.frames + slab.floes.time.size();
  };
  std::uint64_t bytes = 0;
  for (const std::string& path : file_.growing()) {
    const std::string group = path.substr(1, path.find('/', 1) - 1);
    bytes += file_.room_for(path, rows_of(group));
  }
  return bytes;
}

namespace {

void write_end(hid_t file, const std::string& status, std::uint64_t state_hash, const RunVerdict& verdict) {
  hdf5::write_text(file, "gem_state_hash", hash_text(state_hash));
  if (!verdict.judgements.empty()) write_verdict(file, verdict);
  check(H5Fflush(file, H5F_SCOPE_GLOBAL), "cannot flush");  // whoever finds the status finds the rest
  hdf5::write_text(file, "gem_status", status);
}

}  // namespace

void RunLayout::set_end(const std::string& status, std::uint64_t state_hash, const RunVerdict& verdict) {
  write_end(file_.id(), status, state_hash, verdict);
  file_.flush();
}

void set_end_of_broken(const std::string& path, const std::string& status, std::uint64_t state_hash,
                       const RunVerdict& verdict) {
  Handle file = hdf5::open_left_file(path);
  write_end(file, status, state_hash, verdict);
  if (!file.close()) throw hdf5::Failure{"cannot close: " + hdf5::last_reason()};
}

}  // namespace gem
