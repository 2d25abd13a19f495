// The kernel with contraction.
#include "gem/engine/cuda_kernel.cuh"

namespace gem {

AdvanceKernel fast_kernel(bool gated) { return kernel_of(gated); }

}  // namespace gem
