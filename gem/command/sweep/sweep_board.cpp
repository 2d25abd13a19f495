// Maps memory that forked processes share.
#include "gem/command/sweep/sweep_board.h"

#include <sys/mman.h>

#include <new>

namespace gem {

static_assert(std::atomic<double>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
                  std::atomic<Outcome>::is_always_lock_free,
              "the board is shared by processes");

SweepBoard::SweepBoard(std::size_t runs) : bytes_(sizeof(Entry) * (runs + 1)) {
  void* memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  stop_ = new (memory) std::atomic<int>(0);
  entries_ = static_cast<Entry*>(memory) + 1;
  for (std::size_t i = 0; i < runs; ++i) new (entries_ + i) Entry{0.0, Outcome::waiting, 0};
}

SweepBoard::~SweepBoard() { munmap(stop_, bytes_); }

}  // namespace gem
