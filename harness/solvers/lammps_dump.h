#pragma once
// Text dumps of LAMMPS.

#include <filesystem>
#include <functional>
#include <span>

namespace ddem::harness {

/// Frame by frame, disc by disc (counted from 0): calls `disc` with the `values` numbers that stand after its id, and `frame`
/// when all of a frame have been read. Throws InputError where something else stands there.
void read_dump(const std::filesystem::path& file, std::size_t discs, std::size_t values,
               const std::function<void(std::size_t disc, std::span<const double> values)>& disc, const std::function<void()>& frame);

}  // namespace ddem::harness
