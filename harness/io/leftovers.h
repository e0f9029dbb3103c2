#pragma once
// What must not outlive this process where a signal ends it: temporary files and folders, and programs that it runs.

#include <signal.h>
#include <sys/types.h>

#include <string>

namespace ddem::harness {

/// INT, TERM and HUP end the process as they would anyway (so that a shell sees which), but what is listed goes first. Those
/// that the process was started to ignore, as by nohup, stay ignored, but for TERM.
void clean_up_on_signals();

/// A file or folder that is removed, or a child process that is killed with its process group, and waited for.
struct Leftover {
  std::string path;
  pid_t child = 0;
  Leftover *next = nullptr, *previous = nullptr;
};

/// While one lives, no signal ends the process: what is made in it can be listed, and what is removed taken off the list,
/// without a moment between. Only system calls in it, no memory is taken or given back, and none inside another: a signal
/// may have come while another thread holds the allocator, and then waits for this section.
class CleanupSection {
 public:
  CleanupSection();
  ~CleanupSection();
  CleanupSection(const CleanupSection&) = delete;
  CleanupSection& operator=(const CleanupSection&) = delete;

  void list(Leftover& leftover);
  void unlist(Leftover& leftover);
  /// In a forked child: what its parent listed is its parent's.
  void forget_all();

 private:
  sigset_t before_;
};

}  // namespace ddem::harness
