// What the study programs have in common: arguments, files and exit codes.
#pragma once

#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "gem/base/error.h"
#include "gem/base/number_text.h"

namespace gem::study {

inline double positive(const std::string& text) {
  const auto value = parse_number(text);
  if (!value || !(*value > 0.0))
    throw Error(ExitCode::usage, "'" + text + "' is no number above 0 (of seconds or threads); give one");
  return *value;
}

inline void write(const std::string& name, const std::string& text) {
  std::ofstream file(name, std::ios::binary);
  file << text;
  file.close();
  if (!file)
    throw Error(ExitCode::file_system, "cannot write " + name + " (disk full or no permission); choose another");
}

/// The exit code of a program that calls run(arguments). Errors are reported on standard error.
template <class Run>
int exit_code_of(const char* program, int count, char** words, Run run) {
  try {
    return run(std::vector<std::string>(words + 1, words + count));
  } catch (const Error& error) {
    std::cerr << program << ": " << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}

}  // namespace gem::study
