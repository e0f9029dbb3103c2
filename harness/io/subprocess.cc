#include "harness/io/subprocess.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "harness/io/errors.h"

extern char** environ;

namespace ddem::harness {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;

  int get() const { return fd_; }
  void close() {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  }

 private:
  int fd_;
};

struct Pipe {
  Descriptor read_end, write_end;
};

Pipe make_pipe(const std::string& program) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw machine_error(program, "cannot make a pipe", errno);
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// A started program; killed and waited for unless it has been waited for.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  ~Child() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    wait(0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// True once it has ended; `flags` 0 or WNOHANG.
  bool wait(int flags) {
    if (pid_ <= 0) return true;
    pid_t ended;
    do {
      ended = ::waitpid(pid_, &status_, flags);
    } while (ended < 0 && errno == EINTR);
    if (ended == 0) return false;
    pid_ = 0;
    return true;
  }

  int status() const { return status_; }

 private:
  pid_t pid_;
  int status_ = 0;
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

pid_t spawn(const std::string& program, const std::vector<std::string>& arguments, int out, int error) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, error, STDERR_FILENO);
  pid_t pid = 0;
  const int failure = ::posix_spawnp(&pid, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw machine_error(program, "cannot be started", failure);
  return pid;
}

/// Reads what is there without blocking longer than poll() has promised; closes at the end of the stream.
void drain(Descriptor& from, Capture& into) {
  char block[1 << 16];
  const ssize_t count = ::read(from.get(), block, sizeof block);
  if (count > 0) {
    into.add({block, static_cast<std::size_t>(count)});
  } else if (count == 0 || (errno != EINTR && errno != EAGAIN)) {
    from.close();
  }
}

}  // namespace

std::string SubprocessResult::status() const {
  if (signal != 0) return fmt::format("killed by signal {} ({})", signal, ::strsignal(signal));
  return fmt::format("exit code {}", exit_code);
}

SubprocessResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                             const LineCallback& on_error_line) {
  Pipe out = make_pipe(program), error = make_pipe(program);
  Child child(spawn(program, arguments, out.write_end.get(), error.write_end.get()));
  out.write_end.close();
  error.write_end.close();

  Capture out_text, error_text(on_error_line);
  // A process that the program leaves behind may keep its pipes open, and write to them for ever: once the
  // program has ended, only what a pipe can hold is still read.
  bool ended = false;
  for (int reads_after_end = 0;
       reads_after_end < 8 && (out.read_end.get() >= 0 || error.read_end.get() >= 0);) {
    ended = ended || child.wait(WNOHANG);
    pollfd watched[2] = {{out.read_end.get(), POLLIN, 0}, {error.read_end.get(), POLLIN, 0}};  // skips -1
    const int ready = ::poll(watched, 2, ended ? 0 : 100);
    if (ready < 0 && errno != EINTR) throw machine_error(program, "cannot watch its output", errno);
    if (ready == 0 && ended) break;
    if (ready <= 0) continue;
    if (watched[0].revents != 0) drain(out.read_end, out_text);
    if (watched[1].revents != 0) drain(error.read_end, error_text);
    reads_after_end += ended ? 1 : 0;
  }
  SubprocessResult result;
  result.standard_error = error_text.finish();
  result.standard_output = out_text.finish();
  child.wait(0);
  if (WIFSIGNALED(child.status())) {
    result.signal = WTERMSIG(child.status());
  } else {
    result.exit_code = WEXITSTATUS(child.status());
  }
  return result;
}

}  // namespace ddem::harness
