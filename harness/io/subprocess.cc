#include "harness/io/subprocess.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "harness/io/errors.h"
#include "harness/io/landlock.h"
#include "harness/io/leftovers.h"
#include "harness/io/marked_processes.h"

extern char** environ;

namespace ddem::harness {
namespace {

class PipeEnd {
 public:
  explicit PipeEnd(int fd = -1) : fd_(fd) {}
  ~PipeEnd() { close(); }
  PipeEnd(PipeEnd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  PipeEnd(const PipeEnd&) = delete;
  PipeEnd& operator=(const PipeEnd&) = delete;
  PipeEnd& operator=(PipeEnd&&) = delete;

  int get() const { return fd_; }
  void close() {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  }

 private:
  int fd_;
};

struct Pipe {
  PipeEnd read_end, write_end;
};

Pipe make_pipe(const std::string& program) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw machine_error(program, "cannot make a pipe", errno);
  return {PipeEnd(ends[0]), PipeEnd(ends[1])};
}

/// A started program; killed and waited for unless it has been waited for, also where a signal ends this process.
class Child {
 public:
  explicit Child(pid_t pid) {
    leftover_.child = pid;
    CleanupSection().list(leftover_);
  }
  ~Child() {
    if (leftover_.child > 0) {
      kill();
      wait(0);
    }
    CleanupSection().unlist(leftover_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// True once it has ended; `flags` 0 or WNOHANG.
  bool wait(int flags) {
    if (leftover_.child <= 0) return true;
    pid_t ended;
    do {
      ended = ::wait4(leftover_.child, &status_, flags, &usage_);
    } while (ended < 0 && errno == EINTR);
    if (ended == 0) return false;
    CleanupSection section;  // where a signal ended it and is to end us, we stop here
    leftover_.child = 0;
    return true;
  }

  int status() const { return status_; }
  double peak_memory() const { return 1024.0 * static_cast<double>(usage_.ru_maxrss); }

  /// With its process group.
  void kill() const {
    ::kill(-leftover_.child, SIGKILL);
    ::kill(leftover_.child, SIGKILL);
  }

 private:
  Leftover leftover_;
  int status_ = 0;
  rusage usage_{};
};

/// The last megabyte of a stream, and its lines as they come.
class Capture {
 public:
  explicit Capture(LineCallback on_line = {}) : on_line_(std::move(on_line)) {}

  void add(std::string_view block) {
    tail_ += block;
    if (tail_.size() > 2 * limit) tail_.erase(0, tail_.size() - limit);
    if (!on_line_) return;
    for (std::size_t end; (end = block.find('\n')) != std::string_view::npos; block.remove_prefix(end + 1)) {
      line_ += block.substr(0, end);
      const std::string line = std::exchange(line_, {});
      on_line_(line);
    }
    if (line_.size() < limit) line_ += block;
  }

  std::string finish() {
    if (on_line_ && !line_.empty()) on_line_(std::exchange(line_, {}));
    if (tail_.size() > limit) tail_.erase(0, tail_.size() - limit);
    return std::move(tail_);
  }

 private:
  static constexpr std::size_t limit = 1 << 20;

  LineCallback on_line_;
  std::string tail_, line_;
};

/// How a program is started; all of it made before the fork.
struct Start {
  std::vector<char*> argv, environment;
  std::string folder = {};  ///< empty: this process's
  const WriteRule* rule = nullptr;
};

/// In the new process: becomes the program. With only what a process may do that was forked while other threads ran.
[[noreturn]] void become(const Start& start, int out, int error, int failure, pid_t parent, const sigset_t& mask) {
  ::setpgid(0, 0);
  // However this process's parent dies, it goes, too; where that has just happened nobody tells.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int null = ::open("/dev/null", O_RDONLY);
  if (::getppid() == parent && null >= 0 && ::dup2(null, STDIN_FILENO) >= 0 && ::dup2(out, STDOUT_FILENO) >= 0 &&
      ::dup2(error, STDERR_FILENO) >= 0) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction action {};
      ::sigaction(signal, nullptr, &action);
      if (action.sa_handler != SIG_IGN) ::signal(signal, SIG_DFL);
    }
    for (const int signal : {SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_DFL);
    ::sigprocmask(SIG_SETMASK, &mask, nullptr);
    if (start.rule != nullptr) start.rule->apply();
    if (start.folder.empty() || ::chdir(start.folder.c_str()) == 0) ::execvpe(start.argv[0], start.argv.data(), start.environment.data());
  }
  const int reason = errno;
  [[maybe_unused]] const ssize_t told = ::write(failure, &reason, sizeof reason);
  ::_exit(127);
}

/// Pointers to the texts, and the null that ends the list.
std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  list.reserve(words.size() + 1);
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

pid_t spawn(const std::string& program, const Start& start, int out, int error) {
  Pipe failure = make_pipe(program);
  sigset_t all, before;
  sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t parent = ::getpid(), pid = ::fork();
  if (pid == 0) become(start, out, error, failure.write_end.get(), parent, before);
  const int fork_error = errno;
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (pid < 0) throw machine_error(program, "cannot be started", fork_error);
  failure.write_end.close();
  int reason = 0;
  ssize_t told;
  do {
    told = ::read(failure.read_end.get(), &reason, sizeof reason);
  } while (told < 0 && errno == EINTR);
  if (told != sizeof reason) return pid;  // closed by the program's start
  ::waitpid(pid, nullptr, 0);
  throw machine_error(program, "cannot be started", reason);
}

using Clock = std::chrono::steady_clock;

/// Reads what is there without blocking longer than poll() has promised; closes at the end of the stream.
void drain(PipeEnd& from, Capture& into) {
  char block[1 << 16];
  const ssize_t count = ::read(from.get(), block, sizeof block);
  if (count > 0) {
    into.add({block, static_cast<std::size_t>(count)});
  } else if (count == 0 || (errno != EINTR && errno != EAGAIN)) {
    from.close();
  }
}

constexpr Clock::time_point kNever = Clock::time_point::max();

/// Milliseconds until then, 100 at most.
int wait_until(Clock::time_point end) {
  if (end == kNever) return 100;
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
  return static_cast<int>(std::clamp<long>(left, 0, 100));
}

SubprocessResult run(const std::string& program, const Start& start, const LineCallback& on_error_line, Clock::time_point limit) {
  Pipe out = make_pipe(program), error = make_pipe(program);
  Child child(spawn(program, start, out.write_end.get(), error.write_end.get()));
  out.write_end.close();
  error.write_end.close();

  SubprocessResult result;
  Capture out_text, error_text(on_error_line);
  // A process that the program leaves behind may keep its pipes open, and write to them for ever: once the
  // program has ended, only what a pipe can hold is still read.
  bool ended = false;
  for (int reads_after_end = 0; reads_after_end < 8 && (out.read_end.get() >= 0 || error.read_end.get() >= 0 || (limit != kNever && !ended));) {
    ended = ended || child.wait(WNOHANG);
    if (!ended && Clock::now() >= limit) {
      result.timed_out = true;
      child.kill();
      limit = kNever;
    }
    pollfd watched[2] = {{out.read_end.get(), POLLIN, 0}, {error.read_end.get(), POLLIN, 0}};  // skips -1
    const int ready = ::poll(watched, 2, ended ? 0 : wait_until(limit));
    if (ready < 0 && errno != EINTR) throw machine_error(program, "cannot watch its output", errno);
    if (ready == 0 && ended) break;
    if (ready <= 0) continue;
    if (watched[0].revents != 0) drain(out.read_end, out_text);
    if (watched[1].revents != 0) drain(error.read_end, error_text);
    reads_after_end += ended ? 1 : 0;
  }
  result.standard_error = error_text.finish();
  result.standard_output = out_text.finish();
  child.wait(0);
  result.peak_memory = child.peak_memory();
  if (WIFSIGNALED(child.status())) {
    result.signal = WTERMSIG(child.status());
  } else {
    result.exit_code = WEXITSTATUS(child.status());
  }
  return result;
}

std::vector<std::string> words_of(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

std::vector<std::string> environment_with(const std::vector<std::string>& more) {
  std::vector<std::string> all = more;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!std::string_view(*variable).starts_with("TMPDIR=")) all.emplace_back(*variable);
  }
  return all;
}

}  // namespace

std::string SubprocessResult::status() const {
  if (timed_out) return "killed at its time limit";
  if (signal != 0) return fmt::format("killed by signal {} ({})", signal, ::strsignal(signal));
  return fmt::format("exit code {}", exit_code);
}

SubprocessResult run_program(const std::string& program, const std::vector<std::string>& arguments, const LineCallback& on_error_line) {
  std::vector<std::string> words = words_of(program, arguments);
  Start start{pointers(words), {}};
  for (char** variable = environ; *variable != nullptr; ++variable) start.environment.push_back(*variable);
  start.environment.push_back(nullptr);
  return run(program, start, on_error_line, kNever);
}

SubprocessResult run_confined(const std::string& program, const std::vector<std::string>& arguments, const Confinement& c) {
  static std::atomic<unsigned> runs{0};
  // What a program starts inherits the mark, wherever it goes.
  const std::string mark = fmt::format("DDEM_RUN={}.{}", ::getpid(), runs++);
  struct Sweep {
    const std::string& mark;
    ~Sweep() { kill_marked(mark); }
  } sweep{mark};
  std::vector<std::string> words = words_of(program, arguments), environment = environment_with({mark, "TMPDIR=" + c.folder.string()});
  std::vector<std::filesystem::path> may_write = c.may_write;
  may_write.push_back(c.folder);
  const WriteRule rule(may_write);
  const Start start{pointers(words), pointers(environment), c.folder.string(), &rule};
  return run(program, start, {}, Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(c.seconds)));
}

}  // namespace ddem::harness
