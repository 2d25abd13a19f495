// Reads a summary. The scales of a dataset tell whether it is a column or a series.
#include <hdf5_hl.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "gem/base/error.h"
#include "gem/record/hdf5/hdf5_handle.h"
#include "gem/record/hdf5/untrusted_file.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/summary/summary_file.h"

namespace gem {

using hdf5::check;
using hdf5::checked;
using hdf5::Handle;

namespace {

Handle opened(const std::string& path) {
  hdf5::quiet_errors();
  hdf5::refuse_plugins();
  Handle file = checked(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "cannot open");
  hdf5::check_untrusted(file);
  return file;
}

std::vector<std::string> dataset_names(hid_t file) {
  H5G_info_t group{};
  check(H5Gget_info(file, &group), "list");
  std::vector<std::string> names;
  for (hsize_t i = 0; i < group.nlinks; ++i) {
    char name[256] = {};
    if (H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof(name), H5P_DEFAULT) < 0)
      throw hdf5::Failure{"list: " + hdf5::last_reason()};
    names.emplace_back(name);
  }
  return names;
}

/// As H5DSis_scale(), which leaves objects open where the mark is another text than it writes. Throws nothing: the
/// library calls it.
bool has_scale_mark(hid_t dataset) {
  try {
    return hdf5::read_text(dataset, "CLASS") == "DIMENSION_SCALE";
  } catch (const hdf5::Failure&) {
    return false;
  }
}

class Dataset {
 public:
  Dataset(hid_t file, const std::string& name)
      : name_(name), id_(checked(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, name.c_str())) {
    const Handle space = checked(H5Dget_space(id_), H5Sclose, name.c_str());
    size.resize(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
    check(H5Sget_simple_extent_dims(space, size.data(), nullptr), name.c_str());
    type_ = checked(H5Dget_type(id_), H5Tclose, name.c_str());
  }

  std::string text(const char* attribute_name) const { return hdf5::read_text(id_, attribute_name); }
  bool is_text() const { return H5Tget_class(type_) == H5T_STRING; }
  bool is_scale() const { return has_scale_mark(id_); }
  bool is_double() const { return H5Tget_size(type_) == sizeof(double); }
  std::size_t count() const {
    const Handle space = checked(H5Dget_space(id_), H5Sclose, name_.c_str());
    const std::size_t elements = hdf5::element_count(id_, space, H5Tget_size(type_), name_);
    hdf5::check_at_once(id_, elements, name_);
    return elements;
  }

  /// Name of the scale of a dimension; empty if it has none.
  std::string scale(unsigned dimension) const {
    std::string found;
    const H5DS_iterate_t look = [](hid_t, unsigned, hid_t scale, void* to) -> herr_t {
      char text[256] = {};
      if (!has_scale_mark(scale) || H5DSget_scale_name(scale, text, sizeof(text)) < 0) return -1;
      *static_cast<std::string*>(to) = text;
      return 1;
    };
    check(H5DSiterate_scales(id_, dimension, nullptr, look, &found), name_.c_str());
    return found;
  }

  std::vector<double> numbers() const {
    std::vector<double> values(count());
    check(H5Dread(id_, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name_.c_str());
    return values;
  }

  std::vector<std::string> texts() const {
    std::vector<std::string> values;
    if (H5Tis_variable_str(type_) > 0) {
      std::vector<char*> pointers(count(), nullptr);
      check(H5Dread(id_, type_, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), name_.c_str());
      for (const char* pointer : pointers) values.emplace_back(pointer != nullptr ? pointer : "");
      const Handle space = checked(H5Dget_space(id_), H5Sclose, name_.c_str());
      check(H5Dvlen_reclaim(type_, space, H5P_DEFAULT, pointers.data()), name_.c_str());
      return values;
    }
    const std::size_t length = H5Tget_size(type_);
    const std::size_t texts = count();
    std::string block(texts * length, '\0');
    check(H5Dread(id_, type_, H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data()), name_.c_str());
    for (std::size_t i = 0; i < texts; ++i) {
      const std::string one = block.substr(i * length, length);
      values.push_back(one.substr(0, one.find('\0')));
    }
    return values;
  }

  std::vector<hsize_t> size;

 private:
  std::string name_;
  Handle id_, type_;
};

std::set<std::string> word_set(const std::string& text) {
  std::istringstream stream(text);
  std::set<std::string> all;
  for (std::string word; stream >> word;) all.insert(word);
  return all;
}

void read_dataset(const Dataset& data, const std::string& name, SummaryTable& table, std::set<std::string>& settings) {
  const std::string units = data.text("units");
  const std::string meaning = data.text("long_name");
  settings.merge(word_set(data.text("coordinates")));
  if (name == "run" && !data.is_text()) throw hdf5::Failure{"its runs have no names"};
  if (name == "run")
    table.runs = data.texts();
  else if (data.is_scale())
    table.axes.push_back({name, units, meaning, data.numbers()});
  else if (data.size.size() == 2)
    table.series.push_back({name, units, meaning, data.scale(1), data.is_double(), data.numbers()});
  else if (data.is_text())
    table.columns.push_back({name, units, meaning, false, {}, data.texts()});
  else
    table.columns.push_back({name, units, meaning, false, data.numbers(), {}});
}

template <class Item>
const Item* named(const std::vector<Item>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

/// Checks that every column has a value per run, and every series a row per run as long as its axis.
void check_lengths(const SummaryTable& table) {
  if (table.runs.empty()) throw hdf5::Failure{"it lists no runs"};
  for (const SummaryColumn& column : table.columns)
    if (std::max(column.numbers.size(), column.texts.size()) != table.runs.size())
      throw hdf5::Failure{column.name + " has not one value for each run"};
  for (const SummarySeries& series : table.series) {
    const SummaryAxis* axis = table.axis(series.axis);
    if (axis == nullptr) throw hdf5::Failure{series.name + " has no scale"};
    if (series.values.size() != table.runs.size() * axis->values.size())
      throw hdf5::Failure{series.name + " has not one row for each run"};
  }
}

}  // namespace

const SummaryAxis* SummaryTable::axis(const std::string& name) const { return named(axes, name); }
const SummaryColumn* SummaryTable::column(const std::string& name) const { return named(columns, name); }
const SummarySeries* SummaryTable::one_series(const std::string& name) const { return named(series, name); }

bool is_summary(const std::string& path) {
  if (!is_run_file(path)) return false;
  try {
    return H5Lexists(opened(path), "run", H5P_DEFAULT) > 0;
  } catch (const hdf5::Failure&) {
    return false;
  }
}

SummaryTable read_summary(const std::string& path) {
  try {
    const Handle file = opened(path);
    if (H5Lexists(file, "run", H5P_DEFAULT) <= 0) throw hdf5::Failure{"it lists no runs"};
    SummaryTable table;
    table.title = hdf5::read_text(file, "title");
    table.history = hdf5::read_text(file, "history");
    std::set<std::string> settings;
    for (const std::string& name : dataset_names(file)) read_dataset(Dataset(file, name), name, table, settings);
    for (SummaryColumn& column : table.columns) column.is_setting = settings.contains(column.name);
    check_lengths(table);
    return table;
  } catch (const hdf5::Failure& failure) {
    throw Error(ExitCode::file_system, "cannot read the summary " + shown(path) + " (" + failure.text +
                                           "); name a file that `gem sweep collect` wrote");
  }
}

}  // namespace gem
