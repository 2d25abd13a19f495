// The kernels without contraction.
#include "gem/engine/cuda/cuda_kernel.cuh"
#include "gem/engine/cuda/cuda_phases.cuh"

namespace gem {

AdvanceKernel strict_kernel(bool gated) { return kernel_of(gated); }
PhaseKernel strict_phase(DevicePhase phase, Resolution resolution) { return phase_kernel_of(phase, resolution); }

}  // namespace gem
