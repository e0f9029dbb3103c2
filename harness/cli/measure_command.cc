// ddem measure SIGNALS.csv, and ddem measure SCENE.toml SIGNALS.csv
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/cli/commands.h"
#include "harness/cli/measure_scene.h"
#include "harness/cli/print_json.h"
#include "harness/io/errors.h"
#include "harness/io/message.h"
#include "harness/run/laboratory_json.h"
#include "harness/run/laboratory_recording.h"
#include "harness/run/laboratory_text.h"
#include "harness/scene/units.h"

namespace ddem::harness {
namespace {

constexpr const char* kFooter =
    R"(Of a scene that any program ran (the columns as ddem run --signals writes them), its speeds and moduli; a bar and a shear wave: nu too

  ddem measure bar.toml bar.csv
  ddem measure bar.toml bar.csv shear.toml shear.csv

Without a scene: a wave passes two sensors or more; how much later it comes to the farther ones is its speed. Example: the columns of a digitiser,
time in microseconds, two sensors 10 mm apart, and P waves in a material of 2400 kg/m3:

  ddem measure shots.csv --distance "10 mm" --time-unit us --columns near,far --density "2400 kg/m3" --wave p

More sensors stand in a file, with the same settings:

  ddem measure shots.csv --positions sensors.toml
    [[sensor]]
    column = "a"
    position = "12 mm"
    [[sensor]]
    column = "b"
    position = "22 mm"
    [time]
    unit = "us"            # column = "time"
    [source]
    polarity = "auto"      # duration = "8 us"
    [filter]
    low = "50 kHz"
    high = "2 MHz"
    [material]
    density = 2400
    wave = "p"

A number comes with its standard deviation, of the noise in the quiet part before the wave. What cannot be measured is a reason and
what to change. More in harness/guide/measure.md.)";

struct MeasureOptions {
  std::vector<std::string> words;  // SIGNALS, or SCENE SIGNALS ...
  std::string distance, positions, time_column, unit, polarity, band, source_duration, density, wave, pick = "all";
  std::vector<std::string> columns;
  bool json = false;
};

double quantity(const char* option, const std::string& text, Dimension dimension) {
  // A plain number is SI, as in a file.
  Quantity q = parse_quantity(text, dimension);
  if (!q.si) {
    if (const Quantity plain = parse_quantity(text + std::string(" ") + std::string(si_unit(dimension)), dimension); plain.si) q = plain;
  }
  const std::string problem = !q.si ? q.problem : !(*q.si > 0.0) ? "must be greater than 0" : magnitude_problem(*q.si, dimension);
  if (!problem.empty())
    throw InputError(fmt::format("{} {}: {}; write {}", option, printable(text), problem, quantity_examples(dimension)));
  return *q.si;
}

Band band_of(const std::string& text) {
  const std::size_t comma = text.find(',');
  const auto edge = [&](const std::string& part) {
    return part.find_first_not_of(' ') == std::string::npos || part == "0" ? 0.0 : quantity("--band-pass", part, Dimension::frequency);
  };
  const Band band = comma == std::string::npos ? Band{} : Band{edge(text.substr(0, comma)), edge(text.substr(comma + 1))};
  if ((band.low == 0.0 && band.high == 0.0) || (band.high > 0.0 && band.low >= band.high))
    throw InputError(fmt::format("--band-pass {}: write LOW,HIGH such as \"50 kHz,2 MHz\"; 0 leaves an edge open", printable(text)));
  return band;
}

LaboratorySpec from_file(const std::string& path) {
  const Checked<LaboratorySpec> spec = read_laboratory_file(path);
  if (spec) return *spec;
  std::vector<std::string> lines;
  for (const Violation& v : spec.violations) lines.push_back(to_string(v));
  throw InputError(lines);
}

void check_combination(const MeasureOptions& o) {
  if (o.positions.empty() == o.distance.empty())
    throw InputError(o.distance.empty()
                         ? "measure: how far apart are the sensors? Give --distance \"10 mm\", or --positions FILE.toml for more than two"
                         : "measure: --distance and --positions say the same; leave one of them out");
  if (!o.positions.empty() && !o.columns.empty())
    throw InputError("measure: --columns: the columns stand in the file of --positions; leave it out");
  if (!o.columns.empty() && (o.columns.size() != 2 || o.columns[0] == o.columns[1]))
    throw InputError("measure: --columns: give two different ones, such as near,far; more than two stand in a file: --positions FILE.toml");
}

/// The file's, and over them the options of the command line.
LaboratorySpec spec_of(const MeasureOptions& o) {
  check_combination(o);
  LaboratorySpec spec = o.positions.empty() ? LaboratorySpec{} : from_file(o.positions);
  if (!o.time_column.empty()) spec.time_column = o.time_column;
  if (!o.unit.empty()) spec.time_unit = time_unit(o.unit).value();
  LaboratoryOptions& l = spec.options;
  if (!o.polarity.empty()) l.polarity = polarity_of(o.polarity);
  if (!o.band.empty()) l.band = band_of(o.band);
  if (!o.source_duration.empty()) l.source_duration = quantity("--source-duration", o.source_duration, Dimension::time);
  if (!o.density.empty()) l.density = quantity("--density", o.density, Dimension::density);
  if (!o.wave.empty()) l.wave = wave_kind(o.wave);
  if (l.density.has_value() != l.wave.has_value())
    throw InputError(l.density ? "measure: --density: of which wave? Add --wave p, shear or bar for the modulus M, G or E"
                               : "measure: --wave: add --density for the modulus, or leave it out");
  if (!o.columns.empty()) spec.sensors = {{o.columns[0], 0.0}, {o.columns[1], 0.0}};
  return spec;
}

std::vector<Mark> marks_of(const std::string& pick) {
  if (pick == "all") return {kMarks.begin(), kMarks.end()};
  for (const Mark mark : kMarks) {
    std::string word(name(mark));
    std::replace(word.begin(), word.end(), ' ', '-');
    if (word == pick) return {mark};
  }
  throw std::logic_error("--pick is one of its choices");
}

bool of_scenes(const MeasureOptions& o) { return o.words.size() > 1 || o.words.front().ends_with(".toml"); }

void require_no_settings(const MeasureOptions& o) {
  const std::pair<const char*, bool> kSettings[] = {
      {"--distance", !o.distance.empty()},   {"--positions", !o.positions.empty()},  {"--time-column", !o.time_column.empty()},
      {"--time-unit", !o.unit.empty()},      {"--polarity", !o.polarity.empty()},    {"--band-pass", !o.band.empty()},
      {"--source-duration", !o.source_duration.empty()}, {"--density", !o.density.empty()}, {"--wave", !o.wave.empty()},
      {"--columns", !o.columns.empty()},     {"--pick", o.pick != "all"}};
  for (const auto& [option, given] : kSettings) {
    if (given) throw InputError(fmt::format("measure: {}: the scene says what the signals are; leave it out, or give the signals alone", option));
  }
}

int measure(const MeasureOptions& o) {
  if (of_scenes(o)) {
    require_no_settings(o);
    return measure_scenes(o.words, o.json);
  }
  LaboratorySpec spec = spec_of(o);
  const double distance = o.distance.empty() ? 0.0 : quantity("--distance", o.distance, Dimension::length);
  if (!o.columns.empty()) spec.sensors[1].position = distance;
  const std::vector<Mark> marks = marks_of(o.pick);
  const auto [recording, notes] = read_recording(o.words.front(), spec, distance);
  LaboratoryResult result = measure_recording(recording, spec.options);
  result.notes.insert(result.notes.begin(), notes.begin(), notes.end());
  if (o.json)
    print_json(laboratory_json(recording, spec.options, result));
  else
    fmt::print("{}", printable(laboratory_text(recording, spec.options, result, marks)));
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_measure_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<MeasureOptions>();
  CLI::App* command = app.add_subcommand("measure", "Wave speeds from signals of a laboratory, or of any program that ran a scene");
  command->footer(kFooter);
  command->add_option("SIGNALS", o->words, "CSV file: a line of names, then rows; one column is the time. Or SCENE SIGNALS, or two such pairs")
      ->required();
  command->add_option("--distance", o->distance, "of two sensors, along the wave's way, such as \"10 mm\"");
  command->add_option("--columns", o->columns, "the nearer sensor's and the farther one's (default: the first two beside the time)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--positions", o->positions, "instead: a file that says which column stands where (see below)");
  command->add_option("--time-column", o->time_column, "name of the time's column (default: time)");
  command->add_option("--time-unit", o->unit, "s (default), ms, us or ns")->check(CLI::IsMember({"s", "ms", "us", "ns"}));
  command->add_option("--polarity", o->polarity, "of the wave's first crest: auto (default), positive or negative")
      ->check(CLI::IsMember({"auto", "positive", "negative"}));
  command->add_option("--band-pass", o->band, "filter without delay: LOW,HIGH such as \"50 kHz,2 MHz\"; 0 leaves an edge open");
  command->add_option("--source-duration", o->source_duration,
                      "of the pulse that was sent, such as \"8 us\": what is much shorter is none of it");
  command->add_option("--pick", o->pick, "peak, first-break, centroid, correlation, or all of them")
      ->check(CLI::IsMember({"peak", "first-break", "centroid", "correlation", "all"}))
      ->capture_default_str();
  command->add_option("--density", o->density, "of the material, for its modulus; with --wave");
  command->add_option("--wave", o->wave, "p: M = rho c^2; shear: G; bar: E")->check(CLI::IsMember({"p", "shear", "bar"}));
  command->add_flag("--json", o->json, "print the result as JSON");
  command->callback([o, &action] { action = [o] { return measure(*o); }; });
}

}  // namespace ddem::harness
