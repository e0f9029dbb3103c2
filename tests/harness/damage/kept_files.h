#pragma once
// The files of a small campaign that has everything, and what their readers make of them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/io/subprocess.h"
#include "harness/io/temporary_folder.h"

namespace ddem::harness::test {

/// A file that the program reads again.
struct KeptFile {
  std::filesystem::path path;
  /// What is read of it, as text. Throws InputError where it is refused; of what is refused without a word and made anew
  /// there is no text.
  std::function<std::string()> read;
};

/// night/ (with its units), again/ (the same campaign's statics), nights/ (a history of two), baseline.json, cache/ (a packing).
class KeptFiles {
 public:
  KeptFiles();

  std::filesystem::path operator/(const std::string& name) const { return folder_.path() / name; }
  std::string path(const std::string& name) const { return (*this / name).string(); }
  SubprocessResult ddem(const std::vector<std::string>& arguments) const;

  std::vector<KeptFile> all() const;

 private:
  void add_nights(std::vector<KeptFile>& files) const;

  TemporaryFolder folder_{"ddem-damage"};
};

/// Made when it is first asked for.
const KeptFiles& kept_files();

}  // namespace ddem::harness::test
