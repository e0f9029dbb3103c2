#pragma once
// The outcome of a unit as a file: whole, and the very unit's, or refused.
//
// A line of text, "ddem unit 1 CHECKSUM", and CBOR: {id, identity, failure, seconds, result}. The checksum is
// the SHA-256 of all that follows the line.

#include <filesystem>
#include <string>
#include <string_view>

#include "harness/nightly/unit.h"

namespace ddem::harness::nightly {

/// Of a unit's inputs and the program: results of equal identity are interchangeable.
std::string identity_of(const Unit& unit, std::string_view program);

struct UnitRecord {
  std::string id, identity;
  Outcome outcome;
};

std::string to_bytes(const UnitRecord& record);
/// `place` is for messages. Throws InputError saying what is wrong.
UnitRecord parse_unit(std::string_view bytes, const std::string& place);

/// Below FOLDER/cases: see file_of_unit().
std::filesystem::path unit_path(const std::filesystem::path& folder, const std::string& id);

/// Whole or not at all, folders made; MachineError. Not flushed to the disk, as a file that a loss of power damages is refused
/// by its checksum and its unit run again.
void write_unit(const std::filesystem::path& folder, const UnitRecord& record);
/// InputError: missing, damaged, another unit's, or of another identity.
UnitRecord read_unit(const std::filesystem::path& folder, const std::string& id, const std::string& identity);

/// Of the result without the times in it (members "seconds", "solve_seconds", "nanoseconds_per_bond_step"),
/// which no two runs have in common.
std::string content_digest(const UnitRecord& record);

}  // namespace ddem::harness::nightly
