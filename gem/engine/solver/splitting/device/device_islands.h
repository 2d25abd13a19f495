// Finds the islands of a time step on a device: each body gets the root of its island, which is the body of the lowest
// rank. Large islands come first.
#pragma once

#include "gem/engine/device/scene.h"
#include "gem/engine/solver/device/device_solver_list.h"

namespace gem {

GEM_DEVICE inline std::int32_t size_class(std::int32_t records) {
  std::int32_t k = 0;
  while (records > 1) records >>= 1, ++k;
  return k;
}

template <class Group>
class IslandFinder {
 public:
  GEM_DEVICE IslandFinder(const DeviceScene& s, Group& group) : s_(s), m_(s.island), group_(group) {}

  /// Clears the counts of the last time step, and makes each body an island; a barrier has to follow.
  GEM_DEVICE void begin() {
    auto* const words = reinterpret_cast<std::int32_t*>(m_.counters);
    for (std::int32_t w = rank_of(group_); w < static_cast<std::int32_t>(sizeof(IslandCounters) / sizeof(*words));
         w += size_of(group_))
      words[w] = 0;
    each_entry([&](std::int32_t e, const SolverEntry& entry) {
      m_.rank[entry.body] = entry.rank;
      m_.entry[entry.rank] = e;
      m_.joined[entry.rank] = entry.rank;
      m_.weight[entry.rank] = 0;
    });
    each_point(group_, [&](std::int32_t i) {
      const PointCell& point = s_.point[s_.taken[i]];
      if (point.a.place >= 0) m_.taken_of_record[point.a.place] = i;
      if (point.b.place >= 0) m_.taken_of_record[point.b.place] = i;
    });
  }

  GEM_DEVICE void find() {
    const std::int32_t bodies = group_.shared().workspace.bodies;
    if (rank_of(group_) == 0) m_.counters->bodies = bodies;
    each_point(group_, [&](std::int32_t i) {
      const PointCell& point = s_.point[s_.taken[i]];
      if (point.a.place >= 0 && point.b.place >= 0) join(m_.rank[point.a.body], m_.rank[point.b.body]);
    });
    group_.barrier();
    each_entry([&](std::int32_t, const SolverEntry& entry) {
      std::int32_t root = entry.rank;
      while (m_.joined[root] != root) root = m_.joined[root];
      m_.root[entry.rank] = root;
      group_.add(&m_.weight[root], entry.count);
    });
    group_.barrier();
    each_root([&](std::int32_t rank) {
      group_.add(&m_.counters->of_class[size_class(m_.weight[rank])], 1);
      group_.add(&m_.counters->islands, 1);
      if (m_.weight[rank] >= m_.large_island) group_.add(&m_.counters->large, 1);
      if (m_.weight[rank] >= m_.small_island) group_.add(&m_.counters->not_small, 1);
    });
    group_.barrier();
    each_root([&](std::int32_t rank) {
      const std::int32_t k = size_class(m_.weight[rank]);
      std::int32_t before = 0;
      for (std::int32_t j = k + 1; j < island_classes; ++j) before += m_.counters->of_class[j];
      m_.island[before + group_.add(&m_.counters->placed[k], 1)] = rank;
    });
  }

 private:
  template <class Work>
  GEM_DEVICE void each_entry(Work&& work) {
    const SolverWorkspace& workspace = group_.shared().workspace;
    for (std::int32_t e = workspace.own.begin + group_.thread(); e < workspace.own.end; e += group_.threads())
      work(e, s_.solver_entry[e]);
  }
  template <class Work>
  GEM_DEVICE void each_root(Work&& work) {
    each_entry([&](std::int32_t, const SolverEntry& entry) {
      if (m_.root[entry.rank] == entry.rank) work(entry.rank);
    });
  }

  GEM_DEVICE std::int32_t root_of(std::int32_t rank) {
    for (;;) {
      const std::int32_t next = group_.add(&m_.joined[rank], 0);
      if (next == rank) return rank;
      rank = next;
    }
  }

  /// Joins the islands of two bodies; the root is the lower one of both roots. Threads may join side by side.
  GEM_DEVICE void join(std::int32_t a, std::int32_t b) {
    for (;;) {
      a = root_of(a);
      b = root_of(b);
      if (a == b) return;
      const std::int32_t high = a > b ? a : b, low = a > b ? b : a;
      if (group_.exchange_if(&m_.joined[high], high, low)) return;
    }
  }

  const DeviceScene& s_;
  const IslandMemory& m_;
  Group& group_;
};

}  // namespace gem
