// The kernels with contraction.
#include "gem/engine/cuda/cuda_kernel.cuh"
#include "gem/engine/cuda/cuda_phases.cuh"

namespace gem {

AdvanceKernel fast_kernel(bool gated) { return kernel_of(gated); }
PhaseKernel fast_phase(DevicePhase phase, Resolution resolution) { return phase_kernel_of(phase, resolution); }

}  // namespace gem
