// What comes from other programs and laboratories: descriptions of solvers, signals, places of sensors.
#include "harness/io/signals_csv.h"
#include "harness/run/laboratory_file.h"
#include "harness/solvers/description.h"
#include "tests/fuzz/fuzz.h"

void fuzz(std::string_view text) {
  using namespace ddem::harness;
  refused_or_read([&] {
    const SolverDescription d = parse_solver_description(std::string(text), "/nowhere/fuzz.toml");
    require(!d.name.empty() && !d.command.empty() && d.time_limit > 0.0 && d.ranks > 0);
  });
  refused_or_read([&] {
    const SignalTable t = parse_signals_csv(text, "fuzz.csv");
    for (const auto& channel : t.channels) require(channel.size() == t.time.size());
  });
  const auto sensors = parse_laboratory_file(text, "fuzz.toml");
  require(sensors.value.has_value() == sensors.violations.empty());
}
