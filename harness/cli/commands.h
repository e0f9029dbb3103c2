#pragma once
// The commands of the program: each sets up its options and returns the exit code.

#include <CLI/CLI.hpp>
#include <functional>

namespace ddem::harness {

/// What a parsed command line asks for; set by the command's callback.
using Action = std::function<int()>;

void add_run_command(CLI::App& app, Action& action);
void add_export_command(CLI::App& app, Action& action);
void add_measure_command(CLI::App& app, Action& action);
void add_fem_command(CLI::App& app, Action& action);
void add_moduli_command(CLI::App& app, Action& action);
void add_stability_command(CLI::App& app, Action& action);
void add_pack_command(CLI::App& app, Action& action);
void add_validate_command(CLI::App& app, Action& action);
void add_calibrate_command(CLI::App& app, Action& action);
void add_merge_command(CLI::App& app, Action& action);
void add_baseline_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);
void add_history_command(CLI::App& app, Action& action);
void add_bench_command(CLI::App& app, Action& action);
void add_report_command(CLI::App& app, Action& action);
void add_completion_command(CLI::App& app, Action& action);
void add_scene_reference_command(CLI::App& app, Action& action);

}  // namespace ddem::harness
