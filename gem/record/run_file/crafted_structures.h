// Run files whose HDF5 structure or case somebody made to do harm, for tests: how each is made, and what refuses it.
#pragma once

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "gem/base/sha256.h"

namespace gem {

inline void put_text(hid_t file, const char* name, const std::string& text, bool variable = false) {
  if (H5Aexists(file, name) > 0) H5Adelete(file, name);
  const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
  H5Tset_size(type, variable ? H5T_VARIABLE : std::max<std::size_t>(text.size(), 1));
  const bool large = text.size() > 60000;  // an attribute of the 1.8 format has at most 64 kB
  const hid_t attribute = large ? -1 : H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  const char* pointer = text.c_str();
  if (attribute >= 0) {
    ASSERT_GE(H5Awrite(attribute, type, variable ? static_cast<const void*>(&pointer) : text.data()), 0);
    H5Aclose(attribute);
  }
  H5Sclose(space);
  H5Tclose(type);
}

/// The case text of the file with a line replaced, and its right hash.
inline void put_case(hid_t file, const std::string& text) {
  put_text(file, "gem_case_toml", text);
  put_text(file, "gem_case_sha256", sha256_hex(text));
}

struct NewDataset {
  hid_t type = H5T_IEEE_F64LE;
  std::vector<hsize_t> size = {201};
  std::function<void(hid_t)> creation = [](hid_t) {};
  std::vector<double> values = {};
};

inline void put_dataset(hid_t file, const std::string& name, const NewDataset& wanted) {
  if (H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0) H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  wanted.creation(creation);
  std::vector<hsize_t> growing(wanted.size.size(), H5S_UNLIMITED);
  const bool chunked = H5Pget_layout(creation) == H5D_CHUNKED;
  const hid_t space =
      H5Screate_simple(static_cast<int>(wanted.size.size()), wanted.size.data(), chunked ? growing.data() : nullptr);
  const hid_t dataset = H5Dcreate2(file, name.c_str(), wanted.type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  ASSERT_GE(dataset, 0) << name;
  if (!wanted.values.empty()) H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, wanted.values.data());
  H5Dclose(dataset);
  H5Sclose(space);
  H5Pclose(creation);
}

struct Crafted {
  std::string name;
  std::function<void(hid_t)> change;
  std::string message = "";  // of the refusal; empty: the file is read
};

inline void chunk_of(hid_t creation, std::vector<hsize_t> chunk) {
  H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data());
}

inline std::vector<Crafted> crafted_structures() {
  const auto dataset = [](const char* name, NewDataset wanted) {
    return [name, wanted](hid_t file) { put_dataset(file, name, wanted); };
  };
  const std::vector<double> ramp = [] {
    std::vector<double> values(201);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.1 * double(i);
    return values;
  }();
  auto with = [](std::vector<double> values, std::size_t at, double value) {
    values[at] = value;
    return values;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {
      {"soft link", [](hid_t f) { H5Lcreate_soft("/platform/x", f, "platform/other", H5P_DEFAULT, H5P_DEFAULT); },
       "a link to another place or file"},
      {"soft link that dangles", [](hid_t f) { H5Lcreate_soft("/no/where", f, "other", H5P_DEFAULT, H5P_DEFAULT); },
       "a link to another place or file"},
      {"external link", [](hid_t f) { H5Lcreate_external("/etc/passwd", "/x", f, "other", H5P_DEFAULT, H5P_DEFAULT); },
       "a link to another place or file"},
      {"external link in place of a column",
       [](hid_t f) {
         H5Ldelete(f, "platform/x", H5P_DEFAULT);
         H5Lcreate_external("secret.h5", "/platform/x", f, "platform/x", H5P_DEFAULT, H5P_DEFAULT);
       },
       "a link to another place or file"},
      {"external storage",
       dataset("platform/x", {H5T_IEEE_F64LE, {201}, [](hid_t c) { H5Pset_external(c, "/etc/passwd", 0, 201 * 8); }}),
       "external storage"},
      {"external storage beside the file",
       dataset("shape/area", {H5T_IEEE_F64LE, {2}, [](hid_t c) { H5Pset_external(c, "../secret", 0, 16); }}),
       "external storage"},
      {"virtual dataset",
       dataset("platform/x", {H5T_IEEE_F64LE,
                              {201},
                              [](hid_t c) {
                                const hsize_t size = 201;
                                const hid_t space = H5Screate_simple(1, &size, nullptr);
                                H5Pset_virtual(c, space, "secret.h5", "/platform/x", space);
                                H5Sclose(space);
                              }}),
       "a virtual dataset"},
      {"filter of a plugin",
       dataset("platform/x", {H5T_IEEE_F64LE,
                              {201},
                              [](hid_t c) {
                                chunk_of(c, {64});
                                H5Pset_filter(c, 32015, H5Z_FLAG_OPTIONAL, 0, nullptr);
                              }}),
       "a filter that gem does not use (number 32015)"},
      {"filter of the library that gem does not use",
       dataset("platform/x", {H5T_IEEE_F64LE,
                              {201},
                              [](hid_t c) {
                                chunk_of(c, {64});
                                H5Pset_scaleoffset(c, H5Z_SO_FLOAT_DSCALE, 2);
                              }}),
       "a filter that gem does not use"},
      {"bomb: rows without data",
       dataset("platform/x", {H5T_IEEE_F64LE, {4000000000}, [](hid_t c) { chunk_of(c, {1024}); }}),
       "more data than the file holds"},
      {"bomb: more rows than a number has bits",
       dataset("events/time", {H5T_IEEE_F64LE, {hsize_t{1} << 62}, [](hid_t c) { chunk_of(c, {1024}); }}),
       "too many rows"},
      {"bomb: long rows",
       dataset("floes/x", {H5T_IEEE_F32LE,
                           {1, 4000000000},
                           [](hid_t c) {
                             chunk_of(c, {1, 1024});
                           }}),
       "its rows are too long"},
      {"bomb: giant chunk", dataset("platform/x", {H5T_IEEE_F64LE, {201}, [](hid_t c) { chunk_of(c, {500000000}); }}),
       "its chunks are too large"},
      {"bomb: text without end",
       dataset("platform/x", {[] {
                                const hid_t t = H5Tcopy(H5T_C_S1);
                                H5Tset_size(t, 1000000000);
                                return t;
                              }(),
                              {1},
                              [](hid_t c) { H5Pset_alloc_time(c, H5D_ALLOC_TIME_LATE); }}),
       "neither numbers nor text"},
      {"three dimensions", dataset("platform/x", {H5T_IEEE_F64LE, {3, 3, 3}}), "too many dimensions"},
      {"compound type", dataset("platform/x", {[] {
                                  const hid_t t = H5Tcreate(H5T_COMPOUND, 16);
                                  H5Tinsert(t, "a", 0, H5T_NATIVE_DOUBLE);
                                  return t;
                                }()}),
       "neither numbers nor text"},
      {"opaque type", dataset("platform/x", {H5Tcreate(H5T_OPAQUE, 8)}), "neither numbers nor text"},
      {"text in place of numbers", dataset("platform/x", {H5Tcopy(H5T_C_S1)}), "platform/x"},
      {"column too short", dataset("platform/x", {H5T_IEEE_F64LE, {7}}), ""},
      {"column too long", dataset("events/nx", {H5T_IEEE_F64LE, {100000}}), ""},
      {"column missing", [](hid_t f) { H5Ldelete(f, "platform/y", H5P_DEFAULT); }, "platform/y has 0 rows"},
      {"column with two dimensions", dataset("platform/x", {H5T_IEEE_F64LE, {201, 2}}), "platform/x has 402 rows"},
      {"column without dimension", dataset("floes/time", {H5T_IEEE_F64LE, {}}), "a single value, not rows"},
      {"rows without values", dataset("floes/time", {H5T_IEEE_F64LE, {3, 0}}), "floes/time has rows without values"},
      {"time that falls", dataset("platform/time", {H5T_IEEE_F64LE, {201}, [](hid_t) {}, with(ramp, 100, 0.0)}),
       "platform/time does not ascend at row 100"},
      {"time that is no number", dataset("stats/time", {H5T_IEEE_F64LE, {201}, [](hid_t) {}, with(ramp, 3, nan)}),
       "stats/time does not ascend"},
      {"place that is no number", dataset("platform/x", {H5T_IEEE_F64LE, {201}, [](hid_t) {}, with(ramp, 3, nan)}),
       "platform/x holds a value that is not a number"},
      {"floes with one dimension", dataset("floes/x", {H5T_IEEE_F32LE, {10}}), "another shape"},
      {"fewer floes in one column", dataset("floes/theta", {H5T_IEEE_F32LE, {5, 1}}), "not one value for each floe"},
      {"group in place of a column",
       [](hid_t f) {
         H5Ldelete(f, "platform/x", H5P_DEFAULT);
         H5Gclose(H5Gcreate2(f, "platform/x", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
       },
       "nested too deep"},
      {"column in place of a group",
       [](hid_t f) {
         H5Ldelete(f, "stats", H5P_DEFAULT);
         put_dataset(f, "stats", {});
       }},
      {"group that holds itself",
       [](hid_t f) { H5Lcreate_hard(f, "/platform", f, "/platform/again", H5P_DEFAULT, H5P_DEFAULT); },
       "nested too deep"},
      {"type in place of a column",
       [](hid_t f) {
         const hid_t type = H5Tcopy(H5T_NATIVE_INT);
         H5Tcommit2(f, "other", type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
         H5Tclose(type);
       },
       "neither a group nor a dataset"},
      {"too many objects",
       [](hid_t f) {
         for (int i = 0; i < 1001; ++i)
           H5Lcreate_hard(f, "/platform/x", f, ("/events/e" + std::to_string(i)).c_str(), H5P_DEFAULT, H5P_DEFAULT);
       },
       "too many objects"},
      {"name of 5000 bytes",
       [](hid_t f) { H5Lcreate_hard(f, "/platform/x", f, std::string(5000, 'n').c_str(), H5P_DEFAULT, H5P_DEFAULT); },
       "a name is too long"},
      {"name that climbs", [](hid_t f) { put_dataset(f, "..", {}); }},
      {"corners without number", dataset("shape/vertex_count", {H5T_IEEE_F64LE, {2}, [](hid_t) {}, {nan, 1e300}}),
       "has 0 corners"},
      {"corners below zero", dataset("shape/vertex_count", {H5T_IEEE_F64LE, {2}, [](hid_t) {}, {-1.0, -2147483649.0}}),
       "has 0 corners"},
      {"schema that is a number",
       [](hid_t f) {
         H5Adelete(f, "gem_schema");
         const hid_t space = H5Screate(H5S_SCALAR);
         H5Aclose(H5Acreate2(f, "gem_schema", H5T_NATIVE_INT, space, H5P_DEFAULT, H5P_DEFAULT));
         H5Sclose(space);
       },
       "not a run file"},
      {"verdict lists that differ", [](hid_t f) { put_text(f, "gem_verdict_grades", "good"); },
       "its verdict is damaged"},
      {"case changed by hand", [](hid_t f) { put_text(f, "gem_case_toml", "[run]\nname = \"other\"\n"); },
       "does not have the SHA-256"},
      {"case without hash", [](hid_t f) { H5Adelete(f, "gem_case_sha256"); }, "does not have the SHA-256"},
      {"case that includes a file", [](hid_t f) { put_case(f, "include = [\"/etc/passwd\"]\n"); },
       "only a file can include others"},
      {"case that names a floe file",
       [](hid_t f) {
         put_case(f, "[floes]\nsource = \"file\"\npath = \"/etc/passwd\"\n[boundary]\npresent = false\n");
       }},
      {"case with a hostile name", [](hid_t f) { put_case(f, "[run]\nname = \"'; system('touch touched')\\n\"\n"); },
       "run.name: not fit for a file name"},
      {"case with quotes in its name", [](hid_t f) { put_case(f, "[run]\nname = \"'`touch touched`' <script>\"\n"); }},
      {"case with control characters", [](hid_t f) { put_case(f, "[run]\nname = \"a\" # \x1b[31m\n"); },
       "control characters"},
      {"case of brackets", [](hid_t f) { put_case(f, "a = " + std::string(50000, '[')); }, "nested too deep"},
      {"case with an unknown key", [](hid_t f) { put_case(f, "[run]\nshell = \"touch touched\"\n"); }, "unknown key"},
  };
}

}  // namespace gem
