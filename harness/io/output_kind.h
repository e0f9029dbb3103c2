#pragma once
// Files that ddem writes, by what they begin with.

#include <string>
#include <string_view>

namespace ddem::harness {

enum class OutputKind { run_hdf5, signals_csv, packing_csv, xdmf, scene, baseline, curves_csv, figure, bench_json, report, exchange };

/// First line of a scene that ddem has written; what people write themselves has none.
inline constexpr std::string_view kWrittenScene = "# Written by ddem calibrate.\n";

/// "signals as CSV".
std::string_view name_of(OutputKind kind);

/// Whether it can go to a pipe or a device.
bool is_text(OutputKind kind);

/// How much of a file looks_like() must see, in bytes.
inline constexpr std::size_t kBeginningBytes = 1 << 16;

/// Whether a file that begins so may be replaced by one of that kind: ddem wrote it, or it is empty.
bool looks_like(OutputKind kind, std::string_view beginning);

}  // namespace ddem::harness
