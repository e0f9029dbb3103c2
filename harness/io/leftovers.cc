#include "harness/io/leftovers.h"

#include <dirent.h>
#include <fcntl.h>
#include <sched.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>

#include "harness/io/progress.h"

namespace ddem::harness {
namespace {

std::atomic_flag busy;
Leftover* newest = nullptr;

void lock() {
  while (busy.test_and_set(std::memory_order_acquire)) ::sched_yield();
}

/// As rm -r, with nothing that a signal handler may not do.
void remove_tree(int folder, const char* name, int depth) {
  if (::unlinkat(folder, name, 0) == 0 || errno == ENOENT || depth > 16) return;
  const int inside = ::openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (inside < 0) return;
  alignas(dirent64) std::array<char, 4096> block;
  for (int round = 0; round < 100; ++round) {  // what is removed moves what is left
    ::lseek(inside, 0, SEEK_SET);
    int found = 0;
    for (long bytes; (bytes = ::syscall(SYS_getdents64, inside, block.data(), block.size())) > 0;) {
      for (long at = 0; at < bytes;) {
        const auto* entry = reinterpret_cast<const dirent64*>(block.data() + at);
        at += entry->d_reclen;
        if (std::strcmp(entry->d_name, ".") == 0 || std::strcmp(entry->d_name, "..") == 0) continue;
        remove_tree(inside, entry->d_name, depth + 1);
        ++found;
      }
    }
    if (found == 0) break;
  }
  ::close(inside);
  ::unlinkat(folder, name, AT_REMOVEDIR);
}

void end_children() {
  for (const Leftover* l = newest; l != nullptr; l = l->next) {
    if (l->child <= 0) continue;
    ::kill(-l->child, SIGKILL);
    ::kill(l->child, SIGKILL);  // it may not have a group of its own yet
  }
  for (const Leftover* l = newest; l != nullptr; l = l->next) {
    while (l->child > 0 && ::waitpid(l->child, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
}

/// Never gives the lock back: threads that would commit, or report a child's end, wait for ours.
void end_by(int signal) {
  lock();
  wipe_drawn_progress();
  end_children();
  for (const Leftover* l = newest; l != nullptr; l = l->next) {
    if (!l->path.empty()) remove_tree(AT_FDCWD, l->path.c_str(), 0);
  }
  struct sigaction usual {};
  usual.sa_handler = SIG_DFL;
  ::sigaction(signal, &usual, nullptr);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  ::raise(signal);
  ::_exit(128 + signal);
}

}  // namespace

void clean_up_on_signals() {
  ::signal(SIGCHLD, SIG_DFL);  // where the caller ignores it, the system waits for our children in our place
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN && signal != SIGTERM) continue;
    action = {};
    action.sa_handler = end_by;
    sigfillset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
  }
}

CleanupSection::CleanupSection() {
  sigset_t all;
  sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  lock();
}

CleanupSection::~CleanupSection() {
  busy.clear(std::memory_order_release);
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void CleanupSection::list(Leftover& leftover) {
  leftover.previous = nullptr;
  leftover.next = newest;
  if (newest != nullptr) newest->previous = &leftover;
  newest = &leftover;
}

void CleanupSection::unlist(Leftover& leftover) {
  if (newest == &leftover) newest = leftover.next;
  if (leftover.previous != nullptr) leftover.previous->next = leftover.next;
  if (leftover.next != nullptr) leftover.next->previous = leftover.previous;
  leftover.next = leftover.previous = nullptr;
}

void CleanupSection::forget_all() {
  while (newest != nullptr) unlist(*newest);
}

}  // namespace ddem::harness
