#include "harness/nightly/supervise.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

#include "harness/io/errors.h"

namespace ddem::harness::nightly {
namespace {

/// Waits for a child; its status.
int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw machine_error("the campaign's process", "cannot wait for it", errno);
  }
  return status;
}

bool is_request(int signal) {
  return signal == SIGINT || signal == SIGTERM || signal == SIGHUP;
}

}  // namespace

UnitBoard::UnitBoard(std::size_t units) : units_(units), bytes_(units + 1) {
  static_assert(std::atomic<bool>::is_always_lock_free && sizeof(std::atomic<bool>) == 1);
  memory_ = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory_ == MAP_FAILED) throw std::bad_alloc();
  for (std::size_t k = 0; k < units_; ++k)
    new (static_cast<std::atomic<bool>*>(memory_) + k) std::atomic<bool>(false);
}

UnitBoard::~UnitBoard() {
  ::munmap(memory_, bytes_);
}

std::vector<std::size_t> UnitBoard::take_running() {
  std::vector<std::size_t> running;
  for (std::size_t k = 0; k < units_; ++k) {
    if (at(k).exchange(false)) running.push_back(k);
  }
  return running;
}

int supervise(UnitBoard& board, const std::function<int(bool)>& work,
              const std::function<void(std::size_t, const std::string&)>& on_crash) {
  for (bool first_time = true;; first_time = false) {
    std::fflush(stdout);  // what waits there must not be written twice
    const pid_t parent = ::getpid(), child = ::fork();
    if (child < 0) throw machine_error("the campaign", "cannot start a process", errno);
    if (child == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (::getppid() != parent) ::_exit(static_cast<int>(ExitCode::machine_failed));
      return work(first_time);
    }
    const int status = wait_for(child);
    if (WIFEXITED(status)) return WEXITSTATUS(status);
    const int signal = WTERMSIG(status);
    if (is_request(signal)) {
      std::signal(signal, SIG_DFL);
      std::raise(signal);
    }
    const std::string reason = fmt::format("killed by signal {} ({})", signal, ::strsignal(signal));
    const std::vector<std::size_t> running = board.take_running();
    if (running.empty()) throw MachineError("the campaign's process was " + reason);
    for (const std::size_t unit : running) on_crash(unit, reason);
  }
}

}  // namespace ddem::harness::nightly
