#pragma once
// Shared by the sources of hdf5.h.

#include <string>
#include <string_view>

#include "harness/io/hdf5.h"

namespace ddem::harness::hdf5_detail {

/// "PLACE: WHAT: innermost reason on HDF5's error stack", which it clears.
std::string message(const std::string& place, const std::string& what);

/// The identifier (or status) that HDF5 returned, or MachineError / InputError where it is negative. Only the first says
/// why: it is our doing, while HDF5's words on a file are of no use to its reader.
hid_t written(hid_t id, const std::string& place, const std::string& what);
hid_t found(hid_t id, const std::string& place, const std::string& what);

/// UTF-8 of any length.
Hdf5Handle string_type();

/// Throws std::invalid_argument on text with zero bytes, which HDF5's strings would cut off silently.
void require_storable(std::string_view text, const std::string& place);

}  // namespace ddem::harness::hdf5_detail
