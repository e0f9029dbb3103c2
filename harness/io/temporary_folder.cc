#include "harness/io/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <system_error>

#include "harness/io/errors.h"

namespace ddem::harness {

TemporaryFolder::TemporaryFolder(const std::string& prefix) {
  std::error_code error;
  const auto base = std::filesystem::temp_directory_path(error);
  if (error) throw MachineError("no folder for temporary files: " + error.message() + "; set TMPDIR");
  std::string name = (base / (prefix + "-XXXXXX")).string();
  if (mkdtemp(name.data()) == nullptr) throw machine_error(name, "cannot create a temporary folder", errno);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace ddem::harness
