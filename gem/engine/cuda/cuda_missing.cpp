// Replaces the CUDA engine in a build without it. Every use throws Error(device) with the reason.
#include "gem/base/error.h"
#include "gem/engine/cuda/cuda_engine.h"

namespace gem {
namespace {

const char* const missing = "this build has no GPU engine (" GEM_NO_CUDA_BECAUSE ")";

}  // namespace

class CudaBatch::Work {};

std::vector<CudaDevice> cuda_devices(std::string& reason) {
  reason = missing;
  return {};
}

CudaDevice usable_cuda_device() { throw Error(ExitCode::device, std::string(missing) + " use --engine cpu"); }

CudaBatch::CudaBatch(std::vector<BatchScene>, const CudaOptions&) { usable_cuda_device(); }
CudaBatch::~CudaBatch() = default;
std::size_t CudaBatch::size() const { return 0; }
void CudaBatch::advance(const std::vector<std::int64_t>&, std::vector<StepLog>*) {}
void CudaBatch::advance(std::int64_t, std::vector<StepLog>*) {}
std::vector<std::exception_ptr> CudaBatch::advance_some(const std::vector<StepsAhead>&, std::vector<StepLog>&) {
  return {};
}
std::int64_t CudaBatch::step(std::size_t) const { return 0; }
const Bodies& CudaBatch::bodies(std::size_t) { throw Error(ExitCode::device, missing); }
Ledger CudaBatch::ledger(std::size_t) { return {}; }
EngineState CudaBatch::save(std::size_t) { return {}; }
void CudaBatch::restore(std::size_t, const EngineState&) {}
std::uint64_t CudaBatch::state_hash(std::size_t) { return 0; }
double CudaBatch::asked_residual(std::size_t) const { return 0.0; }
LineSet CudaBatch::broken_lines(std::size_t) const { return 0; }
const DpState* CudaBatch::dp_state(std::size_t) const { return nullptr; }
bool CudaBatch::has_contact_forces(std::size_t) const { return false; }
std::vector<ContactForce> CudaBatch::contact_forces(std::size_t) const { return {}; }
const CudaDevice& CudaBatch::device() const { throw Error(ExitCode::device, missing); }
int CudaBatch::blocks() const { return 0; }
int CudaBatch::threads() const { return 0; }
Route CudaBatch::route() const { return Route::automatic; }
double CudaBatch::device_time() const { return 0.0; }
double CudaBatch::barriers() const { return 0.0; }

}  // namespace gem
