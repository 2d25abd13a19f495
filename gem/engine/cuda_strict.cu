// The kernel without contraction.
#include "gem/engine/cuda_kernel.cuh"

namespace gem {

AdvanceKernel strict_kernel(bool gated) { return kernel_of(gated); }

}  // namespace gem
