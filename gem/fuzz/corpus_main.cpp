// Runs a fuzz target without libFuzzer: PROGRAM FOLDER RUNS. Every file of the folder, then RUNS inputs that are made
// of them with fixed random numbers, so that each call does the same on every machine. An input that ends the process
// is left in the file last_input_PROGRAM.
#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "gem/fuzz/target.h"

namespace {

using Random = std::mt19937_64;

/// A number below `bound`, which is not 0. The distributions of the standard library differ between machines.
std::size_t below(Random& random, std::size_t bound) { return static_cast<std::size_t>(random() % bound); }

std::vector<std::string> read_corpus(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> corpus;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return corpus;
}

/// One change: other bytes, a piece removed, or a piece of another input put in.
void change(std::string& input, const std::vector<std::string>& corpus, Random& random) {
  const std::size_t at = below(random, input.size() + 1);
  switch (below(random, 4)) {
    case 0:
      if (at < input.size()) input[at] = static_cast<char>(random());
      break;
    case 1:
      if (at < input.size()) input[at] ^= static_cast<char>(1 << below(random, 8));
      break;
    case 2:
      input.erase(at, below(random, 32));
      break;
    default: {
      const std::string& other = corpus[below(random, corpus.size())];
      input.insert(at, other.substr(below(random, other.size() + 1), below(random, 64)));
    }
  }
}

/// A size that a damaged file claims must end in an exception, not in a machine without memory.
void limit_memory() {
#ifndef __SANITIZE_ADDRESS__  // reserves terabytes of addresses
  const rlimit limit{rlim_t{4} << 30, rlim_t{4} << 30};
  setrlimit(RLIMIT_AS, &limit);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t runs = 0;
  const std::string count = argc == 3 ? argv[2] : "";
  if (argc != 3 || std::from_chars(count.data(), count.data() + count.size(), runs).ec != std::errc()) {
    std::cerr << "usage: " << argv[0] << " FOLDER RUNS\n";
    return 2;
  }
  limit_memory();
  const std::vector<std::string> corpus = read_corpus(argv[1]);
  const std::filesystem::path last = "last_input_" + std::filesystem::path(argv[0]).filename().string();
  const auto run = [&](const std::string& input) {
    std::ofstream(last, std::ios::binary) << input;
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  };
  for (const std::string& input : corpus) run(input);
  Random random(1);
  for (std::size_t i = 0; i < runs; ++i) {
    std::string input = corpus.at(below(random, corpus.size()));
    for (std::size_t changes = 1 + below(random, 8); changes > 0; --changes) change(input, corpus, random);
    run(input);
  }
  std::filesystem::remove(last);
  std::cout << corpus.size() << " files of the corpus and " << runs << " changed ones: no fault\n";
}
