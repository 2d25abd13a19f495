// What the fuzz targets share. A reader may refuse any input with gem::Error; every other exception is a fault.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/scene/scene_def.h"

/// The function that each target defines: reads one input. A fault ends the process.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace gem::fuzz {

/// Ends the process with a message if the condition is false.
void expect(bool condition, const char* message);

/// Calls the reader. Returns false if it refused its input.
template <class Reader>
bool accepted(Reader reader) {
  try {
    reader();
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Ends the process unless the scene, written as text and read again, is the same.
void check_round_trip(const SceneDef& scene);

/// Makes the field of listed floes, as `gem case check` does; floes from other sources are left out.
void make_listed_field(const SceneDef& scene);

/// Path of a file with this name in a temporary folder that lives as long as the process. Each call replaces it.
std::string input_file(const std::string& name, const std::string& content);

/// The input as a file: an HDF5 file as it is, anything else as a description.
std::string hdf5_input(const std::string& name, const std::string& input);

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace gem::fuzz
