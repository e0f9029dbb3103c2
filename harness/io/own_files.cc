#include "harness/io/own_files.h"

namespace ddem::harness {

std::filesystem::path program_folder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

std::filesystem::path shared_file(std::string_view name) { return program_folder().parent_path() / "share/ddem" / name; }

}  // namespace ddem::harness
