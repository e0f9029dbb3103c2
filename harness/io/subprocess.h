#pragma once
// Running another program, without a shell.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ddem::harness {

struct SubprocessResult {
  int exit_code = 0;                            ///< of a program that ended by itself
  int signal = 0;                               ///< that ended it, or 0
  bool timed_out = false;                       ///< it was killed at its time limit
  double peak_memory = 0.0;                     ///< bytes: most of its own at once, and no less than this process held as it was started
  std::string standard_output, standard_error;  ///< the last megabyte of each

  bool succeeded() const { return exit_code == 0 && signal == 0; }
  /// "exit code 3", "killed by signal 9 (Killed)", "killed at its time limit".
  std::string status() const;
};

/// Called with each line of the program's standard error as it comes, without its line break.
using LineCallback = std::function<void(std::string_view line)>;

/// Runs a program (a path, or a name that is looked for in PATH) with arguments, standard input from
/// /dev/null, and waits for it. A program that cannot be started is a MachineError; one that fails is a
/// result. Where the callback throws, the program is killed and waited for, and the exception goes on. Ends
/// with the program, even where a process that it left behind still holds its output. The program does not outlive this
/// process, however that ends, nor what it started in its process group where a signal ends this one.
SubprocessResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                             const LineCallback& on_error_line = {});

/// For a program that is not trusted.
struct Confinement {
  std::filesystem::path folder;                    ///< it works there, TMPDIR is there, and
  std::vector<std::filesystem::path> may_write;    ///< there and here alone it may write, where the system can see to it (Landlock)
  double seconds = 0.0;                            ///< its time limit, s
};

/// The same with nothing left behind: all that the program started goes with it, also what has left its process group.
SubprocessResult run_confined(const std::string& program, const std::vector<std::string>& arguments, const Confinement& confinement);

}  // namespace ddem::harness
