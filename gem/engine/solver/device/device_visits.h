// The points of a round on a device: load, visit and store. Each point belongs to one thread, which also writes what
// the point pushes its bodies by.
#pragma once

#include "gem/engine/solver/device/device_base.h"
#include "gem/engine/solver/device/device_loaded.h"

namespace gem {

template <class Group>
class SolverVisits {
 public:
  /// Iteration numbers in records. plain: the record carries no number. first_number: of the first push of a round with
  /// halos.
  static constexpr std::uint32_t plain = 0, first_number = 1;

  /// Where a point reads the motion of one of its bodies and writes its record.
  GEM_DEVICE static LoadedPlace place_of(const DeviceScene& s, Group& group, const PointSide& side) {
    return {motion_at(s, group, side), record_at(s, group, side.place, side.shared_record)};
  }

  /// Computes the numbers of a point at the start of a round. `extrapolated`, the extrapolated additions, continues
  /// from the last round less what has entered the base.
  GEM_DEVICE GEM_INLINE static void enter(const DeviceScene& s, std::int32_t i, bool fresh, const LoadedCell& cell,
                                          LoadedPoint& loaded) {
    if (fresh)
      loaded.extrapolated = {0.0F, 0.0F, 0.0F};
    else
      cell.load_additions(loaded);
    const PointCell& point = s.taken_point[i];
    const PointGeometry<double> geometry = s.points.geometry(i);
    set_geometry_values(loaded.frame, geometry);
    set_base_values(loaded.frame, geometry, s.points.spare(i), s.points.impulse(i), solved_motion(s, point.a.body),
                    solved_motion(s, point.b.body));
    loaded.added = {0.0F, 0.0F, 0.0F};
  }

  /// Prepares a point in memory for a round, and pushes its bodies unless `fresh`.
  GEM_DEVICE GEM_INLINE static void load(const DeviceScene& s, Group& group, std::int32_t i, bool fresh) {
    const LoadedCell cell = LoadedTable(s, group.shared_memory(), group.shared().workspace)[i];
    LoadedPoint loaded;
    enter(s, i, fresh, cell, loaded);
    const PointCell& point = s.taken_point[i];
    loaded.a = place_of(s, group, point.a);
    loaded.b = place_of(s, group, point.b);
    cell.save_numbers(loaded);
    cell.set_places(loaded.a, loaded.b);
    if constexpr (Group::has_halos)
      if (group.shared().workspace.has_halo) {
        clear_numbers(s, loaded.a.record);
        clear_numbers(s, loaded.b.record);
        if (!fresh) push(s, loaded, first_number);
        return;
      }
    if (!fresh) push(s, loaded, plain);
  }

  /// Adds the additions of the round to the base.
  GEM_DEVICE GEM_INLINE static void add_to_base(const DeviceScene& s, Group& group, std::int32_t i) {
    const LoadedCell cell = LoadedTable(s, group.shared_memory(), group.shared().workspace)[i];
    LoadedPoint loaded = cell.load();
    const PointGeometry<double> g = s.points.geometry(i);
    write_base(s, i, s.taken_point[i], g,
               with_additions(s.constants.point_friction, g, s.points.spare(i), s.points.impulse(i), loaded.added,
                              loaded.frame.least, loaded.frame.most, loaded.frame.repair_least));
    loaded.extrapolated.normal -= loaded.added.normal;
    loaded.extrapolated.tangential -= loaded.added.tangential;
    loaded.extrapolated.repair -= loaded.added.repair;
    cell.save_additions(loaded);
  }

  /// Points of a thread that stay in registers while a round runs.
  static constexpr int kept = Group::kept_points;
  struct KeptPoints {
    LoadedPoint point[kept > 0 ? kept : 1];
    std::int32_t count = 0;
    bool more = false;  // some points of the block are not in registers
  };

  /// Visits the points of this thread. Returns the largest speed residual of its points [m/s] where `judged`, else 0.
  template <PointFriction law, bool judged>
  GEM_DEVICE GEM_INLINE static float visit_all(const DeviceScene& s, Group& group, const SolverWorkspace& workspace,
                                               KeptPoints& own, float momentum_coefficient, std::uint32_t number) {
    float most = 0.0F;
    const StepLength<float> pace = workspace.pace;
    const auto visit_loaded = [&](LoadedPoint& loaded) {
      most = larger(visit<law, judged>(s, pace, loaded, momentum_coefficient, number), most);
    };
    for (int k = 0; k < kept; ++k)
      if (k < own.count) visit_loaded(own.point[k]);
    if (!own.more) return most;
    const auto visit_cell = [&](const LoadedCell& cell) {
      LoadedPoint loaded = cell.load();
      visit_loaded(loaded);
      cell.save_additions(loaded);
    };
    // a loop for each kind of memory: the compiler has faster instructions where it knows which it is
    const LoadedTable table(s, group.shared_memory(), workspace);
    const std::int32_t size = group.threads(), end = workspace.points.end;
    std::int32_t i = workspace.points.begin + group.thread() + kept * size;
    if constexpr (Group::reads_other_blocks)
      for (; i < workspace.shared_points.end; i += size) visit_cell(table.in_shared(i));
    for (; i < end; i += size) visit_cell(table.in_global(i));
    return most;
  }

  /// load() brings the points of a thread to registers. save() writes back what visits have changed.
  GEM_DEVICE GEM_INLINE static void load(const DeviceScene& s, Group& group, const SolverWorkspace& workspace,
                                         KeptPoints& own) {
    const std::int32_t size = group.threads(), first = workspace.points.begin + group.thread(),
                       end = workspace.points.end;
    own.more = workspace.points.count() > kept * size;
    for (int k = 0; k < kept; ++k)
      if (first + k * size < end) {
        own.point[k] = LoadedTable(s, group.shared_memory(), workspace)[first + k * size].load();
        own.count = k + 1;
      }
  }
  GEM_DEVICE GEM_INLINE static void save(const DeviceScene& s, Group& group, const SolverWorkspace& workspace,
                                         const KeptPoints& own) {
    const std::int32_t size = group.threads(), first = workspace.points.begin + group.thread(),
                       end = workspace.points.end;
    for (int k = 0; k < kept; ++k)
      if (first + k * size < end)
        LoadedTable(s, group.shared_memory(), workspace)[first + k * size].save_additions(own.point[k]);
  }

 private:
  GEM_DEVICE static PushRecord* record_at(const DeviceScene& s, Group& group, std::int32_t place,
                                          std::int32_t shared_record) {
    if constexpr (Group::reads_other_blocks)
      if (shared_record >= 0)
        return reinterpret_cast<PushRecord*>(group.shared_memory_of(shared_record >> 16)) + (shared_record & 0xffff);
    if (place < 0) return nullptr;
    if (Group::has_halos && group.shared().workspace.has_halo)
      return reinterpret_cast<PushRecord*>(reinterpret_cast<NumberedPush*>(s.push_base) + place);
    return s.push + place;
  }
  GEM_DEVICE static const AddedMotion* motion_at(const DeviceScene& s, Group& group, const PointSide& side) {
    if constexpr (Group::reads_other_blocks)
      if (side.motion >= 0)
        return reinterpret_cast<const AddedMotion*>(group.shared_memory_of(side.motion >> 16)) + (side.motion & 0xffff);
    if (Group::has_halos && group.shared().workspace.has_halo && side.place >= 0)
      return group.shared().workspace.motion + side.motion;
    return s.added + side.body;
  }
  GEM_DEVICE static Motion<double> solved_motion(const DeviceScene& s, std::int32_t body) {
    const SolvedMotion& m = s.solved[body];
    return {m.part[0], m.part[1], m.part[4], m.part[2], m.part[3], m.part[5]};
  }

  GEM_DEVICE GEM_INLINE static void write(const DeviceScene& s, PushRecord* record, const PointPush<float>& p,
                                          float twist, float turn, std::uint32_t number) {
    if (!record) return;  // a fixed body
    if constexpr (Group::has_halos)
      if (number != plain) {
        NumberedPush* const to = numbered(s, record, number);
        Group::write_whole(&to->half[0], {{p.x, p.y, p.shift_x}, number});
        Group::write_whole(&to->half[1], {{p.shift_y, twist, turn}, number});
        return;
      }
    record->pair[0] = {{p.x, p.y}};
    record->pair[1] = {{p.shift_x, p.shift_y}};
    record->pair[2] = {{twist, turn}};
  }
  /// Writes what a point pushes both bodies by. `number`: the iteration's with halos, else plain.
  GEM_DEVICE GEM_INLINE static void push(const DeviceScene& s, const LoadedPoint& loaded, std::uint32_t number) {
    const PointPush<float> p = push_of(loaded.frame, loaded.extrapolated);
    write(s, loaded.a.record, p, p.twist_a, p.turn_a, number);
    write(s, loaded.b.record, p, p.twist_b, p.turn_b, number);
  }
  /// Clears the numbers of a record before a round with halos. Its memory still holds the base or an earlier round,
  /// whose numbers may occur again. They must not be taken for records of this round.
  GEM_DEVICE static void clear_numbers(const DeviceScene& s, PushRecord* record) {
    if (!record) return;
    for (std::uint32_t turn = 0; turn < 2; ++turn)
      for (NumberedHalf& half : numbered(s, record, turn)->half) Group::write_whole(&half, {});
  }
  /// Address of a record of one iteration. Even and odd iterations have separate arrays, so the records of a row stay
  /// next to each other.
  GEM_DEVICE GEM_INLINE static NumberedPush* numbered(const DeviceScene& s, PushRecord* record, std::uint32_t number) {
    return reinterpret_cast<NumberedPush*>(record) + static_cast<std::int32_t>(number % 2) * s.push_capacity;
  }

  template <PointFriction law, bool judged>
  GEM_DEVICE GEM_INLINE static float visit(const DeviceScene& s, StepLength<float> pace, LoadedPoint& loaded,
                                           float momentum_coefficient, std::uint32_t number) {
    const AddedMotion a = *loaded.a.motion, b = *loaded.b.motion;
    const FloatPair &turn_a = a.pair[2], &turn_b = b.pair[2];
    const Approach<float> w{b.pair[0].part[0] - a.pair[0].part[0],
                            b.pair[0].part[1] - a.pair[0].part[1],
                            b.pair[1].part[0] - a.pair[1].part[0],
                            b.pair[1].part[1] - a.pair[1].part[1],
                            turn_a.part[0],
                            turn_a.part[1],
                            turn_b.part[0],
                            turn_b.part[1]};
    const PointImpulse<float> step =
        visit_point<law>(loaded.frame, w, pace, momentum_coefficient, loaded.added, loaded.extrapolated);
    push(s, loaded, number);  // before the residual: other threads wait for the record
    return judged ? remaining_speed<law>(loaded.frame, step, pace) : 0.0F;
  }
};

}  // namespace gem
