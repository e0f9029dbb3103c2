#include "harness/io/landlock.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace ddem::harness {
namespace {

constexpr std::uint64_t kWrites = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE |
                                  LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
                                  LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK |
                                  LANDLOCK_ACCESS_FS_MAKE_SYM;

void allow_below(int rule, const std::filesystem::path& folder) {
  const int parent = ::open(folder.c_str(), O_PATH | O_CLOEXEC);
  if (parent < 0) return;
  landlock_path_beneath_attr beneath{};
  beneath.allowed_access = kWrites;
  beneath.parent_fd = parent;
  ::syscall(SYS_landlock_add_rule, rule, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0);
  ::close(parent);
}

}  // namespace

WriteRule::WriteRule(const std::vector<std::filesystem::path>& folders) {
  landlock_ruleset_attr ruleset{};
  ruleset.handled_access_fs = kWrites;
  rule_ = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &ruleset, sizeof ruleset.handled_access_fs, 0));
  if (rule_ < 0) return;
  ::fcntl(rule_, F_SETFD, FD_CLOEXEC);
  for (const std::filesystem::path& folder : folders) allow_below(rule_, folder);
  for (const char* devices : {"/dev", "/proc"}) allow_below(rule_, devices);
}

WriteRule::~WriteRule() {
  if (rule_ >= 0) ::close(rule_);
}

void WriteRule::apply() const {
  if (rule_ < 0) return;
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  ::syscall(SYS_landlock_restrict_self, rule_, 0);
}

}  // namespace ddem::harness
