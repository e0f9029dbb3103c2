#include "harness/io/marked_processes.h"

#include <dirent.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

namespace ddem::harness {
namespace {

bool is_marked(const std::string& process, const std::string& mark) {
  std::ifstream file("/proc/" + process + "/environ", std::ios::binary);
  const std::string environment((std::istreambuf_iterator<char>(file)), {});
  return ('\0' + environment).find('\0' + mark + '\0') != std::string::npos;
}

std::vector<pid_t> marked(const std::string& mark) {
  std::vector<pid_t> found;
  DIR* processes = ::opendir("/proc");
  if (processes == nullptr) return found;
  while (const dirent* entry = ::readdir(processes)) {
    const std::string name = entry->d_name;
    if (name.find_first_not_of("0123456789") == std::string::npos && is_marked(name, mark)) found.push_back(static_cast<pid_t>(std::atol(name.c_str())));
  }
  ::closedir(processes);
  return found;
}

}  // namespace

void kill_marked(const std::string& mark) {
  // One that forks while we look is found in the next round.
  for (int round = 0; round < 200; ++round) {
    const std::vector<pid_t> left = marked(mark);
    if (left.empty()) return;
    for (const pid_t process : left) ::kill(process, SIGKILL);
    if (round > 1) ::usleep(5000);
  }
}

}  // namespace ddem::harness
