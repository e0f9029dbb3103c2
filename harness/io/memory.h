#pragma once
// How much memory a process may still take.

#include <filesystem>
#include <string>

namespace ddem::harness {

/// Bytes: the least of what the machine has free, what the control groups of the process leave, and what `ulimit -v` leaves
/// of its address space. Infinite where nothing says so.
double available_memory();

/// The same of a system whose files stand below `root` ("/"): proc/meminfo, proc/self/cgroup, proc/self/statm and sys/fs/cgroup;
/// `address_space`: the limit of the address space in bytes.
double available_memory(const std::filesystem::path& root, double address_space);

/// "7.9 GB", for messages.
std::string bytes_text(double bytes);

}  // namespace ddem::harness
