// Creates the groups, dimension scales and datasets of a run file and appends slabs to them.
#include "gem/record/run_layout.h"

#include <hdf5_hl.h>

#include <algorithm>
#include <cstring>
#include <ctime>
#include <sstream>

#include "gem_version.h"

namespace gem {

using hdf5::check;
using hdf5::checked;
using hdf5::Handle;

namespace {

// 131 kB per chunk of floe frames. Few frames per chunk: only whole chunks are safe from a kill.
constexpr hsize_t frames_per_chunk = 16;
constexpr hsize_t floes_per_chunk = 2048;
constexpr hsize_t rows_per_chunk = 1024;
constexpr std::size_t attribute_limit = 60000;  // the HDF5 1.8 format holds 64 kB per attribute
constexpr std::size_t status_size = 240;        // reserved, so that a later status fits in place

hid_t file_type(Stored stored) {
  switch (stored) {
    case Stored::f8:
      return H5T_IEEE_F64LE;
    case Stored::f4:
      return H5T_IEEE_F32LE;
    case Stored::i4:
      return H5T_STD_I32LE;
    case Stored::u1:
      return H5T_STD_U8LE;
  }
  return H5T_IEEE_F64LE;
}

hid_t memory_type(double) { return H5T_NATIVE_DOUBLE; }
hid_t memory_type(float) { return H5T_NATIVE_FLOAT; }

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> list;
  for (std::string word; stream >> word;) list.push_back(word);
  return list;
}

bool grows(const std::string& dimension) { return dimension == "time" || dimension == "event"; }

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace

RunLayout::RunLayout(const std::string& path, bool overwrite, const SceneDef& scene, const Bodies& bodies,
                     const Provenance& provenance) {
  create_file(path, overwrite);
  measure(scene, bodies);
  write_header(scene, bodies, provenance);
  for (const char* name : {"floe", "vertex", "xy", "overlap_class"}) add_dimension(file_, name, size_[name], false);
  add_group("shape", nullptr);
  add_group("boundary", nullptr);
  add_group("floes", "time");
  add_group("platform", "time");
  add_group("events", "event");
  add_group("stats", "time");
  for (const auto& entry : shape_columns(scene)) {
    const std::vector<double> values = entry.values(bodies);
    add_column(entry.column, &values);
  }
  add_column({"floes", "time", "time", Stored::f8, "s", "time since the start of the run", ""}, nullptr);
  for (const auto& entry : floe_columns()) add_column(entry.column, nullptr);
  for (const auto& entry : platform_columns()) add_column(entry.column, nullptr);
  for (const auto& entry : event_columns()) add_column(entry.column, nullptr);
  for (const auto& entry : stats_columns()) add_column(entry.column, nullptr);
  for (const auto& entry : count_columns()) add_column(entry.column, nullptr);
  flush();
}

void RunLayout::create_file(const std::string& path, bool overwrite) {
  const Handle access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  check(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18), "file format");
  check(H5Pset_file_locking(access, true, true), "file locking");
  // the index of the file goes to disk when it is flushed and at no other time
  H5AC_cache_config_t cache{};
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  check(H5Pget_mdc_config(access, &cache), "index cache");
  cache.evictions_enabled = false;
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  check(H5Pset_mdc_config(access, &cache), "index cache");
  const Handle creation = checked(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "file creation");
  file_ = checked(H5Fcreate(path.c_str(), overwrite ? H5F_ACC_TRUNC : H5F_ACC_EXCL, creation, access), H5Fclose,
                  "cannot create");
}

void RunLayout::measure(const SceneDef& scene, const Bodies& bodies) {
  const auto vertices = [&](std::size_t first, std::size_t end) {
    return first < end ? static_cast<hsize_t>(bodies.vertex_begin[end] - bodies.vertex_begin[first]) : hsize_t{0};
  };
  const std::size_t fixed = first_fixed(bodies);
  const std::size_t floe = first_floe(bodies);
  size_ = {{"floe", bodies.count() - floe},
           {"vertex", vertices(floe, bodies.count())},
           {"xy", 2},
           {"overlap_class", OverlapCount::classes},
           {"boundary", floe - fixed},
           {"boundary_vertex", vertices(fixed, floe)},
           {"platform_vertex", scene.platform.present ? vertices(0, fixed) : 0}};
}

void RunLayout::write_header(const SceneDef& scene, const Bodies& bodies, const Provenance& provenance) {
  hdf5::write_text(file_, "Conventions", "CF-1.10");
  hdf5::write_text(file_, "title", provenance.title);
  hdf5::write_text(file_, "source", "gem " GEM_VERSION " (" GEM_COMMIT ")");
  hdf5::write_text(file_, "history", utc_now() + " " + provenance.command_line);
  hdf5::write_text(file_, "gem_schema", schema_version);
  hdf5::write_text(file_, "gem_status", "running", status_size);
  hdf5::write_text(file_, "gem_state_hash", "", 16);
  hdf5::write_text(file_, "gem_case_sha256", provenance.case_sha256);
  hdf5::write_text(file_, "gem_seed", std::to_string(scene.run.seed));
  hdf5::write_text(file_, "gem_engine", provenance.engine);
  hdf5::write_text(file_, "gem_resolution", provenance.resolution);
  hdf5::write_text(file_, "gem_threads", std::to_string(provenance.threads));
  hdf5::write_text(file_, "gem_device", provenance.device.empty() ? "none" : provenance.device);
  hdf5::write_text(file_, "gem_arithmetic", provenance.arithmetic);
  hdf5::write_text(file_, "gem_build", build_text());
  hdf5::write_text(file_, "gem_platform", scene.platform.present ? "present" : "absent");
  hdf5::write_text(
      file_, "gem_signs",
      "forces and impulses in /platform act on the platform; impulses in /events act on the ice, along the "
      "normal that points from the platform into the ice; angles are counter-clockwise");
  hdf5::write_numbers(file_, "gem_first_floe_body", H5T_STD_I32LE, {double(first_floe(bodies))});
  hdf5::write_numbers(file_, "gem_force_window_s", H5T_IEEE_F64LE, {scene.output.force_window_s});
  if (provenance.case_toml.size() <= attribute_limit) {
    hdf5::write_text(file_, "gem_case_toml", provenance.case_toml);
    return;
  }
  hdf5::write_text(file_, "gem_case_toml", "in dataset /gem_case_toml");
  const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, "case type");
  check(H5Tset_size(type, H5T_VARIABLE), "case type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "case type");
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, "case space");
  const Handle dataset =
      checked(H5Dcreate2(file_, "gem_case_toml", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose, "case");
  const char* text = provenance.case_toml.c_str();
  check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &text), "case");
}

void RunLayout::add_group(const std::string& group, const char* unlimited) {
  const Handle id =
      checked(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, group.c_str());
  if (unlimited != nullptr && std::strcmp(unlimited, "event") == 0) add_dimension(id, "event", 0, true);
  if (group == "boundary") {
    add_dimension(id, "boundary", size_["boundary"], false);
    add_dimension(id, "boundary_vertex", size_["boundary_vertex"], false);
  }
  if (group == "shape") add_dimension(id, "platform_vertex", size_["platform_vertex"], false);
}

/// A dimension without values, the way netCDF marks one. A dimension of size 0 must be able to grow to be legal there.
void RunLayout::add_dimension(hid_t group, const std::string& name, hsize_t size, bool unlimited) {
  const hsize_t maximum = unlimited || size == 0 ? H5S_UNLIMITED : size;
  const Handle space = checked(H5Screate_simple(1, &size, &maximum), H5Sclose, name.c_str());
  const Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name.c_str());
  if (maximum == H5S_UNLIMITED) {
    check(H5Pset_chunk(creation, 1, &rows_per_chunk), name.c_str());
  }
  Handle id = checked(H5Dcreate2(group, name.c_str(), H5T_IEEE_F32BE, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                      H5Dclose, name.c_str());
  std::string digits = std::to_string(size);
  digits.insert(0, digits.size() < 10 ? 10 - digits.size() : 0, ' ');
  const std::string mark = "This is a netCDF dimension but not a netCDF variable." + digits;
  check(H5DSset_scale(id, mark.c_str()), name.c_str());
  char path[256] = "";
  H5Iget_name(id, path, sizeof path);
  if (unlimited) {
    dataset_[path] = Dataset{checked(H5Dopen2(file_, path, H5P_DEFAULT), H5Dclose, path), 0, 1};
  }
  scale_[path] = std::move(id);
}

void RunLayout::add_column(const Column& column, const std::vector<double>* values) {
  const std::vector<std::string> names = words(column.dimensions);
  std::vector<hsize_t> size, maximum, chunk;
  bool chunked = false;
  for (std::size_t d = 0; d < names.size(); ++d) {
    const hsize_t now = grows(names[d]) ? 0 : size_.at(names[d]);
    const bool open = grows(names[d]) || now == 0;
    size.push_back(now);
    maximum.push_back(open ? H5S_UNLIMITED : now);
    const bool framed = column.group == "floes" || column.group == "stats";
    const hsize_t wish = d > 0 ? floes_per_chunk : framed ? frames_per_chunk : rows_per_chunk;
    chunk.push_back(open ? wish : std::min(wish, now));
    chunked = chunked || open || now > 64;
  }
  const std::string path = "/" + column.group + "/" + column.name;
  const Handle space =
      checked(H5Screate_simple(static_cast<int>(size.size()), size.data(), maximum.data()), H5Sclose, path.c_str());
  const Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path.c_str());
  const Handle access = checked(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose, path.c_str());
  if (chunked) {
    check(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()), path.c_str());
    check(H5Pset_shuffle(creation), path.c_str());
    check(H5Pset_deflate(creation, 4), path.c_str());
    // a block of frames stays in the cache until it is full, so that no chunk is inflated again to be filled
    const hsize_t block = frames_per_chunk * (size.back() + floes_per_chunk) * sizeof(float) + 1048576;
    check(H5Pset_chunk_cache(access, 12421, block, 1.0), path.c_str());
  }
  Handle id = checked(H5Dcreate2(file_, path.c_str(), file_type(column.stored), space, H5P_DEFAULT, creation, access),
                      H5Dclose, path.c_str());
  describe(column, id);
  attach_scales(column, names, id);
  if (values != nullptr && !values->empty()) {
    check(H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values->data()), path.c_str());
  }
  if (grows(names.front())) dataset_[path] = Dataset{std::move(id), 0, names.size() > 1 ? size.back() : 1};
}

void RunLayout::describe(const Column& column, hid_t dataset) {
  hdf5::write_text(dataset, "units", column.units);
  hdf5::write_text(dataset, "long_name", column.long_name);
  if (column.name == "vertex_count") {
    hdf5::write_text(dataset, "sample_dimension", column.group == "shape" ? "vertex" : "boundary_vertex");
  }
  if (column.group == "shape" && column.name == "thickness") {
    hdf5::write_text(dataset, "standard_name", "sea_ice_thickness");
  }
  if (column.dimensions == "time overlap_class") {
    std::vector<double> edges;
    for (int i = 0; i < OverlapCount::classes; ++i) edges.push_back(OverlapCount::upper_edge(i));
    hdf5::write_numbers(dataset, "class_upper_edges", H5T_IEEE_F64LE, edges);
  }
  if (column.flag_meanings.empty()) return;
  std::vector<double> values(words(column.flag_meanings).size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = double(i);
  hdf5::write_numbers(dataset, "flag_values", file_type(column.stored), values);
  hdf5::write_text(dataset, "flag_meanings", column.flag_meanings);
}

void RunLayout::attach_scales(const Column& column, const std::vector<std::string>& names, hid_t dataset) {
  const std::string path = "/" + column.group + "/" + column.name;
  if (names.front() == column.name) {
    check(H5DSset_scale(dataset, column.name.c_str()), path.c_str());
    scale_[path] = checked(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path.c_str());
    return;
  }
  for (std::size_t d = 0; d < names.size(); ++d) {
    const auto own = scale_.find("/" + column.group + "/" + names[d]);
    const auto found = own != scale_.end() ? own : scale_.find("/" + names[d]);
    check(H5DSattach_scale(dataset, found->second, static_cast<unsigned>(d)), path.c_str());
  }
}

template <class Value>
void RunLayout::append_column(const std::string& path, const std::vector<Value>& values, hsize_t rows) {
  if (rows == 0) return;
  Dataset& dataset = dataset_.at(path);
  const hsize_t start[2] = {dataset.rows, 0};
  const hsize_t count[2] = {rows, dataset.width};
  const hsize_t size[2] = {dataset.rows + rows, dataset.width};
  dataset.rows += rows;
  check(H5Dset_extent(dataset.id, size), path.c_str());
  if (values.empty()) return;
  const Handle file_space = checked(H5Dget_space(dataset.id), H5Sclose, path.c_str());
  check(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start, nullptr, count, nullptr), path.c_str());
  const int rank = H5Sget_simple_extent_ndims(file_space);
  const Handle memory_space = checked(H5Screate_simple(rank, count, nullptr), H5Sclose, path.c_str());
  check(H5Dwrite(dataset.id, memory_type(Value{}), memory_space, file_space, H5P_DEFAULT, values.data()), path.c_str());
}

template <class Row>
void RunLayout::append_rows(const std::vector<RowColumn<Row>>& columns, std::vector<Row>& rows, std::size_t count) {
  std::vector<double> values(count);
  const auto end = rows.begin() + std::ptrdiff_t(count);
  for (const auto& entry : columns) {
    std::transform(rows.begin(), end, values.begin(), entry.value);
    append_column("/" + entry.column.group + "/" + entry.column.name, values, count);
  }
  rows.erase(rows.begin(), end);
  any_written_ = any_written_ || count > 0;
}

void RunLayout::append_stats(std::size_t count) {
  for (const auto& entry : count_columns()) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i)
      for (const std::int64_t n : (waiting_.stats[i].*(entry.counts)).count) values.push_back(double(n));
    append_column("/stats/" + entry.column.name, values, count);
  }
  append_rows(stats_columns(), waiting_.stats, count);
}

void RunLayout::append_events(std::size_t count) {
  append_rows(event_columns(), waiting_.events, count);
  append_column("/events/event", std::vector<double>{}, count);
}

void RunLayout::append_frames(std::size_t count) {
  if (count == 0) return;
  FloeFrames& floes = waiting_.floes;
  for (const auto& entry : floe_columns()) {
    std::vector<float>& all = floes.*(entry.values);
    const auto end = all.begin() + std::ptrdiff_t(count * size_.at("floe"));
    append_column("/floes/" + entry.column.name, std::vector<float>(all.begin(), end), count);
    all.erase(all.begin(), end);
  }
  const auto end = floes.time.begin() + std::ptrdiff_t(count);
  append_column("/floes/time", std::vector<double>(floes.time.begin(), end), count);
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
  append_rows(platform_columns(), waiting_.platform, whole(waiting_.platform.size(), rows_per_chunk));
  append_events(whole(waiting_.events.size(), rows_per_chunk));
  append_stats(whole(waiting_.stats.size(), frames_per_chunk));
  append_frames(whole(waiting_.floes.time.size(), frames_per_chunk));
}

void RunLayout::append_rest() {
  append_rows(platform_columns(), waiting_.platform, waiting_.platform.size());
  append_events(waiting_.events.size());
  append_stats(waiting_.stats.size());
  append_frames(waiting_.floes.time.size());
}

void RunLayout::set_text(const char* attribute, const std::string& text) { hdf5::write_text(file_, attribute, text); }

void RunLayout::flush() { check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "cannot flush"); }

void RunLayout::close() {
  for (auto& [path, dataset] : dataset_) {
    if (!dataset.id.close()) throw hdf5::Failure{path + ": " + hdf5::last_reason()};
  }
  for (auto& [path, scale] : scale_) {
    if (!scale.close()) throw hdf5::Failure{path + ": " + hdf5::last_reason()};
  }
  if (!file_.close()) throw hdf5::Failure{"cannot close: " + hdf5::last_reason()};
}

void RunLayout::abandon() {
  for (auto& [path, dataset] : dataset_) dataset.id.abandon();
  for (auto& [path, scale] : scale_) scale.abandon();
  file_.abandon();
}

}  // namespace gem
