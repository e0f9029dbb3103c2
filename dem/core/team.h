#pragma once
// A few threads that take every step together: started once, met several times a step.

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace ddem {

class Team {
 public:
  /// The calling thread is one of them. Throws std::invalid_argument for less than one.
  explicit Team(int threads = 1);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int size() const { return size_; }

  /// job(0) .. job(size - 1), one a thread; returns when all are done. What one of them throws is thrown here; a job
  /// that calls meet() must not throw.
  template <typename Job>
  void run(const Job& job) {
    run_call({[](const void* j, int thread) { (*static_cast<const Job*>(j))(thread); }, &job});
  }

  /// Inside a job, by each thread under its number: goes on when all threads have come here.
  void meet(int thread) {
    meet(thread, [] {});
  }

  /// The same, and the last one to come calls finish(), which must not throw, before all go on.
  template <typename Finish>
  void meet(int thread, Finish&& finish) {
    const unsigned round = round_.load(std::memory_order_acquire);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 < static_cast<unsigned>(size_)) {
      wait_while(round_, round, thread);
      return;
    }
    finish();
    let_go(round);
  }

  /// The part of `count` things that a thread takes.
  std::pair<std::size_t, std::size_t> part(std::size_t count, int thread) const {
    const auto n = static_cast<std::size_t>(size_), k = static_cast<std::size_t>(thread);
    return {count * k / n, count * (k + 1) / n};
  }

 private:
  /// A reference to something that takes a thread's number: no allocation a step, as std::function would need.
  struct Call {
    void (*call)(const void* job, int thread) = nullptr;
    const void* job = nullptr;
  };
  /// Where a thread was last seen waiting; a cache line of its own.
  struct alignas(64) Place {
    std::atomic<int> core{-1};
  };

  void run_call(Call job);
  void work(int thread);
  void take_part(int thread);
  void let_go(unsigned round);
  void wait_while(const std::atomic<unsigned>& value, unsigned old, int thread);
  void leave_shared_core(int thread);

  int size_;
  Call job_;
  std::atomic<unsigned> epoch_{0}, arrived_{0}, round_{0};
  bool over_ = false;
  std::mutex mutex_;  // guards failure_
  std::exception_ptr failure_;
  std::vector<Place> places_;
  std::vector<std::thread> threads_;
};

}  // namespace ddem
