#include "harness/io/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <system_error>

#include "harness/io/errors.h"
#include "harness/io/process_stamp.h"

namespace ddem::harness {

TemporaryFolder::TemporaryFolder(const std::string& prefix) {
  std::error_code error;
  const auto base = std::filesystem::temp_directory_path(error);
  if (error) throw MachineError("no folder for temporary files: " + error.message() + "; set TMPDIR");
  sweep_folder(base, "ddem-");
  leftover_.path = std::filesystem::absolute(base / (prefix + "-" + process_stamp() + "-XXXXXX")).string();
  int failure = 0;
  {
    CleanupSection section;
    if (mkdtemp(leftover_.path.data()) == nullptr) {
      failure = errno;
    } else {
      section.list(leftover_);
    }
  }
  if (failure != 0) throw machine_error(leftover_.path, "cannot create a temporary folder", failure);
  path_ = leftover_.path;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  CleanupSection().unlist(leftover_);
}

}  // namespace ddem::harness
