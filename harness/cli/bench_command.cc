// ddem bench
#include <fmt/format.h>

#include <memory>

#include "harness/bench/bench.h"
#include "harness/bench/bench_report.h"
#include "harness/campaign/write_results.h"
#include "harness/cli/commands.h"
#include "harness/cli/print_json.h"
#include "harness/io/atomic_file.h"
#include "harness/io/claim_outputs.h"
#include "harness/io/errors.h"
#include "harness/io/memory.h"
#include "harness/io/progress.h"

namespace ddem::harness {
namespace {

struct BenchOptions {
  std::string only, folder;
  std::size_t largest = 100000;
  bool json = false, force = false;
};

void print_kernels(const std::vector<bench::KernelTime>& kernels) {
  if (kernels.empty()) return;
  fmt::print("\n{:<17} {:<8} {:<9} {:>8} {:>8} {:>12} {:>8} {:>9}\n", "law", "packing", "stiffness", "discs", "threads", "ns/bond/step", "best", "over DEM");
  for (const bench::KernelTime& k : kernels) {
    fmt::print("{:<17} {:<8} {:<9} {:>8} {:>8} {:>12.2f} {:>8.2f} {:>9.2f}\n", k.law, bench::name_of(k.arrangement), k.per_bond_stiffness ? "per bond" : "uniform", k.discs,
               k.threads, k.nanoseconds_per_bond_step, k.best, k.over_dem);
  }
}

void print_fem_kernels(const std::vector<bench::FemKernelTime>& kernels) {
  for (const bench::FemKernelTime& k : kernels) {
    fmt::print("\nfinite elements, degree {} on {} x {}, {} dofs, threads {}: {:.0f} million dof-steps a second ({:.2f} times one thread, {} bits)\n",
               k.mesh.degree, k.mesh.elements[0], k.mesh.elements[1], k.dofs, k.threads, 1e-6 * k.dof_steps_per_second, k.over_one_thread,
               k.same_bits ? "the same" : "OTHER");
  }
}

void print_precision(const std::vector<bench::PrecisionPoint>& points) {
  if (points.empty()) return;
  fmt::print("\n{:<6} {:<10} {:<9} {:>13} {:>6} {:>10} {:>10} {:>13}\n", "solver", "scheme", "mesh", "discs or dofs", "step", "seconds", "error", "to continuum");
  for (const bench::PrecisionPoint& p : points) {
    fmt::print("{:<6} {:<10} {:<9} {:>13} {:>6.3g} {:>10.3g} ", p.solver, p.scheme, p.mesh, p.discs_or_dofs, p.step_fraction, p.seconds);
    if (p.status == "ok") {
      fmt::print("{:>10.2g} {:>13.2g}\n", p.error, p.error_to_continuum);
    } else {
      fmt::print("{}\n", p.status);
    }
  }
}

void print_peers(const bench::Peers& peers) {
  for (const bench::PeerTime& p : peers.times) {
    fmt::print("\n{} ({}), {}, {} discs: {:.2f} ns per bond and step; ddem {:.2f}: {:.2f} times as fast (displacements differ by {:.1g})\n",
               p.program, p.version, p.law, p.discs, p.nanoseconds_per_bond_step, p.ddem_nanoseconds_per_bond_step, p.ratio, p.difference);
  }
  if (!peers.reason.empty()) fmt::print("\npeers: {}\n", peers.reason);
}

void print_scaling(const std::vector<bench::ScalingPoint>& points) {
  if (points.empty()) return;
  fmt::print("\n{:<13} {:<8} {:>9} {:>10} {:>10}\n", "command", "packing", "discs", "seconds", "memory");
  for (const bench::ScalingPoint& p : points) {
    fmt::print("{:<13} {:<8} {:>9} ", p.task, bench::name_of(p.arrangement), p.discs);
    if (p.status == "ok") {
      fmt::print("{:>10.3g} {:>10}\n", p.seconds, bytes_text(p.bytes));
    } else {
      fmt::print("{}\n", p.status);
    }
  }
}

struct Files {
  explicit Files(const std::filesystem::path& folder) : json(folder / "bench.json"), html(folder / "bench.html") {}
  std::filesystem::path json, html;
};

void claim_bench_folder(const BenchOptions& o) {
  prepare_folder(o.folder);
  const Files files(o.folder);
  claim_outputs({{files.json, OutputKind::bench_json}, {files.html, OutputKind::report}}, {}, o.force);
}

void write_files(const std::string& folder, const bench::BenchResults& results, const Json& document) {
  const Files files(folder);
  write_json(files.json, document);
  write_file(files.html, reports::render_html(bench::bench_report(results)));
}

int run(const BenchOptions& o) {
  bench::BenchPlan plan;
  if (!o.only.empty()) {
    plan.kernels = o.only == "kernels";
    plan.work_precision = o.only == "work-precision";
    plan.peers = o.only == "peers";
    plan.scaling = o.only == "scaling";
  }
  plan.sizes = bench::scaling_plan(o.largest);
  if (!o.folder.empty()) claim_bench_folder(o);
  bench::BenchResults results;
  {
    Progress progress(bench::bench_work(plan), "measuring");
    results = bench::run_bench(plan, [&] { progress.advance(); });
  }
  const Json document = bench::bench_json(results);
  if (!o.folder.empty()) write_files(o.folder, results, document);
  if (o.json) {
    print_json(document);
    return static_cast<int>(ExitCode::done);
  }
  fmt::print("triad: {:.1f} GB/s with one thread, {:.1f} at most ({} threads)\n", results.triad_one_thread, results.triad, results.triad_threads);
  print_scaling(results.scaling);
  print_kernels(results.kernels);
  print_fem_kernels(results.fem_kernels);
  print_precision(results.work_precision);
  if (!results.fem_failure.empty()) fmt::print("\nno finite elements: {}\n", results.fem_failure);
  if (plan.peers) print_peers(results.peers);
  if (!o.folder.empty()) fmt::print("\nreport: {}/bench.html\n", o.folder);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_bench_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<BenchOptions>();
  CLI::App* command = app.add_subcommand("bench", "Run time against error, and cost per bond and step");
  command->footer("kernels         every contact law and scheme, 682 to 1e6 discs, in a lattice and at random, and the finite elements; one and two threads\n"
                  "work-precision  finite elements by degree and mesh, discs by scheme, step and size, against closed forms\n"
                  "scaling         time and memory of whole commands (pack, moduli, stability, run) from 1e3 discs to --largest\n"
                  "peers           LAMMPS (lmp on the PATH) and Yade (yade) on the same discs, where they are installed (Debian: lammps, yade)\n"
                  "Without --only: all of it, in some five minutes, and a quarter of an hour more with LAMMPS. Times are those of a machine that does nothing else.");
  command->add_option("--only", o->only, "one part of it")->check(CLI::IsMember({"kernels", "work-precision", "scaling", "peers"}));
  command->add_option("--largest", o->largest, "discs of the largest strip of scaling")->check(CLI::Range(1000, 100000000))->capture_default_str();
  CLI::Option* output = command->add_option("-o,--output", o->folder, "folder for bench.json and bench.html, with figures");
  command->add_flag("--force", o->force, "replace files, too, that ddem did not write")->needs(output);
  command->add_flag("--json", o->json, "print the result as JSON");
  command->callback([o, &action] { action = [o] { return run(*o); }; });
}

}  // namespace ddem::harness
