// Reads run files through the HDF5 C library; every call is checked.
#include "gem/record/run_file/run_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

#include "gem/base/error.h"
#include "gem/record/hdf5/hdf5_handle.h"
#include "gem/record/hdf5/row_extent.h"
#include "gem/record/hdf5/untrusted_file.h"
#include "gem/record/output/output_path.h"
#include "gem/record/schema.h"

namespace gem {

using hdf5::check;
using hdf5::checked;
using hdf5::Handle;

namespace {

constexpr const char* growing_groups[] = {"floes", "platform", "events", "stats", "contacts", "splits"};
constexpr hssize_t number_list_maximum = 10000;

[[noreturn]] void refuse_run_file(const std::string& path, const std::string& why, const std::string& hint) {
  throw Error(ExitCode::file_system, "cannot read " + shown(path) + " (" + why + ") " + hint);
}

/// Turns a failed call into the Error of this file.
template <class Body>
auto reading(const std::string& path, Body body) {
  try {
    return body();
  } catch (const hdf5::Failure& failure) {
    if (failure.text.find(std::strerror(EAGAIN)) != std::string::npos)
      refuse_run_file(path, "another program changes it", "wait for its end");
    refuse_run_file(path, failure.text, "the file may be damaged or made by another program");
  } catch (const std::out_of_range&) {
    refuse_run_file(path, "a dataset has another shape than a run file has",
                    "the file may be damaged or made by another program");
  }
}

std::vector<std::vector<Vec2>> split(const std::vector<double>& xy, const std::vector<double>& counts) {
  std::vector<std::vector<Vec2>> outlines;
  std::size_t next = 0;
  for (const double count : counts) {
    auto& outline = outlines.emplace_back();
    for (double n = 0.0; n < count && next + 1 < xy.size(); ++n, next += 2) {
      outline.push_back({xy[next], xy[next + 1]});
    }
  }
  return outlines;
}

}  // namespace

bool is_run_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 8> head{};
  file.read(head.data(), head.size());
  return file && std::string(head.data(), 8) == "\x89HDF\r\n\x1a\n";
}

namespace {

/// Whether the header says that a program writes the file, or did when it ended.
bool is_marked_open(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 12> head{};  // signature, version, two sizes, flags
  file.read(head.data(), head.size());
  return file && head[8] >= 3 && head[11] != 0;
}

}  // namespace

struct RunFile::Inside {
  std::string path;
  Handle file;
  std::map<std::string, std::uint64_t> rows;  // of the groups that grow, when the file was opened

  /// A file that is written, or that a killed program left, can be opened only as one that somebody writes.
  void open_file() {
    const Handle access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
    check(H5Pset_file_locking(access, true, true), "file locking");
    // the library waits for an index that is half written, each time twice as long; 1 ms in all
    check(H5Pset_metadata_read_attempts(access, 20), "file access");
    hdf5::refuse_plugins();
    const unsigned beside = is_marked_open(path) ? H5F_ACC_SWMR_READ : 0;
    file = checked(H5Fopen(path.c_str(), H5F_ACC_RDONLY | beside, access), H5Fclose, "cannot open");
    hdf5::check_untrusted(file);
  }

  /// Datasets of one file may be seen at different lengths while it is written, or end in chunks that were lost. All
  /// reading keeps to the rows that are there in all datasets of a group.
  void count_rows() {
    const std::uint64_t size = std::filesystem::file_size(path);
    for (const char* group : growing_groups) rows[group] = hdf5::rows_of_group(file, group, size);
  }

  /// Length of a dataset in each dimension, as far as it is read.
  std::vector<hsize_t> length(const std::string& dataset, hid_t id) const {
    std::vector<hsize_t> size = extent(id);
    const auto group = rows.find(dataset.substr(0, dataset.find('/')));
    if (!size.empty() && group != rows.end()) size[0] = std::min<hsize_t>(size[0], group->second);
    return size;
  }

  Handle open(const std::string& dataset) const {
    Handle access = checked(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose, "access");
    check(H5Pset_chunk_cache(access, 12421, 16 << 20, 1.0), "chunk cache");
    return checked(H5Dopen2(file, dataset.c_str(), access), H5Dclose, dataset.c_str());
  }

  /// Size of one value in the file.
  std::size_t stored_bytes(hid_t dataset) const { return H5Tget_size(checked(H5Dget_type(dataset), H5Tclose, "type")); }

  std::vector<hsize_t> extent(hid_t dataset) const {
    const Handle space = checked(H5Dget_space(dataset), H5Sclose, "extent");
    std::vector<hsize_t> size(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
    check(H5Sget_simple_extent_dims(space, size.data(), nullptr), "extent");
    return size;
  }

  /// The values of a dataset from `start` on, `count` in each dimension, row by row.
  std::vector<double> values(const std::string& dataset, hid_t id, const std::vector<hsize_t>& start,
                             const std::vector<hsize_t>& count) const {
    const Handle space = checked(H5Dget_space(id), H5Sclose, dataset.c_str());
    hdf5::element_count(id, space, stored_bytes(id), dataset);
    hsize_t total = 1;
    for (const hsize_t size : count) total *= size;
    hdf5::check_at_once(id, total, dataset);
    std::vector<double> read(total);
    if (total == 0) return read;
    if (!count.empty())
      check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), dataset.c_str());
    const Handle memory =
        checked(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose, dataset.c_str());
    check(H5Dread(id, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, read.data()), dataset.c_str());
    return read;
  }

  /// Rows `first` to `first + count - 1` of a dataset of rows, one after the other.
  std::vector<float> float_rows(const char* name, std::size_t first, std::size_t count_of_rows) const {
    const Handle id = open(name);
    const Handle space = checked(H5Dget_space(id), H5Sclose, name);
    hdf5::element_count(id, space, stored_bytes(id), name);
    const hsize_t count[2] = {count_of_rows, extent(id).at(1)};
    const hsize_t start[2] = {first, 0};
    std::vector<float> values(count[0] * count[1]);
    if (values.empty()) return values;
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr), name);
    const Handle memory = checked(H5Screate_simple(2, count, nullptr), H5Sclose, name);
    check(H5Dread(id, H5T_NATIVE_FLOAT, memory, space, H5P_DEFAULT, values.data()), name);
    return values;
  }
};

RunFile::RunFile(const std::string& path, bool allow_incomplete) : inside_(std::make_unique<Inside>()) {
  hdf5::quiet_errors();
  inside_->path = path;
  std::error_code fault;
  const auto kind = std::filesystem::status(path, fault).type();
  if (kind == std::filesystem::file_type::not_found) refuse_run_file(path, "no such file", "check the name");
  if (kind == std::filesystem::file_type::directory) refuse_run_file(path, "it is a directory", "name a run file");
  if (fault) refuse_run_file(path, fault.message(), "check the path");
  if (!std::ifstream(path)) refuse_run_file(path, "no permission", "check the permissions");
  if (!is_run_file(path)) refuse_run_file(path, "not an HDF5 file", "name a file that `gem run` wrote");
  reading(path, [&] {
    inside_->open_file();
    return 0;
  });
  const std::string version = attribute("gem_schema");
  if (version.empty())
    refuse_run_file(path, "no gem_schema attribute: not a run file",
                    "name a file that `gem run` wrote (a summary of `gem sweep collect` is for xarray)");
  if (version != schema_version)
    refuse_run_file(path, "schema " + version + ", this program reads " + schema_version, "use a matching gem");
  if (!allow_incomplete && !ended_as_asked(status())) {
    refuse_run_file(path, "its status is '" + status() + "', not 'complete'",
                    "use --allow-incomplete to read what is there");
  }
  reading(path, [&] {
    inside_->count_rows();
    return 0;
  });
}

RunFile::~RunFile() = default;
RunFile::RunFile(RunFile&&) noexcept = default;

const std::string& RunFile::path() const { return inside_->path; }

std::string RunFile::status() const { return attribute("gem_status"); }

std::string RunFile::solver() const {
  const std::string solver = attribute("gem_solver");
  return solver.empty() ? attribute("gem_resolution") : solver;
}

std::string RunFile::attribute(const std::string& name) const {
  return reading(path(), [&] {
    if (name == "gem_case_toml" && has(name)) {
      const Handle dataset = inside_->open(name);
      const Handle type = checked(H5Dget_type(dataset), H5Tclose, name.c_str());
      const Handle space = checked(H5Dget_space(dataset), H5Sclose, name.c_str());
      if (H5Tis_variable_str(type) <= 0 || H5Sget_simple_extent_npoints(space) != 1) return std::string();
      char* text = nullptr;
      check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &text), name.c_str());
      const std::string copy = text != nullptr ? text : "";
      check(H5Dvlen_reclaim(type, space, H5P_DEFAULT, &text), name.c_str());
      return copy;
    }
    return hdf5::read_text(inside_->file, name);
  });
}

std::vector<double> RunFile::number_list(const std::string& name) const {
  return reading(path(), [&] {
    const Handle attribute = checked(H5Aopen(inside_->file, name.c_str(), H5P_DEFAULT), H5Aclose, name.c_str());
    const Handle space = checked(H5Aget_space(attribute), H5Sclose, name.c_str());
    std::vector<double> values(hdf5::element_count(attribute, space, 1, name));
    if (!values.empty()) check(H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()), name.c_str());
    return values;
  });
}

double RunFile::number_attribute(const std::string& name) const {
  return reading(path(), [&] {
    const std::vector<double> values = number_list(name);
    if (values.size() != 1) throw hdf5::Failure{name + ": not one number"};
    return values.front();
  });
}

std::vector<double> RunFile::column(const std::string& dataset) const {
  return reading(path(), [&] {
    const Handle id = inside_->open(dataset);
    const std::vector<hsize_t> count = inside_->length(dataset, id);
    return inside_->values(dataset, id, std::vector<hsize_t>(count.size(), 0), count);
  });
}

std::vector<double> RunFile::column_rows(const std::string& dataset, std::size_t first, std::size_t count) const {
  return reading(path(), [&] {
    const Handle id = inside_->open(dataset);
    std::vector<hsize_t> size = inside_->length(dataset, id), start(size.size(), 0);
    if (size.empty() || first > size[0] || count > size[0] - first)
      throw hdf5::Failure{dataset + " has other rows than the columns beside it"};
    start[0] = first;
    size[0] = count;
    return inside_->values(dataset, id, start, size);
  });
}

std::vector<std::size_t> RunFile::shape(const std::string& dataset) const {
  return reading(path(), [&] {
    const std::vector<hsize_t> size = inside_->length(dataset, inside_->open(dataset));
    if (size.empty()) throw hdf5::Failure{dataset + ": a single value, not rows"};
    return std::vector<std::size_t>(size.begin(), size.end());
  });
}

std::string RunFile::units(const std::string& dataset) const {
  return reading(path(), [&] { return hdf5::read_text(inside_->open(dataset), "units"); });
}

std::string RunFile::long_name(const std::string& dataset) const {
  return reading(path(), [&] { return hdf5::read_text(inside_->open(dataset), "long_name"); });
}

bool RunFile::has(const std::string& dataset) const {
  const auto slash = dataset.find('/');
  if (slash != std::string::npos && slash > 0 &&
      H5Lexists(inside_->file, dataset.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) {
    return false;
  }
  return H5Lexists(inside_->file, dataset.c_str(), H5P_DEFAULT) > 0;
}

std::size_t RunFile::rows(const std::string& dataset) const { return shape(dataset).at(0); }

std::size_t RunFile::floe_count() const { return rows("shape/vertex_count"); }

std::size_t RunFile::frame_count() const { return rows("floes/time"); }

FrameView RunFile::frame(std::size_t index) const { return frames(index, 1).front(); }

std::vector<FrameView> RunFile::frames(std::size_t first, std::size_t count) const {
  if (count == 0) return {};
  if (first >= frame_count() || count > frame_count() - first) {
    refuse_run_file(path(), "no frame " + std::to_string(first + count - 1) + " of " + std::to_string(frame_count()),
                    "ask for an earlier one");
  }
  return reading(path(), [&] {
    std::vector<FrameView> views(count);
    const std::pair<const char*, std::vector<float> FrameView::*> fields[] = {
        {"floes/x", &FrameView::x},          {"floes/y", &FrameView::y},   {"floes/theta", &FrameView::theta},
        {"floes/vx", &FrameView::vx},        {"floes/vy", &FrameView::vy}, {"floes/omega", &FrameView::omega},
        {"floes/active", &FrameView::active}};
    for (const auto& [name, values] : fields) {
      const std::vector<float> all = inside_->float_rows(name, first, count);
      const std::size_t floes = all.size() / count;
      if (name != fields[0].first && floes != views.front().x.size())
        throw hdf5::Failure{std::string(name) + ": not one value for each floe"};
      for (std::size_t n = 0; n < count; ++n)
        (views[n].*values)
            .assign(all.begin() + std::ptrdiff_t(n * floes), all.begin() + std::ptrdiff_t((n + 1) * floes));
    }
    const std::vector<double> time = column_rows("floes/time", first, count);
    for (std::size_t n = 0; n < count; ++n) views[n].time = time.at(n);
    return views;
  });
}

std::vector<std::vector<Vec2>> RunFile::floe_outlines() const {
  return split(column("shape/vertex_xy"), column("shape/vertex_count"));
}

std::vector<std::vector<Vec2>> RunFile::boundary_outlines() const {
  return split(column("boundary/vertex_xy"), column("boundary/vertex_count"));
}

std::vector<Vec2> RunFile::platform_outline() const {
  const std::vector<double> xy = column("shape/platform_xy");
  return split(xy, {double(xy.size()) / 2.0}).front();
}

std::vector<std::vector<Vec2>> RunFile::platform_pieces() const {
  const std::vector<Vec2> corners = platform_outline();
  if (corners.empty()) return {};
  if (!has("shape/platform_first")) return {corners};
  std::vector<double> first = column("shape/platform_first");
  first.push_back(double(corners.size()));
  std::vector<std::vector<Vec2>> pieces;
  for (std::size_t i = 0; i + 1 < first.size(); ++i) {
    const bool fits = first[0] == 0.0 && first[i + 1] >= first[i] + 3.0 && first[i + 1] <= double(corners.size()) &&
                      first[i] == std::floor(first[i]);
    if (!fits)
      refuse_run_file(path(), "shape/platform_first does not fit the corners of the platform",
                      "the file may be damaged");
    pieces.emplace_back(corners.begin() + std::ptrdiff_t(first[i]), corners.begin() + std::ptrdiff_t(first[i + 1]));
  }
  return pieces;
}

}  // namespace gem
