// Builds HDF5 files line by line; the library refuses what makes no sense, and the line is left out.
#include "gem/record/testing/described_file.h"

#include <hdf5_hl.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <vector>

#include "gem/record/hdf5/hdf5_handle.h"
#include "gem/record/schema.h"

namespace gem::test {
namespace {

using hdf5::check;
using hdf5::checked;
using hdf5::Handle;

/// Datasets with values stay small. Those without may have any size.
constexpr std::size_t values_maximum = 20000;

double number_of(const std::string& word) {
  double value = 0.0;
  std::from_chars(word.data(), word.data() + word.size(), value);
  return value;
}

/// A length; what is no number is 0.
hsize_t size_of(const std::string& word) {
  const double value = number_of(word);
  return value > 0.0 ? static_cast<hsize_t>(std::min(value, 9e18)) : 0;
}

std::string with_line_breaks(std::string text) {
  for (std::size_t at = text.find("\\n"); at != std::string::npos; at = text.find("\\n", at + 1))
    text.replace(at, 2, "\n");
  return text;
}

std::string rest_of(std::istringstream& line) {
  std::string text;
  std::getline(line >> std::ws, text);
  return with_line_breaks(text);
}

std::vector<std::string> items_of(std::istringstream& line) {
  std::vector<std::string> items;
  std::string text = rest_of(line);
  for (std::size_t bar = text.find(" | "); bar != std::string::npos; bar = text.find(" | ")) {
    items.push_back(text.substr(0, bar));
    text.erase(0, bar + 3);
  }
  items.push_back(text);
  return items;
}

std::vector<double> numbers_of(std::istringstream& line) {
  std::vector<double> values;
  for (std::string word; line >> word;) values.push_back(number_of(word));
  return values;
}

hid_t type_of(const std::string& name) {
  if (name == "f4") return H5T_IEEE_F32LE;
  if (name == "i4") return H5T_STD_I32LE;
  if (name == "u1") return H5T_STD_U8LE;
  return H5T_IEEE_F64LE;
}

class Builder {
 public:
  explicit Builder(const std::string& path)
      : file_(checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, "create")),
        links_(checked(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "links")) {
    check(H5Pset_create_intermediate_group(links_, 1), "links");
  }

  void add(const std::string& text) {
    std::istringstream line(text);
    std::string kind, path;
    line >> kind >> path;
    if (kind == "text" || kind == "number") add_attribute(kind, path, line);
    if (kind == "texts") add_texts(path, line);
    if (kind == "data") add_numbers(path, line);
    if (kind == "strings") add_strings(path, items_of(line));
    if (kind == "fixed") add_fixed(path, items_of(line));
    if (kind == "scale") check(H5DSset_scale(open(path), path.c_str()), "scale");
    if (kind == "attach") attach(path, line);
  }

 private:
  Handle open(const std::string& path) const {
    return checked(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose, "open");
  }

  Handle create(const std::string& path, hid_t type, const std::vector<hsize_t>& size, bool stored) const {
    const Handle space =
        checked(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose, "space");
    const Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "creation");
    if (!stored)
      check(H5Pset_chunk(creation, static_cast<int>(size.size()), std::vector<hsize_t>(size.size(), 1).data()),
            "chunk");
    return checked(H5Dcreate2(file_, path.c_str(), type, space, links_, creation, H5P_DEFAULT), H5Dclose, "create");
  }

  void add_attribute(const std::string& kind, const std::string& path, std::istringstream& line) const {
    std::string name;
    line >> name;
    if (kind == "text")
      hdf5::write_text(open(path), name.c_str(), rest_of(line));
    else
      hdf5::write_numbers(open(path), name.c_str(), H5T_IEEE_F64LE, numbers_of(line));
  }

  void add_numbers(const std::string& path, std::istringstream& line) const {
    std::string type, word;
    line >> type;
    std::vector<hsize_t> size;
    while (line >> word && word != "=") size.push_back(size_of(word));
    const bool stored = word == "=";
    const Handle id = create(path, type_of(type), size, stored);
    std::vector<double> values = numbers_of(line);
    std::size_t count = 1;
    for (const hsize_t length : size)
      count = std::min<std::size_t>(count * std::min<hsize_t>(length, values_maximum + 1), values_maximum + 1);
    if (!stored || count > values_maximum) return;
    if (values.empty()) values.push_back(0.0);
    while (values.size() < count)
      values.push_back(values.size() == 1 ? values[0] : 2.0 * values.back() - values[values.size() - 2]);
    if (count > 0) check(H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "write");
  }

  void add_strings(const std::string& path, const std::vector<std::string>& items) const {
    const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, "type");
    check(H5Tset_size(type, H5T_VARIABLE), "type");
    const Handle id = create(path, type, {items.size()}, true);
    std::vector<const char*> pointers;
    for (const std::string& item : items) pointers.push_back(item.c_str());
    check(H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), "write");
  }

  /// Texts of one length: the type and the values.
  static Handle fixed_length(const std::vector<std::string>& items, std::string& block) {
    std::size_t longest = 1;
    for (const std::string& item : items) longest = std::max(longest, item.size());
    for (const std::string& item : items) block += item + std::string(longest - item.size(), '\0');
    Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, "type");
    check(H5Tset_size(type, longest), "type");
    return type;
  }

  void add_fixed(const std::string& path, const std::vector<std::string>& items) const {
    std::string block;
    const Handle type = fixed_length(items, block);
    const Handle id = create(path, type, {items.size()}, true);
    check(H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data()), "write");
  }

  void add_texts(const std::string& path, std::istringstream& line) const {
    std::string name, block;
    line >> name;
    const std::vector<std::string> items = items_of(line);
    const Handle type = fixed_length(items, block);
    const hsize_t size = items.size();
    const Handle space = checked(H5Screate_simple(1, &size, nullptr), H5Sclose, "space");
    const Handle id =
        checked(H5Acreate2(open(path), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "create");
    check(H5Awrite(id, type, block.data()), "write");
  }

  void attach(const std::string& path, std::istringstream& line) const {
    unsigned dimension = 0;
    std::string scale;
    line >> dimension >> scale;
    check(H5DSattach_scale(open(path), open(scale), dimension), "attach");
  }

  Handle file_, links_;
};

}  // namespace

void write_described_file(const std::string& description, const std::string& path) {
  hdf5::quiet_errors();
  Builder builder(path);
  builder.add(std::string("text / gem_schema ") + schema_version);
  std::istringstream lines(description);
  for (std::string line; std::getline(lines, line);) try {
      builder.add(line);
    } catch (const hdf5::Failure&) {
    }
}

std::int64_t open_hdf5_objects() { return H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL); }

void close_hdf5_objects() { H5close(); }

}  // namespace gem::test
