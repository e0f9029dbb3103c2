#include "dem/core/team.h"

#include <sched.h>

#include <algorithm>
#include <stdexcept>

namespace ddem {
namespace {

/// Puts the calling thread on `core` and sets it free again: from there the scheduler may move it as before.
void move_to(int core, const cpu_set_t& allowed) {
  cpu_set_t chosen;
  CPU_ZERO(&chosen);
  CPU_SET(core, &chosen);
  if (sched_setaffinity(0, sizeof chosen, &chosen) == 0) sched_setaffinity(0, sizeof allowed, &allowed);
}

}  // namespace

Team::Team(int threads) : size_(threads), places_(static_cast<std::size_t>(std::max(1, threads))) {
  if (threads < 1) throw std::invalid_argument("a team has at least one thread");
  for (int k = 1; k < threads; ++k) threads_.emplace_back([this, k] { work(k); });
}

Team::~Team() {
  over_ = true;
  epoch_.fetch_add(1, std::memory_order_release);
  epoch_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Team::run_call(Call job) {
  job_ = job;
  epoch_.fetch_add(1, std::memory_order_release);
  if (size_ > 1) epoch_.notify_all();
  take_part(0);
  meet(0);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Team::take_part(int thread) {
  try {
    job_.call(job_.job, thread);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
  }
}

void Team::let_go(unsigned round) {
  arrived_.store(0, std::memory_order_relaxed);
  round_.store(round + 1, std::memory_order_release);
  if (size_ > 1) round_.notify_all();
}

void Team::work(int thread) {
  for (unsigned epoch = 0;; ++epoch) {
    wait_while(epoch_, epoch, thread);
    if (over_) return;
    take_part(thread);
    meet(thread);
  }
}

// A meeting comes within microseconds, unless the machine is busy with something else: then whoever is late may need this
// very core, and is let go first.
void Team::wait_while(const std::atomic<unsigned>& value, unsigned old, int thread) {
  constexpr int pauses = 100, yields = 200;
  for (int round = 0; round < pauses + yields; ++round) {
    if (value.load(std::memory_order_acquire) != old) return;
    if (round == pauses) leave_shared_core(thread);
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

// A thread starts, and often wakes, on the core of the one that called it. Two that meet all the time take turns there, look
// idle enough to be left together, and never gain anything from the other core (seen for whole runs). So who waits on a core
// where another one was last seen waiting goes to one where none was.
void Team::leave_shared_core(int thread) {
  const int core = sched_getcpu();
  places_[static_cast<std::size_t>(thread)].core.store(core, std::memory_order_relaxed);
  const auto is_taken = [&](int candidate) {
    for (int other = 0; other < size_; ++other) {
      if (other != thread && places_[static_cast<std::size_t>(other)].core.load(std::memory_order_relaxed) == candidate) return true;
    }
    return false;
  };
  if (core < 0 || !is_taken(core)) return;
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  for (int candidate = 0; candidate < CPU_SETSIZE; ++candidate) {
    if (!CPU_ISSET(candidate, &allowed) || is_taken(candidate)) continue;
    move_to(candidate, allowed);
    places_[static_cast<std::size_t>(thread)].core.store(candidate, std::memory_order_relaxed);
    return;
  }
}

}  // namespace ddem
