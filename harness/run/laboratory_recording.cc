#include "harness/run/laboratory_recording.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/io/errors.h"
#include "harness/io/table_csv.h"
#include "harness/measure/uniform_times.h"
#include "harness/scene/nearest_name.h"
#include "harness/scene/violation.h"

namespace ddem::harness {
namespace {

constexpr std::size_t kShown = 200;

std::size_t column_of(const CsvTable& table, const std::string& name, const std::string& file, const std::string& remedy) {
  const auto& names = table.names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::vector<std::string_view> views(names.begin(), names.end());
  const auto nearest = nearest_name(name, views);
  throw InputError(fmt::format("{}: there is no column {}; {}{}", file, printable(name, kShown),
                               nearest ? fmt::format("did you mean {}?", printable(*nearest, kShown))
                                       : "there are " + printable(fmt::format("{}", fmt::join(names, ", ")), kShown),
                               remedy));
}

std::vector<SensorPlace> first_two(const CsvTable& table, std::size_t time, double distance, const std::string& file) {
  std::vector<SensorPlace> places;
  for (std::size_t c = 0; c < table.names().size() && places.size() < 2; ++c) {
    if (c != time) places.push_back({table.names()[c], places.empty() ? 0.0 : distance});
  }
  if (places.size() < 2) throw InputError(file + ": fewer than two columns beside the time: a speed needs two sensors");
  return places;
}

}  // namespace

ReadRecording read_recording(const std::filesystem::path& signals, const LaboratorySpec& spec, double distance) {
  const std::string file = signals.string();
  const CsvTable table(signals);
  const std::size_t time = column_of(table, spec.time_column, file, "; name the column of the time (--time-column, or time.column)");
  const std::vector<SensorPlace> places = spec.sensors.empty() ? first_two(table, time, distance, file) : spec.sensors;
  std::vector<std::size_t> columns = {time};
  for (const SensorPlace& place : places) columns.push_back(column_of(table, place.column, file, ""));
  std::vector<std::vector<double>> numbers = table.numbers(columns);
  std::vector<double> times = std::move(numbers.front());
  for (double& t : times) t *= spec.time_unit;

  const CheckedTimes checked = uniform_times(times);
  if (const auto& problem = checked.problem) {
    throw InputError(fmt::format("{}:{}: {}: {}; take samples at equal distances, or leave the other rows out", file,
                                 table.line(problem->index), spec.time_column, problem->what));
  }
  const UniformTimes& u = checked.uniform;
  ReadRecording out{{u.t0, u.dt, u.widest_gap, {}}, {}};
  if (u.resampled)
    out.notes.push_back(
        fmt::format("the times are not uniform ({:.4g} to {:.4g} us apart): the signals were taken every {:.4g} us between them, by cubics",
                    1e6 * u.dt, 1e6 * u.widest_gap, 1e6 * u.dt));
  if (const auto& band = spec.options.band; band && std::max(band->low, band->high) >= 0.5 / u.dt)
    throw InputError(fmt::format("the band-pass ends at {:.4g} kHz, but samples every {:.4g} us hold nothing above {:.4g} kHz; lower it",
                                 1e-3 * std::max(band->low, band->high), 1e6 * u.dt, 0.5e-3 / u.dt));
  for (std::size_t s = 0; s < places.size(); ++s) {
    std::vector<double>& values = numbers[s + 1];
    out.recording.sensors.push_back(
        {places[s].column, places[s].position, u.resampled ? at_uniform_times(times, values, u) : std::move(values)});
  }
  return out;
}

}  // namespace ddem::harness
