// Contents of a run file: attributes, groups, columns and the rows of slabs.
#include "gem/record/run_layout.h"

#include <algorithm>
#include <ctime>

#include "gem/record/verdict_attributes.h"
#include "gem_version.h"

namespace gem {

using hdf5::check;
using hdf5::checked;
using hdf5::Handle;

namespace {

constexpr std::size_t attribute_limit = 60000;  // the HDF5 1.8 format holds 64 kB per attribute
constexpr std::size_t status_size = 240;        // reserved, so that a later status fits

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// The dimensions that do not grow.
std::map<std::string, hsize_t> sizes_of(const SceneDef& scene, const Bodies& bodies) {
  const auto vertices = [&](std::size_t first, std::size_t end) {
    return first < end ? static_cast<hsize_t>(bodies.vertex_begin[end] - bodies.vertex_begin[first]) : hsize_t{0};
  };
  const std::size_t fixed = first_fixed(bodies);
  const std::size_t floe = first_floe(bodies);
  return {{"floe", bodies.count() - floe},
          {"vertex", vertices(floe, bodies.count())},
          {"xy", 2},
          {"overlap_class", OverlapCount::classes},
          {"boundary", floe - fixed},
          {"boundary_vertex", vertices(fixed, floe)},
          {"platform_vertex", scene.platform.present ? vertices(0, fixed) : 0}};
}

}  // namespace

RunLayout::RunLayout(const std::string& path, const SceneDef& scene, const Bodies& bodies, const Provenance& provenance)
    : size_(sizes_of(scene, bodies)), chunk_(chunk_shape(size_["floe"])), file_(path, size_, chunk_) {
  write_header(scene, bodies, provenance);
  for (const char* name : {"floe", "vertex", "xy", "overlap_class"})
    file_.add_dimension(file_.id(), name, size_[name], false);
  add_group("shape");
  add_group("boundary");
  add_group("floes");
  add_group("platform");
  add_group("events");
  add_group("stats");
  for (const auto& entry : shape_columns(scene)) {
    const std::vector<double> values = entry.values(bodies);
    file_.add_column(entry.column, &values);
  }
  file_.add_column({"floes", "time", "time", Stored::f8, "s", "time since the start of the run", ""}, nullptr);
  for (const auto& entry : floe_columns()) file_.add_column(entry.column, nullptr);
  for (const auto& entry : platform_columns()) file_.add_column(entry.column, nullptr);
  for (const auto& entry : event_columns()) file_.add_column(entry.column, nullptr);
  for (const auto& entry : stats_columns()) file_.add_column(entry.column, nullptr);
  for (const auto& entry : count_columns()) file_.add_column(entry.column, nullptr);
  file_.flush();
}

void RunLayout::write_header(const SceneDef& scene, const Bodies& bodies, const Provenance& provenance) {
  hdf5::write_text(file_.id(), "Conventions", "CF-1.10");
  hdf5::write_text(file_.id(), "title", provenance.title);
  hdf5::write_text(file_.id(), "source", "gem " GEM_VERSION " (" GEM_COMMIT ")");
  hdf5::write_text(file_.id(), "history", utc_now() + " " + provenance.command_line);
  hdf5::write_text(file_.id(), "gem_schema", schema_version);
  hdf5::write_text(file_.id(), "gem_status", "running", status_size);
  hdf5::write_text(file_.id(), "gem_state_hash", "", 16);
  hdf5::write_text(file_.id(), "gem_case_sha256", provenance.case_sha256);
  hdf5::write_text(file_.id(), "gem_seed", std::to_string(scene.run.seed));
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
  hdf5::write_numbers(file_.id(), "gem_first_floe_body", H5T_STD_I32LE, {double(first_floe(bodies))});
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
  if (group == "boundary") {
    file_.add_dimension(id, "boundary", size_["boundary"], false);
    file_.add_dimension(id, "boundary_vertex", size_["boundary_vertex"], false);
  }
  if (group == "shape") file_.add_dimension(id, "platform_vertex", size_["platform_vertex"], false);
}

template <class Row>
void RunLayout::append_rows(const std::vector<RowColumn<Row>>& columns, std::vector<Row>& rows, std::size_t count) {
  std::vector<double> values(count);
  const auto end = rows.begin() + std::ptrdiff_t(count);
  for (const auto& entry : columns) {
    std::transform(rows.begin(), end, values.begin(), entry.value);
    file_.append("/" + entry.column.group + "/" + entry.column.name, values, count);
  }
  rows.erase(rows.begin(), end);
  any_written_ = any_written_ || count > 0;
}

void RunLayout::append_stats(std::size_t count) {
  for (const auto& entry : count_columns()) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i)
      for (const std::int64_t n : (waiting_.stats[i].*(entry.counts)).count) values.push_back(double(n));
    file_.append("/stats/" + entry.column.name, values, count);
  }
  append_rows(stats_columns(), waiting_.stats, count);
}

void RunLayout::append_events(std::size_t count) {
  append_rows(event_columns(), waiting_.events, count);
  file_.append("/events/event", std::vector<double>{}, count);
}

void RunLayout::append_frames(std::size_t count) {
  if (count == 0) return;
  FloeFrames& floes = waiting_.floes;
  for (const auto& entry : floe_columns()) {
    std::vector<float>& all = floes.*(entry.values);
    const auto end = all.begin() + std::ptrdiff_t(count * size_.at("floe"));
    file_.append("/floes/" + entry.column.name, std::vector<float>(all.begin(), end), count);
    all.erase(all.begin(), end);
  }
  const auto end = floes.time.begin() + std::ptrdiff_t(count);
  file_.append("/floes/time", std::vector<double>(floes.time.begin(), end), count);
  saved_time_ = floes.time[count - 1];
  floes.time.erase(floes.time.begin(), end);
  any_written_ = true;
}

void RunLayout::append(Slab slab) {
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(waiting_.platform, slab.platform);
  add(waiting_.events, slab.events);
  add(waiting_.stats, slab.stats);
  add(waiting_.floes.time, slab.floes.time);
  for (const auto& entry : floe_columns()) add(waiting_.floes.*(entry.values), slab.floes.*(entry.values));

  const auto whole = [](std::size_t rows, hsize_t chunk) { return rows - rows % chunk; };
  append_rows(platform_columns(), waiting_.platform, whole(waiting_.platform.size(), chunk_.rows));
  append_events(whole(waiting_.events.size(), chunk_.rows));
  append_stats(whole(waiting_.stats.size(), chunk_.frames));
  append_frames(whole(waiting_.floes.time.size(), chunk_.frames));
}

void RunLayout::append_rest() {
  append_rows(platform_columns(), waiting_.platform, waiting_.platform.size());
  append_events(waiting_.events.size());
  append_stats(waiting_.stats.size());
  append_frames(waiting_.floes.time.size());
}

void RunLayout::set_text(const char* attribute, const std::string& text) {
  hdf5::write_text(file_.id(), attribute, text);
}

void RunLayout::set_verdict(const RunVerdict& verdict) { write_verdict(file_.id(), verdict); }

}  // namespace gem
