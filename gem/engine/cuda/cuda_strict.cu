// The kernels without contraction.
#include "gem/engine/cuda/cuda_kernel.cuh"
#include "gem/engine/cuda/cuda_phases.cuh"

namespace gem {

AdvanceKernel strict_kernel(bool uses_grid_barrier) { return kernel_of(uses_grid_barrier); }
PhaseKernel strict_phase(DevicePhase phase, ContactSolver solver) { return phase_kernel_of(phase, solver); }

}  // namespace gem
