#include "harness/io/output_kind.h"

#include <algorithm>
#include <array>

namespace ddem::harness {
namespace {

std::string_view first_line(std::string_view text) {
  std::string_view line = text.substr(0, text.find('\n'));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// time,disc12_ux,disc12_uy,...: nobody else's table of times has such columns. The last may be cut off by kBeginningBytes.
bool is_header_of_signals(std::string_view text) {
  std::string_view line = first_line(text);
  const bool whole = line.size() < text.size();
  if (!line.starts_with("time")) return false;
  line.remove_prefix(4);
  while (!line.empty()) {
    const std::string_view column = line.substr(0, line.find(',', 1));
    line.remove_prefix(column.size());
    constexpr std::array<std::string_view, 3> endings{"_ux", "_uy", "_theta"};
    const auto ends = [&](std::string_view e) { return column.ends_with(e); };
    if (!column.starts_with(',')) return false;
    if ((whole || !line.empty()) && std::none_of(endings.begin(), endings.end(), ends)) return false;
  }
  return whole || text.size() >= kBeginningBytes;
}

/// The names of a run's root group and attributes stand at the beginning of its file, as they are.
bool is_run(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("\x89HDF\r\n\x1a\n") && contains(bytes, "signals\0"sv) && contains(bytes, "scene\0"sv) &&
         contains(bytes, "instruction set\0"sv) && !contains(bytes, "statics\0"sv) && !contains(bytes, "units\0"sv);  // those are campaigns''
}

bool is_exchange(std::string_view text) {
  constexpr std::array<std::string_view, 7> kBeginnings{"{\n  \"protocol\": ", "id,x,y,radius,mass,", "i,j,nx,ny,length,arm_i,", "receiver,disc\n", "disc\n",
                                                         "ddem export --format lammps: ", "# ddem export --format lammps: "};
  return std::any_of(kBeginnings.begin(), kBeginnings.end(), [&](std::string_view beginning) { return text.starts_with(beginning); });
}

}  // namespace

std::string_view name_of(OutputKind kind) {
  switch (kind) {
    case OutputKind::run_hdf5: return "a run's HDF5 file";
    case OutputKind::signals_csv: return "signals as CSV";
    case OutputKind::packing_csv: return "a packing as CSV";
    case OutputKind::xdmf: return "an XDMF file";
    case OutputKind::scene: return "a scene of ddem calibrate";
    case OutputKind::baseline: return "a baseline";
    case OutputKind::curves_csv: return "design curves as CSV";
    case OutputKind::figure: return "an SVG figure";
    case OutputKind::bench_json: return "measurements of ddem bench";
    case OutputKind::report: return "a report";
    case OutputKind::exchange: return "a file of ddem export";
  }
  return "";
}

bool is_text(OutputKind kind) {
  return kind != OutputKind::run_hdf5 && kind != OutputKind::xdmf;
}

bool looks_like(OutputKind kind, std::string_view text) {
  if (text.empty()) return true;
  switch (kind) {
    case OutputKind::run_hdf5: return is_run(text);
    case OutputKind::signals_csv: return is_header_of_signals(text);
    case OutputKind::packing_csv: return first_line(text) == "x,y,radius";
    case OutputKind::xdmf: return text.starts_with("<?xml") && contains(text, "<Xdmf ");
    case OutputKind::scene: return text.starts_with(kWrittenScene);
    case OutputKind::baseline: return text.starts_with("{\n\"schema_version\": 1,\n\"metrics\": {");
    case OutputKind::curves_csv: return text.starts_with("model,coordination,softness,particle_poisson_ratio,");
    case OutputKind::figure:
      return text.starts_with("<?xml ") && contains(text, "\n<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 ") &&
             contains(text, " role=\"img\" aria-labelledby=\"");
    case OutputKind::bench_json:
      return text.starts_with("{\n  \"schema_version\": 1,\n  \"provenance\": {") && contains(text, "\n  \"kernels\": ");
    case OutputKind::report:
      return text.starts_with("<!DOCTYPE html>\n<html lang=\"en\">\n") && contains(text, "rel=\"icon\" href=\"data:,\"");
    case OutputKind::exchange: return is_exchange(text);
  }
  return false;
}

}  // namespace ddem::harness
