#pragma once
// Standard input, output and error, and other outputs that are no files.

#include <filesystem>
#include <optional>
#include <string_view>

namespace ddem::harness {

/// At the start of a program: descriptors 0 to 2 are open, so that no file takes the place of one that was closed (writing to
/// a standard output that was closed still fails); a pipe without reader and a file beyond the limit of its size are errors of
/// writing, not signals.
void prepare_streams();

/// Throws MachineError where what was printed has not reached standard output.
void finish_standard_output();

/// The descriptor of this process that a path such as /dev/stdout or /dev/fd/63 leads to.
std::optional<int> own_descriptor(const std::filesystem::path& path);

/// Whether bytes to that path go to a terminal, a pipe, a device, or an open descriptor, and not into a file of that name.
bool is_stream(const std::filesystem::path& path);

/// Throws MachineError.
void write_to_stream(const std::filesystem::path& path, std::string_view content);

/// All of it, in as many calls as it takes. Throws MachineError, which names `path`.
void write_all(int descriptor, std::string_view content, const std::filesystem::path& path);

}  // namespace ddem::harness
