// One scene on the device: its memory, and the copy of its field on the host.
#pragma once

#include <cuda_runtime.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "gem/engine/cuda/cuda_kernel.h"
#include "gem/engine/cuda/cuda_memory.cuh"
#include "gem/engine/device/scene_image.h"
#include "gem/engine/device/scene_layout.h"
#include "gem/engine/step/books.h"
#include "gem/scene/scene_drive.h"

namespace gem {

class CudaScene {
 public:
  /// `status`: where the scene's status stands on the device. `blocks`: the most blocks that ever work on the scene.
  CudaScene(BatchScene scene, const CudaOptions& options, int blocks, DeviceStatus* status) : status_(status) {
    check_solver(scene.scene.contact.solver, {ContactSolver::independent, ContactSolver::coupled}, "cuda");
    check_device_steps(std::llround(scene.scene.run.duration_s / scene.scene.numerics.time_step_s));
    mooring_ = mooring_tables(scene.scene.mooring.law, scene.scene.mooring_design);
    dp_ = dp_law_of(scene.scene, scene.bodies);
    const StepConstants constants = step_constants(scene.scene, scene.bodies, mooring_.view(), &dp_);
    drives_ = drive_schedule(scene.scene);
    field_ = make_field_state(std::move(scene.bodies), constants);
    ledger_.start = total(field_);
    device_ = scene_constants(field_);
    sizes_ = scene_sizes(field_);
    allow_for(scene.scene, sizes_);
    sizes_.samples = options.ring_steps;
    sizes_.drives = drives_.varies();
    sizes_.blocks = std::max(blocks, largest_cluster);
    if (options.list_rows > 0) sizes_.rows = options.list_rows;
    device_.wants_samples = options.samples;
    field_memory_ = DeviceMemory(place_field(device_, sizes_, nullptr));
    place_field(device_, sizes_, field_memory_.data());
    device_.status = status_;
    make_list();
    upload();
  }

  const DeviceScene& device() const { return device_; }
  const FieldState& field() const { return field_; }
  std::int64_t step() const { return step_; }

  /// What the next calls record; a null `log`: no events.
  void want(const StepLog* log) {
    device_.wants_events = log && log->wants_events;
    device_.wants_forces = !has_contact_forces()      ? ForcesWanted::none
                           : log && log->wants_forces ? ForcesWanted::all
                                                      : ForcesWanted::last;
  }

  /// Throws Error(usage) if the device cannot count `steps` more time steps, and Error(numerical_stop) if a state that
  /// was given is not finite. Every engine checks such a state before it goes on from it.
  void check_start(std::int64_t steps) {
    check_device_steps(step_ + steps);
    if (fresh_) check_finite(field_, step_);
    fresh_ = false;
  }

  /// Sends what drives the bodies in the next `steps` time steps.
  void send_drives(std::int64_t steps, cudaStream_t stream) {
    if (!drives_.varies()) return;
    write_drives(drives_, step_, steps, reinterpret_cast<Drive*>(drive_copy_.data()));
    check_cuda(cudaMemcpyAsync(const_cast<Drive*>(device_.drive), drive_copy_.data(),
                               sizeof(Drive) * (static_cast<std::size_t>(steps) + 1), cudaMemcpyHostToDevice, stream),
               "send the drive");
  }

  /// Notes the status after a call. The copies on the host are stale then.
  void note(const DeviceStatus& status) {
    step_ = status.step;
    carried_ = status.carried;
    host_state_valid_ = host_books_valid_ = false;
    if (status.samples > 0) last_forces_.clear();
  }

  /// Begins to fetch the rings of the last call, which `blocks` blocks made.
  void fetch(const DeviceStatus& status, int blocks, cudaStream_t stream) {
    if (status.samples == 0) return;
    const auto steps = static_cast<std::size_t>(status.samples) * static_cast<std::size_t>(blocks);
    fetch(device_.overlap_count, device_.quality + steps, stream);  // the samples stand between them
    fetch(device_.event, device_.event + status.events, stream);
    fetch(device_.force, device_.force + std::min(status.forces, device_.forces_capacity), stream);
  }

  /// Appends the rings to `log`, after fetch() has completed.
  void append(const DeviceStatus& status, int blocks, StepLog& log) {
    if (status.samples == 0) return;
    DeviceScene rings;
    rings.wants_samples = device_.wants_samples;
    place_rings(rings, sizes_, host_ring_.data());
    append_log(field_, rings, status, blocks, log);
    if (!has_contact_forces()) return;
    const std::vector<StepForce> forces = forces_of_call(rings, status);
    last_forces_ = forces_of_last_step(forces, status.step);
    if (log.wants_forces) log.forces.insert(log.forces.end(), forces.begin(), forces.end());
  }

  /// Enlarges the memory of the list.
  void grow(const DeviceStatus& status) {
    const auto enough = [](std::int32_t now, std::int32_t needed) { return needed > now ? needed + needed / 4 : now; };
    sizes_.rows = enough(sizes_.rows, status.rows_needed);
    sizes_.platform_rows = enough(sizes_.platform_rows, status.platform_needed);
    const std::vector<CarriedMemory> memory = carried();
    make_list();
    send(memory);
  }

  const Bodies& bodies() {
    if (!host_state_valid_) {
      check_cuda(cudaMemcpy(state_copy_.data(), device_.state, sizeof(BodyState) * field_.bodies.count(),
                            cudaMemcpyDeviceToHost),
                 "fetch the state");
      read_state(reinterpret_cast<const BodyState*>(state_copy_.data()), field_);
      host_state_valid_ = true;
    }
    return field_.bodies;
  }

  LineSet broken_lines() {
    if (sizes_.mooring_branches == 0) return 0;
    fetch_books();
    return field_.broken;
  }

  const DpState* dp_state() {
    if (!sizes_.dp) return nullptr;
    fetch_books();
    return &field_.dp;
  }

  bool has_contact_forces() const { return sizes_.forces != ForcesWanted::none; }
  const std::vector<ContactForce>& contact_forces() const { return last_forces_; }

  Ledger ledger() {
    fetch_books();
    return closed_books(field_, ledger_);
  }

  EngineState save() {
    fetch_books();
    EngineState state{step_,         field_.bodies, saved_books(field_, ledger_), field_.books, {}, {},
                      field_.broken, field_.dp};
    save_memory(carried(), state);
    return state;
  }

  void restore(const EngineState& state) {
    field_ = make_field_state(state.bodies, field_.constants);
    open_books(field_, state);
    ledger_ = state.ledger;
    step_ = state.step;
    const std::vector<CarriedMemory> memory = carried_memory(state);
    if (2 * memory.size() > static_cast<std::size_t>(sizes_.rows)) {
      sizes_.rows = static_cast<std::int32_t>(2 * memory.size());
      make_list();
    }
    carried_ = static_cast<std::int32_t>(memory.size());
    last_forces_.clear();
    hold_corners();
    upload();
    send(memory);
  }

 private:
  /// Brings the copies of the state and the books on the host up to date.
  void fetch_books() {
    bodies();
    if (host_books_valid_) return;
    PlatformCell platform;
    check_cuda(
        cudaMemcpy(field_.books.data(), device_.books, sizeof(Quantity) * field_.books.size(), cudaMemcpyDeviceToHost),
        "fetch the books");
    check_cuda(cudaMemcpy(&platform, device_.platform, sizeof platform, cudaMemcpyDeviceToHost), "fetch the books");
    field_.mooring_force = platform.mooring_force;
    field_.broken = platform.broken;
    if (sizes_.dp)
      check_cuda(cudaMemcpy(&field_.dp, device_.dp, sizeof field_.dp, cudaMemcpyDeviceToHost), "fetch the books");
    host_books_valid_ = true;
  }

  /// Fetches a part of the rings.
  void fetch(const void* begin, const void* end, cudaStream_t stream) {
    const auto* const from = static_cast<const std::byte*>(begin);
    const std::size_t at = from - ring_memory_.data(), bytes = static_cast<const std::byte*>(end) - from;
    if (bytes == 0) return;
    check_cuda(cudaMemcpyAsync(host_ring_.data() + at, from, bytes, cudaMemcpyDeviceToHost, stream),
               "fetch the record");
  }

  /// Enlarges the memory of the field for a state with more corners than the case allows.
  void hold_corners() {
    const auto corners = static_cast<std::int32_t>(field_.bodies.vertex.size());
    if (corners <= sizes_.vertices) return;
    sizes_.vertices = corners;
    field_memory_ = DeviceMemory(place_field(device_, sizes_, nullptr));
    place_field(device_, sizes_, field_memory_.data());
    device_.status = status_;
  }

  void upload() {
    DeviceScene here = device_;
    DeviceStatus status;
    std::vector<std::byte> image(field_memory_.bytes());
    place_field(here, sizes_, image.data());
    write_field(field_, step_, here);
    status = *here.status;
    status.carried = carried_;
    check_cuda(cudaMemcpy(field_memory_.data(), image.data(), image.size(), cudaMemcpyHostToDevice),
               "upload the field");
    check_cuda(cudaMemcpy(status_, &status, sizeof status, cudaMemcpyHostToDevice), "upload the field");
    forget_list();
    wait_for_copies();
    if (state_copy_.bytes() == 0) state_copy_ = PinnedMemory(sizeof(BodyState) * field_.bodies.count());
    fresh_ = host_state_valid_ = host_books_valid_ = true;
  }

  /// The impulses of the last time step's points; a coupled scene keeps them on the device.
  std::vector<CarriedMemory> carried() const {
    std::vector<CarriedMemory> memory(carried_);
    if (carried_ > 0)
      check_cuda(
          cudaMemcpy(memory.data(), device_.carried, sizeof(CarriedMemory) * memory.size(), cudaMemcpyDeviceToHost),
          "fetch the impulses");
    return memory;
  }
  void send(const std::vector<CarriedMemory>& memory) {
    if (!sizes_.coupled || memory.empty()) return;
    check_cuda(
        cudaMemcpy(device_.carried, memory.data(), sizeof(CarriedMemory) * memory.size(), cudaMemcpyHostToDevice),
        "upload the impulses");
    wait_for_copies();
  }

  /// Resets stamps and counters: no stamp of an earlier list may equal that of a later time step.
  void forget_list() {
    const std::size_t stamps = reinterpret_cast<std::byte*>(device_.row_other) - list_memory_.data();
    check_cuda(cudaMemset(list_memory_.data(), 0xff, stamps), "clear the list");
    check_cuda(cudaMemset(device_.counters, 0, sizeof(ListCounters)), "clear the list");
  }

  void make_list() {
    list_memory_ = {};  // free the old memory first
    list_memory_ = DeviceMemory(place_list(device_, sizes_, nullptr));
    place_list(device_, sizes_, list_memory_.data());
    // pairs are copied whole: the padding must not read as uninitialised memory
    check_cuda(cudaMemset(device_.pair, 0, sizeof(PairCell) * (sizes_.rows / 2 + 1)), "clear the list");
    // read whole, even a second point that the contact lacks; `work` is read even beside stamps that mark it stale
    check_cuda(cudaMemset(device_.entry, 0, sizeof(RowEntry) * sizes_.rows), "clear the list");
    check_cuda(cudaMemset(device_.work, 0, sizeof(RowWork) * sizes_.rows), "clear the list");
    check_cuda(cudaMemset(device_.row_event, 0, sizeof(PlatformEventRecord) * sizes_.platform_rows), "clear the list");
    if (sizes_.coupled) {
      check_cuda(cudaMemset(device_.row_points, 0, sizeof(RowPoints) * sizes_.rows), "clear the list");
      check_cuda(cudaMemset(device_.progress, 0, sizeof(RoundsMade)), "clear the list");  // padding, as with pairs
      // events copy contacts whole, even a second point that the contact lacks
      check_cuda(cudaMemset(device_.contact, 0, sizeof(Contact) * (sizes_.rows / 2 + 1)), "clear the list");
    }
    const std::size_t bytes = place_rings(device_, sizes_, nullptr);
    if (bytes != ring_memory_.bytes()) {
      ring_memory_ = DeviceMemory(bytes);
      // fetched whole, even the parts that a call left empty
      check_cuda(cudaMemset(ring_memory_.data(), 0, bytes), "clear the record");
      host_ring_ = PinnedMemory(bytes);
    }
    place_rings(device_, sizes_, ring_memory_.data());
    if (sizes_.drives && drive_copy_.bytes() == 0)
      drive_copy_ = PinnedMemory(sizeof(Drive) * (static_cast<std::size_t>(sizes_.samples) + 1));
    forget_list();
    wait_for_copies();
  }

  /// Waits until all copies have arrived: the kernels run in another stream.
  static void wait_for_copies() { check_cuda(cudaDeviceSynchronize(), "finish the copies"); }

  FieldState field_;
  DriveSchedule drives_;
  MooringTables mooring_;
  DpLaw dp_;
  Ledger ledger_;  // start values and scales
  std::int64_t step_ = 0;
  SceneSizes sizes_;
  DeviceScene device_;
  DeviceStatus* status_;
  std::int32_t carried_ = 0;               // contacts in device_.carried
  std::vector<ContactForce> last_forces_;  // of the last time step
  DeviceMemory field_memory_, list_memory_, ring_memory_;
  PinnedMemory host_ring_, state_copy_, drive_copy_;
  bool fresh_ = true;  // not yet moved on from the state that was given
  bool host_state_valid_ = true, host_books_valid_ = true;
};

}  // namespace gem
