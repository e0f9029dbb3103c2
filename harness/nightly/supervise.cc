#include "harness/nightly/supervise.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>

#include "harness/io/errors.h"
#include "harness/io/leftovers.h"

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

constexpr std::array kRequests = {SIGINT, SIGTERM, SIGHUP};

bool is_request(int signal) {
  return std::find(kRequests.begin(), kRequests.end(), signal) != kRequests.end();
}

volatile std::sig_atomic_t supervised = 0;  // the child that a request goes to

void pass_on(int signal) {
  ::kill(static_cast<pid_t>(supervised), signal);
}

/// Holds requests back while it lives: none may get lost between a fork and its PassedOn.
class HeldBack {
 public:
  HeldBack() {
    sigset_t requests;
    ::sigemptyset(&requests);
    for (const int signal : kRequests) ::sigaddset(&requests, signal);
    ::sigprocmask(SIG_BLOCK, &requests, &before_);
  }
  ~HeldBack() { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }
  HeldBack(const HeldBack&) = delete;
  HeldBack& operator=(const HeldBack&) = delete;

 private:
  sigset_t before_{};
};

/// Requests go to the child while it lives; those that are ignored, as of a program in the background, stay so.
class PassedOn {
 public:
  explicit PassedOn(pid_t child) {
    supervised = child;
    struct sigaction action {};
    action.sa_handler = pass_on;
    for (std::size_t k = 0; k < kRequests.size(); ++k) {
      ::sigaction(kRequests[k], nullptr, &before_[k]);
      if (before_[k].sa_handler != SIG_IGN) ::sigaction(kRequests[k], &action, nullptr);
    }
  }
  ~PassedOn() {
    for (std::size_t k = 0; k < kRequests.size(); ++k) ::sigaction(kRequests[k], &before_[k], nullptr);
  }
  PassedOn(const PassedOn&) = delete;
  PassedOn& operator=(const PassedOn&) = delete;

 private:
  std::array<struct sigaction, kRequests.size()> before_{};
};

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
              const std::function<void(std::size_t, const std::string&)>& on_crash, const std::function<void()>& on_interrupt) {
  for (bool first_time = true;; first_time = false) {
    std::fflush(stdout);  // what waits there must not be written twice
    std::optional<HeldBack> held_back(std::in_place);
    const pid_t parent = ::getpid(), child = ::fork();
    if (child < 0) throw machine_error("the campaign", "cannot start a process", errno);
    if (child == 0) {
      CleanupSection().forget_all();
      held_back.reset();
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // so that it tidies up, too
      if (::getppid() != parent) ::_exit(static_cast<int>(ExitCode::machine_failed));
      return work(first_time);
    }
    std::optional<PassedOn> passed_on(std::in_place, child);
    held_back.reset();
    const int status = wait_for(child);
    passed_on.reset();
    if (WIFEXITED(status)) return WEXITSTATUS(status);
    const int signal = WTERMSIG(status);
    if (is_request(signal)) {
      if (on_interrupt) on_interrupt();
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
