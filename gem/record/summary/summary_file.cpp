// Writes the dimension scale `run`, one scale per axis, and one dataset per column and series.
#include "gem/record/summary/summary_file.h"

#include <hdf5_hl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <map>
#include <system_error>

#include "gem/base/error.h"
#include "gem/record/hdf5/hdf5_handle.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_writer.h"

namespace gem {

using hdf5::check;
using hdf5::checked;
using hdf5::Handle;

namespace {

/// Longer texts are stored with a fixed length and compressed. Chosen by hand.
constexpr std::size_t long_text = 256;

Handle text_type() {
  Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, "text type");
  check(H5Tset_size(type, H5T_VARIABLE), "text size");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "text encoding");
  return type;
}

class SummaryWriter {
 public:
  SummaryWriter(const std::string& path, const SummaryTable& table) : table_(table) {
    const Handle access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
    check(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18), "file format");
    file_ = checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "cannot create");
  }

  void write() {
    for (const SummaryColumn& column : table_.columns)
      if (column.is_setting) coordinates_ += (coordinates_.empty() ? "" : " ") + column.name;
    hdf5::write_text(file_, "Conventions", "CF-1.8");
    hdf5::write_text(file_, "title", table_.title);
    hdf5::write_text(file_, "history", table_.history);
    hdf5::write_text(file_, "source", build_text());
    run_ = texts("run", table_.runs);
    hdf5::write_text(run_, "long_name", "name of the run");
    check(H5DSset_scale(run_, "run"), "run");
    for (const SummaryAxis& axis : table_.axes) write(axis);
    for (const SummaryColumn& column : table_.columns) write(column);
    for (const SummarySeries& series : table_.series) write(series);
    for (auto& [name, axis] : axis_)
      if (!axis.close()) throw hdf5::Failure{"close: " + hdf5::last_reason()};
    if (!run_.close() || !file_.close()) throw hdf5::Failure{"close: " + hdf5::last_reason()};
  }

 private:
  /// Whole cases differ in a few words only, so texts of one length compress to almost nothing.
  Handle long_texts(const std::string& name, const std::vector<std::string>& values) {
    std::size_t longest = 1;
    for (const std::string& value : values) longest = std::max(longest, value.size());
    std::string block;
    for (const std::string& value : values) block += value + std::string(longest - value.size(), '\0');
    const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, name.c_str());
    check(H5Tset_size(type, longest), name.c_str());
    check(H5Tset_strpad(type, H5T_STR_NULLPAD), name.c_str());
    check(H5Tset_cset(type, H5T_CSET_UTF8), name.c_str());
    return dataset(name, {values.size()}, {std::min<hsize_t>(values.size(), 64)}, type, type, block.data());
  }

  Handle texts(const std::string& name, const std::vector<std::string>& values) {
    const auto is_long = [](const std::string& value) { return value.size() > long_text; };
    if (std::any_of(values.begin(), values.end(), is_long)) return long_texts(name, values);
    std::vector<const char*> pointers;
    for (const std::string& value : values) pointers.push_back(value.c_str());
    const hsize_t size = values.size();
    const Handle type = text_type();
    const Handle space = checked(H5Screate_simple(1, &size, nullptr), H5Sclose, name.c_str());
    Handle id = checked(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
                        name.c_str());
    check(H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), name.c_str());
    return id;
  }

  /// Compressed if `chunk` is given.
  Handle dataset(const std::string& name, const std::vector<hsize_t>& size, const std::vector<hsize_t>& chunk,
                 hid_t file_type, hid_t memory_type, const void* values) {
    const Handle space =
        checked(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose, name.c_str());
    const Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name.c_str());
    if (!chunk.empty()) {
      check(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()), name.c_str());
      check(H5Pset_shuffle(creation), name.c_str());
      check(H5Pset_deflate(creation, 6), name.c_str());
    }
    Handle id = checked(H5Dcreate2(file_, name.c_str(), file_type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
                        name.c_str());
    check(H5Dwrite(id, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name.c_str());
    return id;
  }

  void write(const SummaryAxis& axis) {
    Handle& id = axis_[axis.name];
    id = dataset(axis.name, {axis.values.size()}, {}, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, axis.values.data());
    hdf5::write_text(id, "units", axis.units);
    hdf5::write_text(id, "long_name", axis.long_name);
    check(H5DSset_scale(id, axis.name.c_str()), axis.name.c_str());
  }

  void write(const SummaryColumn& column) {
    const bool is_text = !column.texts.empty();
    const Handle id = is_text ? texts(column.name, column.texts)
                              : dataset(column.name, {column.numbers.size()}, {}, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE,
                                        column.numbers.data());
    if (!is_text) hdf5::write_text(id, "units", column.units);
    describe(id, column.long_name, column.is_setting);
    check(H5DSattach_scale(id, run_, 0), column.name.c_str());
  }

  void write(const SummarySeries& series) {
    const hsize_t length = series.values.size() / table_.runs.size();
    const Handle id = dataset(series.name, {table_.runs.size(), length}, {1, length},  // a chunk is one run
                              series.exact ? H5T_IEEE_F64LE : H5T_IEEE_F32LE, H5T_NATIVE_DOUBLE, series.values.data());
    hdf5::write_text(id, "units", series.units);
    describe(id, series.long_name, false);
    check(H5DSattach_scale(id, run_, 0), series.name.c_str());
    check(H5DSattach_scale(id, axis_.at(series.axis), 1), series.name.c_str());
  }

  void describe(hid_t id, const std::string& long_name, bool is_setting) {
    hdf5::write_text(id, "long_name", long_name);
    if (!is_setting && !coordinates_.empty()) hdf5::write_text(id, "coordinates", coordinates_);
  }

  const SummaryTable& table_;
  std::string coordinates_;  // names of the settings, in CF format
  Handle file_, run_;
  std::map<std::string, Handle> axis_;
};

}  // namespace

void write_summary(const std::string& path, bool overwrite, const SummaryTable& table) {
  check_output_path(path, overwrite);
  hdf5::quiet_errors();
  const std::string draft = path + "." + std::to_string(getpid());
  std::string why;
  try {
    SummaryWriter(draft, table).write();
    if (std::rename(draft.c_str(), path.c_str()) == 0) return;
    why = std::generic_category().message(errno);
  } catch (const hdf5::Failure& failure) {
    why = failure.text;
  }
  unlink(draft.c_str());
  throw Error(ExitCode::file_system,
              "cannot write " + shown(path) + " (" + why + "); free disk space or choose another --out");
}

}  // namespace gem
