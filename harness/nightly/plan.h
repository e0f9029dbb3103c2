#pragma once
// The manifest of a campaign: all of its units, whoever runs them. Written before the first of them, and not
// changed.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/io/json.h"
#include "harness/nightly/unit.h"

namespace ddem::harness::nightly {

struct Plan {
  struct Entry {
    std::string id, identity;
    bool operator==(const Entry&) const = default;
  };
  std::string program;  ///< version and digest of what runs the units
  Json campaign;        ///< from which the same units are made again
  std::vector<Entry> units;
  std::string source = {};  ///< the campaign's file, as it was named; empty: none. No part of digest()

  std::string digest() const;
};

/// `program` as program_identity(). Throws std::logic_error where two units share a name.
Plan make_plan(std::span<const Unit> units, Json campaign, const std::string& program);

/// FOLDER/plan.json, read-only; MachineError.
void write_plan(const std::filesystem::path& folder, const Plan& plan);
/// InputError: missing, no plan, or changed by hand.
Plan read_plan(const std::filesystem::path& folder);
bool has_plan(const std::filesystem::path& folder);
/// Whether the folder's plan is whole, and this one.
bool holds_plan(const std::filesystem::path& folder, const Plan& plan);

/// What tells two plans apart, in words; empty: nothing.
std::string difference(const Plan& there, const Plan& here);

}  // namespace ddem::harness::nightly
