#include "tests/reports/full_report.h"

#include <cmath>
#include <limits>

namespace ddem::reports::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Figure curves() {
  Plot speeds{
      .title = "speeds, \"quoted\"", .x = {.label = "kₜ/kₙ"}, .y = {.label = "velocity", .unit = "m/s"}};
  Series measured{.name = "measured, mean", .kind = SeriesKind::markers},
      statics{.name = "static", .color = Color::vermilion, .dash = Dash::dashed};
  Band seeds{.name = "measured, mean"};
  for (int i = 0; i <= 10; ++i) {
    const double ratio = 0.1 * i, speed = 2000.0 + 300.0 * ratio;
    measured.x.push_back(ratio), measured.y.push_back(i == 4 ? kNan : speed + 20.0),
        measured.error.push_back(15.0);
    statics.x.push_back(ratio), statics.y.push_back(speed);
    seeds.x.push_back(ratio), seeds.lower.push_back(i == 7 ? kNan : speed - 40.0),
        seeds.upper.push_back(speed + 60.0);
  }
  speeds.series = {measured, statics};
  speeds.bands = {seeds};
  speeds.references = {
      {.value = 2100.0, .label = "bound"},
      {.direction = Direction::vertical, .value = 0.5, .label = "half", .dash = Dash::dotted}};
  Plot errors{.x = {.label = "step", .scale = Scale::log},
              .y = {.label = "error", .scale = Scale::log, .limits = Limits{1e-8, 1.0}}};
  Series order{.name = "second order", .kind = SeriesKind::line_markers, .color = Color::green};
  for (double h = 1e-3; h < 0.7; h *= 2.0) order.x.push_back(h), order.y.push_back(h * h);
  errors.series = {order};
  return {
      .id = "curves", .title = "Curves <&>", .caption = "Marks lie on lines.", .panels = {speeds, errors}};
}

Figure signals() {
  Plot plot{.x = {.label = "time", .unit = "s"}, .y = {.label = "displacement", .unit = "m"}};
  Series near{.name = "A1", .color = Color::blue};
  for (int i = 0; i < 5000; ++i)
    near.x.push_back(i * 2e-9),
        near.y.push_back(1e-8 * std::exp(-std::pow((i - 1500) / 300.0, 2)) * std::cos(0.013 * i));
  plot.series = {near};
  plot.picks = {{.x = 3e-6, .y = 1e-8, .series = "A1"}, {.x = 5e-6, .label = "window ends"}};
  return {.id = "signals",
          .title = "A signal and its pick",
          .caption = "The ring is on the crest.",
          .panels = {plot},
          .columns = 1};
}

HeatMap map(ColorScale scale, Limits limits, double (*value)(double, double)) {
  HeatMap m{.value_axis = {.label = "amplitude", .limits = limits}, .scale = scale};
  for (int i = 0; i < 20; ++i) m.x.push_back(0.5 + i);
  for (int j = 0; j < 12; ++j) m.y.push_back(std::pow(10.0, -2.0 + 0.25 * j));
  for (const double y : m.y)
    for (const double x : m.x) m.value.push_back(value(x, y));
  m.value[5] = kNan;
  return m;
}

Figure maps() {
  const Axis wavenumber{.label = "wavenumber", .unit = "1/m"},
      softness{.label = "softness", .scale = Scale::log};
  Plot decades{.title = "decades", .x = wavenumber, .y = softness};
  decades.map =
      map(ColorScale::log, {1e-3, 1.0}, [](double x, double y) { return std::exp(-x / 3.0) / (1.0 + y); });
  decades.series = {{.name = "branch", .x = {1.0, 10.0, 19.0}, .y = {0.02, 0.3, 4.0}, .color = Color::black}};
  Plot growth{.title = "growth", .x = wavenumber, .y = softness};
  growth.map =
      map(ColorScale::signed_log, {1e-6, 1e-1}, [](double x, double y) { return 1e-2 * std::sin(x) * y; });
  Plot linear{.title = "linear", .x = wavenumber, .y = softness};
  linear.map = map(ColorScale::linear, {0.0, 20.0}, [](double x, double) { return x; });
  return {.id = "maps",
          .title = "Maps",
          .caption = "Colours by value.",
          .panels = {decades, growth, linear},
          .columns = 3};
}

Strip strip(const std::string& title, double speed) {
  Strip s{.title = title,
          .value_axis = {.label = "displacement", .unit = "m", .limits = Limits{-1e-8, 1e-8}},
          .probes = {{2e-3, 1e-3, "A1"}, {8e-3, 2e-4, "A2"}}};
  for (int i = 0; i < 120; ++i) {
    s.x.push_back(2.5e-4 + 5e-4 * (i % 30)), s.y.push_back(2.5e-4 + 5e-4 * (i / 30)),
        s.radius.push_back(2.4e-4);
    s.value.push_back(1e-8 * std::sin(s.x.back() * 900.0));
  }
  StripField u{.axis = {.label = "displacement", .unit = "m", .limits = Limits{-1e-8, 1e-8}}},
      sigma{.axis = {.label = "pressure", .unit = "Pa", .limits = Limits{0.0, 1e5}}};
  for (int f = 0; f < 12; ++f) {
    s.times.push_back(f * 5e-7);
    for (const double x : s.x) {
      const double phase = 900.0 * (x - speed * s.times.back());
      u.values.push_back(f == 3 && x < 6e-4 ? kNan : 1e-8 * std::sin(phase));
      sigma.values.push_back(1e5 * std::pow(std::cos(phase), 2));
    }
  }
  s.fields = {u, sigma};
  return s;
}

std::vector<Verdict> verdicts() {
  const Criterion good{.metric = "velocity",
                       .actual = 2000.1,
                       .target = 2000.0,
                       .lower = 1990.0,
                       .upper = 2010.0,
                       .unit = "m/s",
                       .derivation = "0.5 %",
                       .state = State::pass};
  Criterion bad = good;
  bad.actual = 2050.0, bad.state = State::fail;
  const Criterion none{.metric = "drift", .upper = 1e-9, .derivation = "round-off", .state = State::error};
  return {{.case_id = "wave/random/dem",
           .title = "Wave",
           .state = State::pass,
           .criteria = {good},
           .reproduce = "ddem validate --only wave/random/dem",
           .facets = {{"check", "wave"}, {"packing", "random"}}},
          {.case_id = "wave/random/f",
           .title = "Wave, F",
           .state = State::fail,
           .reason = "too fast",
           .criteria = {good, bad},
           .reproduce = "ddem validate --only wave/random/f",
           .facets = {{"check", "wave"}, {"packing", "random"}}},
          {.case_id = "energy",
           .title = "Energy",
           .state = State::error,
           .reason = "a <crash> & no number",
           .criteria = {none},
           .facets = {{"check", "energy"}}},
          {.case_id = "wave/lattice/n",
           .title = "Wave, N",
           .state = State::unstable_as_expected,
           .facets = {{"check", "wave"}, {"packing", "lattice"}}},
          {.case_id = "later", .title = "Later", .state = State::skipped, .reason = "not asked for"}};
}

}  // namespace

Report full_report() {
  Figure film{.id = "film",
              .title = "Strip over time",
              .caption = "A wave runs to the right.",
              .panels = {strip("slow", 2000.0), strip("fast", 3000.0)}};
  Figure still{.id = "still",
               .title = "Strip at rest",
               .caption = "Discs without a value.",
               .panels = {Strip{.x = {0.0, 1e-3}, .y = {0.0, 0.0}, .radius = {5e-4, 5e-4}}}};
  const Table table{.caption = "A table",
                    .columns = {{"model"}, {"speed", "m/s", 4}},
                    .rows = {{"DEM", 2000.123}, {"none", kNan}, {"short"}, {"course", Spark{{0.1, kNan, 0.9, 1.1}}}}};
  return {.title = "Everything",
          .findings = {"Waves run as they should."},
          .summary = {"One of each."},
          .headlines = {{"speed", "2000 m/s", "closed form 2001"}, {"ratio", "0.33"}},
          .nights = {{"first: 1 of 1 passed", State::pass}, {"second: broken", State::fail}},
          .verdicts = verdicts(),
          .sections = {{.heading = "Figures",
                        .paragraphs = {"Text."},
                        .figures = {curves(), signals(), maps(), film, still},
                        .tables = {table}},
                       {.heading = "Empty"}},
          .provenance = {{"version", "1.0"}, {"compiler", "any"}}};
}

}  // namespace ddem::reports::test
