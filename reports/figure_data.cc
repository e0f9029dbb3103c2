#include "reports/figure_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/axis.h"
#include "reports/decimate.h"
#include "reports/number.h"
#include "reports/strip.h"
#include "reports/text.h"

namespace ddem::reports {
namespace {

struct Undrawn {
  std::size_t missing = 0, not_positive = 0, outside = 0;
};

bool outside(double v, const Axis& axis) {
  return axis.limits && (v < axis.limits->lower || v > axis.limits->upper);
}

void count_point(Undrawn& count, const Plot& plot, double x, double y) {
  if (!drawable(x, Scale::linear) || !drawable(y, Scale::linear))
    ++count.missing;
  else if (!drawable(x, plot.x.scale) || !drawable(y, plot.y.scale))
    ++count.not_positive;
  else if (outside(x, plot.x) || outside(y, plot.y))
    ++count.outside;
}

std::string note(std::size_t n, std::string_view singular, std::string_view plural) {
  return fmt::format("{} {}", n, n == 1 ? singular : plural);
}

/// Series and bands of a plot that have the same x, side by side.
struct Group {
  const std::vector<double>* x = nullptr;
  std::vector<Column> columns = {};
  std::vector<const std::vector<double>*> values = {};
};

Group& group_of(std::vector<Group>& groups, const std::vector<double>& x, const Axis& axis) {
  for (Group& g : groups)
    if (*g.x == x) return g;
  return groups.emplace_back(
      Group{&x, {{.heading = axis.label.empty() ? "x" : axis.label, .unit = axis.unit}}, {&x}});
}

std::vector<Group> groups_of(const Plot& plot) {
  std::vector<Group> groups;
  const auto add = [&](Group& g, const std::string& name, const std::string& suffix,
                       const std::vector<double>& v) {
    g.columns.push_back({.heading = (name.empty() ? plot.y.label : name) + suffix, .unit = plot.y.unit});
    g.values.push_back(&v);
  };
  for (const Series& s : plot.series) {
    Group& g = group_of(groups, s.x, plot.x);
    add(g, s.name, "", s.y);
    if (!s.error.empty()) add(g, s.name, " ±", s.error);
  }
  for (const Band& b : plot.bands) {
    Group& g = group_of(groups, b.x, plot.x);
    add(g, b.name, ", lower", b.lower);
    add(g, b.name, ", upper", b.upper);
  }
  return groups;
}

Table table_of(const Group& group, const std::string& title, std::size_t max_rows) {
  Table table{.caption = title, .columns = group.columns};
  const std::size_t n = group.x->size();
  const std::size_t stride =
      std::max<std::size_t>(1, (n + max_rows - 1) / std::max<std::size_t>(1, max_rows));
  if (stride > 1) table.caption += fmt::format("{}one row in {} of {}", title.empty() ? "" : ": ", stride, n);
  for (std::size_t i = 0; i < n; i += stride) {
    std::vector<Cell>& row = table.rows.emplace_back();
    for (const std::vector<double>* v : group.values) row.emplace_back((*v)[i]);
  }
  return table;
}

Table marks_table(const Plot& plot) {
  Table table{
      .caption = plot.title,
      .columns = {
          {.heading = "Mark"}, {.heading = "x", .unit = plot.x.unit}, {.heading = "y", .unit = plot.y.unit}}};
  for (const ReferenceLine& r : plot.references) {
    const bool horizontal = r.direction == Direction::horizontal;
    table.rows.push_back(
        {r.label, horizontal ? Cell("") : Cell(r.value), horizontal ? Cell(r.value) : Cell("")});
  }
  for (const Pick& p : plot.picks)
    table.rows.push_back({"pick: " + p.series + (p.series.empty() || p.label.empty() ? "" : ", ") + p.label,
                          p.x, p.y ? Cell(*p.y) : Cell("")});
  return table;
}

class CsvWriter {
 public:
  CsvWriter(const Figure& figure, std::size_t max_rows) {
    std::size_t series = 0;
    for (const Panel& panel : figure.panels) {
      if (const Plot* plot = std::get_if<Plot>(&panel)) {
        series += plot->series.size() + plot->bands.size();
        has_bands_ = has_bands_ || !plot->bands.empty();
        for (const Series& s : plot->series) has_errors_ = has_errors_ || !s.error.empty();
        if (plot->map) ++series, has_values_ = true;
      } else {
        ++series;
        has_discs_ = true;
      }
    }
    rows_per_series_ = std::max<std::size_t>(8, max_rows / std::max<std::size_t>(1, series));
    csv_.text = "panel,kind,name,x,y";
    if (has_errors_) csv_.text += ",error";
    if (has_bands_) csv_.text += ",lower,upper";
    if (has_discs_) csv_.text += ",radius";
    if (has_discs_ || has_values_) csv_.text += ",value";
    csv_.text += '\n';
  }

  void add(const Plot& plot, std::size_t index) {
    const std::string panel = plot.title.empty() ? std::to_string(index + 1) : plot.title;
    for (const Series& s : plot.series)
      for (const std::size_t i : kept(s.y))
        row(panel, "series", s.name,
            {.x = s.x[i], .y = s.y[i], .error = s.error.empty() ? kNone : s.error[i]});
    if (plot.map) add(*plot.map, panel);
    for (const Band& b : plot.bands)
      for (const std::size_t i : kept(b.upper))
        row(panel, "band", b.name, {.x = b.x[i], .lower = b.lower[i], .upper = b.upper[i]});
    for (const ReferenceLine& r : plot.references)
      row(panel, "reference", r.label,
          r.direction == Direction::horizontal ? Values{.y = r.value} : Values{.x = r.value});
    for (const Pick& p : plot.picks)
      row(panel, "pick", p.series + (p.series.empty() || p.label.empty() ? "" : ", ") + p.label,
          {.x = p.x, .y = p.y.value_or(kNone)});
  }

  void add(const Strip& strip, std::size_t index) {
    const std::string panel = strip.title.empty() ? std::to_string(index + 1) : strip.title;
    for (const Probe& p : strip.probes) row(panel, "probe", p.label, {.x = p.x, .y = p.y});
    const std::size_t stride = (strip.x.size() + rows_per_series_ - 1) / rows_per_series_;
    csv_.thinned = csv_.thinned || stride > 1;
    for (std::size_t i = 0; i < strip.x.size(); i += stride)
      row(panel, "disc", std::to_string(i),
          {.x = strip.x[i],
           .y = strip.y[i],
           .radius = strip.radius[i],
           .value = strip.value.empty() ? kNone : strip.value[i]});
  }

  Csv take() { return std::move(csv_); }

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  struct Values {
    double x = kNone, y = kNone, error = kNone, lower = kNone, upper = kNone, radius = kNone, value = kNone;
  };

  static std::string quoted(std::string_view text) {
    const std::string clean = clean_utf8(text);
    if (clean.find_first_of(",\"\n") == std::string::npos) return clean;
    std::string out = "\"";
    for (const char c : clean) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
  }

  void add(const HeatMap& map, const std::string& panel) {
    const std::size_t stride = (map.value.size() + rows_per_series_ - 1) / rows_per_series_;
    csv_.thinned = csv_.thinned || stride > 1;
    for (std::size_t i = 0; i < map.value.size(); i += stride)
      row(panel, "cell", map.value_axis.label, {.x = map.x[i % map.x.size()], .y = map.y[i / map.x.size()], .value = map.value[i]});
  }

  std::vector<std::size_t> kept(const std::vector<double>& y) {
    csv_.thinned = csv_.thinned || y.size() > rows_per_series_;
    return kept_rows(y, rows_per_series_);
  }

  void row(const std::string& panel, std::string_view kind, const std::string& name, const Values& v) {
    fmt::format_to(std::back_inserter(csv_.text), "{},{},{},{},{}", quoted(panel), kind, quoted(name),
                   csv_number(v.x), csv_number(v.y));
    const auto field = [&](double value) { csv_.text.append(",").append(csv_number(value)); };
    if (has_errors_) field(v.error);
    if (has_bands_) field(v.lower), field(v.upper);
    if (has_discs_) field(v.radius);
    if (has_discs_ || has_values_) field(v.value);
    csv_.text += '\n';
  }

  Csv csv_;
  bool has_errors_ = false, has_bands_ = false, has_discs_ = false, has_values_ = false;
  std::size_t rows_per_series_ = 0;
};

}  // namespace

std::vector<std::string> notes_of(const Figure& figure) {
  Undrawn count;
  std::size_t grey_cells = 0;
  std::vector<std::string> notes;
  for (const Panel& panel : figure.panels) {
    if (const Plot* plot = std::get_if<Plot>(&panel)) {
      for (const Series& s : plot->series)
        for (std::size_t i = 0; i < s.x.size(); ++i) count_point(count, *plot, s.x[i], s.y[i]);
      if (plot->map)
        grey_cells += static_cast<std::size_t>(std::count_if(plot->map->value.begin(), plot->map->value.end(),
                                                             [](double v) { return !std::isfinite(v); }));
      for (const Band& b : plot->bands)
        for (std::size_t i = 0; i < b.x.size(); ++i) {
          const bool whole = std::isfinite(b.lower[i]);
          count_point(count, *plot, b.x[i], whole ? b.upper[i] : b.lower[i]);
        }
      continue;
    }
    const Strip& strip = std::get<Strip>(panel);
    const auto grey = static_cast<std::size_t>(std::count_if(
        strip.value.begin(), strip.value.end(), [](double v) { return !drawable(v, Scale::linear); }));
    if (grey > 0)
      notes.push_back(note(grey, "disc without a value is grey.", "discs without a value are grey."));
    if (discs_drawn(strip) < strip.x.size())
      notes.push_back(fmt::format("{} of {} discs are drawn, enlarged.", discs_drawn(strip), strip.x.size()));
  }
  if (grey_cells > 0) notes.push_back(note(grey_cells, "cell without a value is grey.", "cells without a value are grey."));
  if (count.missing > 0)
    notes.push_back(note(count.missing, "missing value is a gap.", "missing values are gaps."));
  if (count.not_positive > 0)
    notes.push_back(note(count.not_positive,
                         "value that is not positive has no place on the logarithmic axis.",
                         "values that are not positive have no place on the logarithmic axis."));
  if (count.outside > 0)
    notes.push_back(
        note(count.outside, "point is outside the range shown.", "points are outside the range shown."));
  return notes;
}

std::vector<Table> data_tables(const Figure& figure, std::size_t max_rows) {
  std::vector<Table> tables;
  for (const Panel& panel : figure.panels) {
    if (const Plot* plot = std::get_if<Plot>(&panel)) {
      for (const Group& g : groups_of(*plot)) tables.push_back(table_of(g, plot->title, max_rows));
      if (!plot->references.empty() || !plot->picks.empty()) tables.push_back(marks_table(*plot));
    } else if (const Strip& strip = std::get<Strip>(panel); !strip.probes.empty()) {
      Table& table = tables.emplace_back(Table{
          .caption = strip.title,
          .columns = {{.heading = "Probe"}, {.heading = "x", .unit = "m"}, {.heading = "y", .unit = "m"}}});
      for (const Probe& p : strip.probes) table.rows.push_back({p.label, p.x, p.y});
    }
  }
  return tables;
}

Csv figure_csv(const Figure& figure, std::size_t max_rows) {
  CsvWriter writer(figure, max_rows);
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    std::visit([&](const auto& panel) { writer.add(panel, i); }, figure.panels[i]);
  return writer.take();
}

}  // namespace ddem::reports
