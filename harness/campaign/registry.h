#pragma once
// Which studies there are, and which tables campaign files have.

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/campaign/study.h"
#include "harness/scene/document.h"

namespace ddem::harness {

struct StudyEntry {
  std::string_view id;     ///< the folder's name: `--only ID`, [studies] in a campaign file
  std::string_view title;  ///< what it answers, for --list
  std::string_view table;  ///< the input without which there is no such study
  std::unique_ptr<Study> (*make)(const StudyContext&);
};

/// In the order of the report.
std::span<const StudyEntry> studies();

/// A table of campaign files, and the data that it becomes, which plans carry.
struct InputTable {
  std::string_view name;  ///< [name] or [[name]]
  bool is_list = false;   ///< [[name]]
  std::string_view help;  ///< "[strip] for the strip of the paper"
  /// Adds what is wrong with it.
  nlohmann::json (*read)(const Document& file, const std::filesystem::path& path, std::vector<std::string>& problems);
  /// InputError where a file could not have said it.
  void (*check)(const nlohmann::json& data);
  /// What a campaign with `there` has and one with `here` lacks, in words; empty: nothing.
  std::string (*lost)(const nlohmann::json& there, const nlohmann::json& here);
  /// Title and summary.
  void (*introduce)(const nlohmann::json& data, reports::Report& report);
  /// Of a campaign without a file; none: it has not this table.
  nlohmann::json (*by_default)() = nullptr;
};

std::span<const InputTable> input_tables();

}  // namespace ddem::harness
