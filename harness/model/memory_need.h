#pragma once
// What a command will keep in memory, told before anything is built: a machine that runs out of it in the middle of a run has
// lost the run, or everything else that it was doing.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "harness/scene/scene.h"

namespace ddem::harness {

/// One part of it, and the key that a user would change.
struct MemoryPart {
  std::string what;
  double bytes = 0.0;
  std::string_view key, remedy;
  double count = 0.0;  ///< of what may be fewer: then it is told how many fit
};

/// Throws InputError where all parts together take more than there is: how much that is, and of the largest part its key.
void require_memory(const Scene& scene, std::span<const MemoryPart> parts);

enum class DiscWork {
  packing,     ///< discs and their neighbours
  simulation,  ///< and bonds, critical step, motion
  limits,      ///< and those of the scheme: of lagged strains only where a bound does not do
  statics      ///< and the factors of their stiffness, which grow as n log n, and more so with the strains of deformable discs
};

/// What so many discs take.
MemoryPart memory_of_discs(const Scene& scene, double discs, DiscWork work);

/// How many the scene asks for; empty where a file says so.
std::optional<double> planned_discs(const Scene& scene);

/// require_memory() of the planned discs, where they are known.
void require_memory_of_discs(const Scene& scene, DiscWork work);

/// Bytes that a run's signals take: three numbers a probe and sample, again in the table of them, and in the image of an HDF5
/// file; or in the text of a CSV file, which is longer.
double memory_of_samples(double samples, double probes, bool as_text);
/// Bytes of all fields at so many times, and in the file's image.
double memory_of_snapshots(double discs, int snapshots);
/// Bytes of packings of so many discs that are kept, and of the statics of some `at_once`, of all variants of deformable discs,
/// of which some are not symmetric.
double memory_of_packings(double discs, int packings, int at_once);

/// require_memory() of the latter, of the planned discs where they are known.
void require_memory_of_packings(const Scene& scene, int packings, int at_once);

}  // namespace ddem::harness
