#pragma once
// Everything that a command is about to write, checked before it works: what it would destroy is refused in the first moment,
// and not after an hour.

#include <filesystem>
#include <vector>

#include "harness/io/output_kind.h"

namespace ddem::harness {

struct Output {
  std::filesystem::path path;  ///< empty: nothing is written
  OutputKind kind;
};

/// Throws InputError, all problems at once, where an output is an input, another output, a folder, a device that cannot take
/// it, a file that is not of its kind (unless `force`; an empty one is), in a folder that does not exist, or behind a link
/// of another user in a folder of everybody, or where `force` has none to replace. Files are compared by what they are on the disk, not by their names. Then
/// MachineError where one could not be written.
void claim_outputs(const std::vector<Output>& outputs, const std::vector<std::filesystem::path>& inputs, bool force);

/// Makes the folder where it is missing. Throws InputError where it is a file, MachineError where none can be made in it.
void claim_folder(const std::filesystem::path& folder);

}  // namespace ddem::harness
