#include "fem_reference/kernel/team.h"

#include <stdexcept>
#include <thread>
#include <utility>

namespace ddem::fem {
namespace {

// A meeting comes within microseconds, unless the machine is busy with something else: then whoever is late may need this
// very core, and is let go first.
void wait_while(const std::atomic<unsigned>& value, unsigned old) {
  constexpr int pauses = 100, yields = 200;
  for (int round = 0; round < pauses + yields; ++round) {
    if (value.load(std::memory_order_acquire) != old) return;
    if (round >= pauses) {
      std::this_thread::yield();
      continue;
    }
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  value.wait(old, std::memory_order_acquire);
}

}  // namespace

Team::Team(int threads) : size_(threads) {
  if (threads < 1) throw std::invalid_argument("a team has at least one thread");
  for (int k = 1; k < threads; ++k) threads_.emplace_back([this, k] { work(k); });
}

Team::~Team() {
  over_ = true;
  epoch_.fetch_add(1, std::memory_order_release);
  epoch_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Team::run(const std::function<void(int)>& job) {
  job_ = &job;
  epoch_.fetch_add(1, std::memory_order_release);
  if (size_ > 1) epoch_.notify_all();
  take_part(0);
  meet();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Team::take_part(int thread) {
  try {
    (*job_)(thread);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
  }
}

void Team::meet() {
  if (size_ == 1) return;
  const unsigned round = round_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == static_cast<unsigned>(size_)) {
    arrived_.store(0, std::memory_order_relaxed);
    round_.store(round + 1, std::memory_order_release);
    round_.notify_all();
  } else {
    wait_while(round_, round);
  }
}

void Team::work(int thread) {
  for (unsigned epoch = 0;; ++epoch) {
    wait_while(epoch_, epoch);
    if (over_) return;
    take_part(thread);
    meet();
  }
}

}  // namespace ddem::fem
