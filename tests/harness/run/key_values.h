#pragma once
// Scenes as lists of keys, and values to put into them.

#include <map>
#include <string>
#include <vector>

#include "harness/scene/keys.h"

namespace ddem::harness::test {

/// Values, as TOML, by dotted key.
using SceneKeys = std::map<std::string, std::string>;

std::string toml_of(const SceneKeys& keys);

/// Different values that the key may have: of a choice all, else two.
std::vector<std::string> values_of(const KeySpec& spec);

/// A small scene of every kind: packings, schemes, loads, boundaries, ends.
struct BaseScene {
  std::string name;
  SceneKeys keys;
};
const std::vector<BaseScene>& base_scenes();

/// Where the files stand that the values name: two of each kind, for a lattice of 8 columns and 4 rows.
std::string folder_of_files();

}  // namespace ddem::harness::test
