// The kernels.
#include "gem/engine/cuda/cuda_kernel.cuh"
#include "gem/engine/cuda/cuda_phases.cuh"

namespace gem {

AdvanceKernel advance_kernel(bool gated) { return kernel_of(gated); }
PhaseKernel phase_kernel(DevicePhase phase, Resolution resolution) { return phase_kernel_of(phase, resolution); }

}  // namespace gem
