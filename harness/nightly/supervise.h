#pragma once
// A crash of one unit must not take the campaign with it: the work is done in a child process, and what it
// was at when it died is known.

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace ddem::harness::nightly {

/// Which units run at the moment, in memory that survives the process that runs them.
class UnitBoard {
 public:
  explicit UnitBoard(std::size_t units);
  ~UnitBoard();
  UnitBoard(const UnitBoard&) = delete;
  UnitBoard& operator=(const UnitBoard&) = delete;

  void set_running(std::size_t unit, bool running) { at(unit) = running; }
  /// And forgets them.
  std::vector<std::size_t> take_running();

 private:
  std::atomic<bool>& at(std::size_t unit) { return static_cast<std::atomic<bool>*>(memory_)[unit]; }

  std::size_t units_, bytes_;
  void* memory_;
};

/// Runs `work` in a child process and returns its exit code; what `work` throws goes on in the child. Where
/// the child dies of a signal while units are running, `on_crash` hears of each ("killed by signal 11
/// (Segmentation fault)"), and another child goes on (first_time false), which must leave these units alone.
/// Signals by which people end a program (interrupt, terminate, hang up) go to the child, and once it has ended `on_interrupt`
/// is called and they end this one too. A child that dies while no unit runs is a MachineError. To be called while the
/// process has one thread.
int supervise(UnitBoard& board, const std::function<int(bool first_time)>& work,
              const std::function<void(std::size_t unit, const std::string& reason)>& on_crash,
              const std::function<void()>& on_interrupt = {});

}  // namespace ddem::harness::nightly
