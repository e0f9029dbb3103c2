#pragma once
// One TOML value against one row of the key table.

#include <filesystem>
#include <string>

#include "harness/scene/document.h"
#include "harness/scene/keys.h"
#include "harness/scene/values.h"

namespace ddem::harness {

struct ReadValue {
  Value value;          ///< monostate where there is a problem
  std::string message;  ///< what is wrong
  std::string remedy;   ///< what would be right
};

/// What a file is asked for: to be there, or no more than a name that could be one.
enum class FileCheck { exists, name };

/// Reads `node` as a value of `spec`; files are looked for in `base_folder`.
ReadValue read_value(const Node& node, const KeySpec& spec, const std::filesystem::path& base_folder, FileCheck check);

}  // namespace ddem::harness
