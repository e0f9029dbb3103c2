#pragma once
// Random packings, each jammed once: jamming takes a thousand times as long as a wave run, and a campaign runs many waves
// in one packing.

#include <cstdint>
#include <filesystem>
#include <optional>

#include "dem/core/packing.h"
#include "meshes/packings/random.h"

namespace ddem::harness {

/// random_jammed(spec), from this process' memory, or from the user's cache, or made now; the bits are the same. Threads
/// that ask for the same packing wait for the one that makes it. Throws as random_jammed().
Packing stored_random_packing(const packings::RandomSpec& spec);

/// Where packings outlive the process: $XDG_CACHE_HOME/ddem, or else ~/.cache/ddem; empty where the environment names
/// neither. Files there may be removed at any time.
std::optional<std::filesystem::path> packing_cache_folder();

/// The file of a spec in the cache's folder: its name is a digest of the spec and of the algorithm (kJammingBits).
std::filesystem::path packing_cache_file(const std::filesystem::path& folder, const packings::RandomSpec& spec);

/// The packing in the file, or none: the file does not exist, is not a regular one of this user's, is damaged (it ends with a
/// digest), or holds what is no jammed packing of the spec. Never throws.
std::optional<Packing> read_cached_packing(const std::filesystem::path& file, const packings::RandomSpec& spec) noexcept;

/// What the cache may hold, bytes: some ten thousand packings of 682 discs.
inline constexpr std::uintmax_t kLargestPackingCache = 200'000'000;

/// Removes packings from the folder, those that were not used for longest first, until the others take no more than
/// `most_bytes`. Other files stay. Never throws.
void trim_packing_cache(const std::filesystem::path& folder, std::uintmax_t most_bytes) noexcept;

/// Writes the file whole or not at all, and then trims the folder to kLargestPackingCache; a folder that cannot be written to
/// is no error. Never throws.
void write_cached_packing(const std::filesystem::path& file, const packings::RandomSpec& spec, const Packing& packing) noexcept;

}  // namespace ddem::harness
