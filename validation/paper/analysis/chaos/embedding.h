// Delay embedding of a record, and the nearest neighbours of its states.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gem {

struct Embedding {
  std::size_t dimension = 3;
  std::size_t delay = 1;    // samples between the coordinates
  std::size_t theiler = 1;  // neighbours must be further apart in time than this many samples: at least one period
};

/// States (x[i], x[i + delay], ...) of a record: their number, and the distance between two of them.
class States {
 public:
  /// Throws std::invalid_argument unless there are at least two states and every option is positive.
  States(std::span<const double> signal, const Embedding& embedding);

  std::size_t count() const { return count_; }
  /// The `wanted` states nearest to state `of` among the first `candidates`, nearest first. Fewer if not enough lie
  /// outside the Theiler window.
  std::vector<std::size_t> nearest(std::size_t of, std::size_t candidates, std::size_t wanted) const;

 private:
  double squared_distance(std::size_t a, std::size_t b) const;

  std::span<const double> signal_;
  Embedding embedding_;
  std::size_t count_ = 0;
};

}  // namespace gem
