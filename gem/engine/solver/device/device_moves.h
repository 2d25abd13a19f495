// The motions of bodies under the additions of a round: each body adds the records of its row in order.
#pragma once

#include "gem/engine/solver/device/device_solver_list.h"

namespace gem {

template <class Group>
class SolverMoves {
 public:
  /// As CoupledRounds::move(). The platform comes first among the block's bodies if it is one of them. It has a long
  /// row, so the last warp does it alone.
  GEM_DEVICE GEM_INLINE static void move(const DeviceScene& s, Group& group, const SolverWorkspace& workspace) {
    constexpr int warp = Group::Warp::size;
    const bool alone = group.threads() <= warp;
    const int rest = workspace.platform && !alone ? group.threads() - warp : group.threads();
    if (workspace.platform && (alone || group.thread() >= rest)) move_platform(s, group, workspace);
    if (group.thread() < rest) move_floes(s, group, workspace, rest);
  }

  template <int pairs>
  struct PairsOf {
    FloatPair pair[pairs];
  };

  /// Sums some pairs of numbers of a row: the part as B less the part as A. One pass does both parts, because a load
  /// from memory takes longer than the additions of a short row. Zeros replace the terms of the other part and those
  /// beyond the last. They change no sum that began with +0.
  template <int pairs, int together>
  GEM_DEVICE GEM_INLINE static PairsOf<pairs> sum_at_once(const PushRecord* record, std::int32_t as_b_count,
                                                          std::int32_t count, int from) {
    PairsOf<pairs> to_b{}, to_a{};
    GEM_NO_UNROLL
    for (std::int32_t first = 0; first < count; first += together) {
      PairsOf<pairs> some[together];
      for (int k = 0; k < together; ++k)
        for (int j = 0; j < pairs; ++j)
          some[k].pair[j] = first + k < count ? record[first + k].pair[from + j] : FloatPair{};
      for (int k = 0; k < together; ++k) {
        const bool as_b = first + k < as_b_count;
        for (int j = 0; j < pairs; ++j)
          for (int c = 0; c < 2; ++c) {
            const float term = some[k].pair[j].part[c];
            to_b.pair[j].part[c] += as_b ? term : 0.0F;
            to_a.pair[j].part[c] += as_b ? 0.0F : term;
          }
      }
    }
    for (int j = 0; j < pairs; ++j)
      for (int c = 0; c < 2; ++c) to_b.pair[j].part[c] -= to_a.pair[j].part[c];
    return to_b;
  }

  /// One lane adds up each number of the platform's motion. The records are copied to shared memory first if they are
  /// not there and fit. The platform has the lowest id, so it is always body A.
  GEM_DEVICE GEM_INLINE static void move_platform(const DeviceScene& s, Group& group,
                                                  const SolverWorkspace& workspace) {
    const auto warp = group.warp();
    const SolverEntry entry = workspace.moved_entry[workspace.moved.begin];
    const auto* record = reinterpret_cast<const float*>(s.push + entry.place);
    auto* const shared_memory = reinterpret_cast<float*>(group.shared_memory());
    if ((Group::reads_other_blocks || Group::has_halos) && entry.shared_record >= 0) {
      record = shared_memory + parts * entry.shared_record;
    } else if (!Group::reads_other_blocks &&
               static_cast<std::size_t>(entry.count) * sizeof(PushRecord) <= workspace.stage_bytes) {
      fetch(warp, reinterpret_cast<FloatPair*>(shared_memory), s.push + entry.place, entry.count);
      warp.sync();
      record = shared_memory;
    }
    auto* const motion =
        reinterpret_cast<float*>(workspace.motion ? &workspace.motion[workspace.moved.begin] : &s.added[entry.body]);
    for (int part = warp.rank(); part < parts; part += Group::Warp::size)
      motion[part] = (part < parts - 2 ? entry.inverse_mass : entry.inverse_inertia) *
                     (0.0F - sum_of_part(record + part, entry.count));
    warp.sync();
  }

 private:
  /// Numbers of a record or a motion.
  static constexpr int parts = 2 * motion_pairs;

  /// One thread for each pair of numbers of a body if there are enough threads, else one thread for each body.
  GEM_DEVICE GEM_INLINE static void move_floes(const DeviceScene& s, Group& group, const SolverWorkspace& workspace,
                                               int threads) {
    const std::int32_t floes = workspace.moved.count() - (workspace.platform ? 1 : 0);
    if (motion_pairs * floes <= threads)
      move_floes_by<1>(s, group, workspace, threads);
    else
      move_floes_by<motion_pairs>(s, group, workspace, threads);
  }

  template <int pairs>
  GEM_DEVICE GEM_INLINE static void move_floes_by(const DeviceScene& s, Group& group, const SolverWorkspace& workspace,
                                                  int threads) {
    constexpr int of_body = motion_pairs / pairs;
    const auto* const shared_memory = reinterpret_cast<const PushRecord*>(group.shared_memory());
    const std::int32_t first = of_body * (workspace.moved.begin + (workspace.platform ? 1 : 0)),
                       end = of_body * workspace.moved.end;
    for (std::int32_t k = first + group.thread(); k < end; k += threads) {
      const int from = pairs * (k % of_body);
      const SolverEntry entry = workspace.moved_entry[k / of_body];
      const PairsOf<pairs> sum = Group::reads_other_blocks && entry.shared_record >= 0
                                     ? sum_of<pairs>(shared_memory + entry.shared_record, entry, from)
                                     : sum_of<pairs>(s.push + entry.place, entry, from);
      const std::int32_t e = workspace.in_order ? entry.rank : k / of_body;
      AddedMotion& motion = workspace.motion ? workspace.motion[e] : s.added[entry.body];
      for (int j = 0; j < pairs; ++j) {
        const float answer = from + j < motion_pairs - 1 ? entry.inverse_mass : entry.inverse_inertia;
        motion.pair[from + j] = {{answer * sum.pair[j].part[0], answer * sum.pair[j].part[1]}};
      }
    }
  }

  /// The sum of a body's records as B less that of its records as A.
  template <int pairs>
  GEM_DEVICE GEM_INLINE static PairsOf<pairs> sum_of(const PushRecord* record, const SolverEntry& entry, int from) {
    if constexpr (Group::has_halos) {
      return sum_at_once<pairs, 8>(record, entry.as_b, entry.count, from);
    } else {
      PairsOf<pairs> to_b = sum_of<pairs>(record, 0, entry.as_b, from);
      const PairsOf<pairs> to_a = sum_of<pairs>(record, entry.as_b, entry.count, from);
      for (int j = 0; j < pairs; ++j)
        for (int c = 0; c < 2; ++c) to_b.pair[j].part[c] -= to_a.pair[j].part[c];
      return to_b;
    }
  }

  /// Loads a few records together, then adds them in order. Zeros stand beyond the last: the threads of a warp do not
  /// diverge, and zeros change no sum that began with +0.
  template <int pairs>
  GEM_DEVICE GEM_INLINE static PairsOf<pairs> sum_of(const PushRecord* record, std::int32_t begin, std::int32_t end,
                                                     int from) {
    constexpr int together = 4;
    PairsOf<pairs> sum{};
    GEM_NO_UNROLL
    for (std::int32_t first = begin; first < end; first += together) {
      PairsOf<pairs> some[together];
      for (int k = 0; k < together; ++k)
        for (int j = 0; j < pairs; ++j)
          some[k].pair[j] = first + k < end ? record[first + k].pair[from + j] : FloatPair{};
      for (const PairsOf<pairs>& term : some)
        for (int j = 0; j < pairs; ++j)
          for (int c = 0; c < 2; ++c) sum.pair[j].part[c] += term.pair[j].part[c];
    }
    return sum;
  }

  /// Copies a row to shared memory.
  template <class Warp>
  GEM_DEVICE GEM_INLINE static void fetch(const Warp& warp, FloatPair* to, const PushRecord* row,
                                          std::int32_t records) {
    constexpr int together = 16;
    const auto* const from = reinterpret_cast<const FloatPair*>(row);
    const std::int32_t pairs = motion_pairs * records;
    for (std::int32_t first = warp.rank(); first < pairs; first += together * Warp::size) {
      FloatPair some[together];
      for (int k = 0; k < together; ++k)
        if (first + k * Warp::size < pairs) some[k] = from[first + k * Warp::size];
      for (int k = 0; k < together; ++k)
        if (first + k * Warp::size < pairs) to[first + k * Warp::size] = some[k];
    }
  }

  /// Sums one number over a long row. Some are loaded together, then added in order. Zeros beyond the last change no
  /// sum that began with +0.
  GEM_DEVICE GEM_INLINE static float sum_of_part(const float* record, std::int32_t count) {
    constexpr int together = 8;
    float sum = 0.0F;
    GEM_NO_UNROLL
    for (std::int32_t first = 0; first < count; first += together) {
      float some[together];
      for (int j = 0; j < together; ++j) some[j] = first + j < count ? record[parts * (first + j)] : 0.0F;
      for (const float term : some) sum += term;
    }
    return sum;
  }
};

}  // namespace gem
