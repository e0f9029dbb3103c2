#include "reports/interactive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>

#include "reports/axis.h"
#include "reports/color.h"
#include "reports/decimate.h"
#include "reports/heat_map.h"
#include "reports/legend.h"
#include "reports/packed.h"
#include "reports/plot_limits.h"
#include "reports/report_json.h"
#include "reports/strip.h"

namespace ddem::reports {
namespace {

constexpr double kTypicalWidth = 400.0,
                 kTypicalHeight = 260.0;  // px, for the unit of an axis and the ticks of a colour bar

/// Markup-safe text of a document.
std::string script_text(const Json& document) {
  std::string text;
  for (const char c : document.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<')
      text += "\\u003c";
    else if (c == '&')
      text += "\\u0026";
    else
      text += c;
  }
  return text;
}

Json short_number(double v) {
  return std::isfinite(v) ? Json(std::strtod(fmt::format("{:.6g}", v).c_str(), nullptr)) : Json(nullptr);
}

constexpr std::size_t kFewNumbers = 48;  // of which each has its digits

/// Times of samples take a few bytes instead of thousands, and many numbers a third of their digits.
Json array_json(const std::vector<double>& values) {
  if (values.size() > 4) {
    const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
    bool even = std::isfinite(step) && step != 0.0;
    for (std::size_t i = 0; even && i < values.size(); ++i)
      even = std::abs(values[i] - (values.front() + static_cast<double>(i) * step)) <= 1e-9 * std::abs(step);
    if (even) return {{"from", values.front()}, {"step", step}, {"count", values.size()}};
  }
  if (values.size() > kFewNumbers) {
    if (const auto packed = packed_numbers(values)) return {{"packed", *packed}};
  }
  Json array = Json::array();
  for (const double v : values) array.push_back(short_number(v));
  return array;
}

std::vector<double> chosen(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> kept;
  if (!values.empty())
    for (const std::size_t row : rows) kept.push_back(values[row]);
  return kept;
}

bool thin(Plot& plot, std::size_t max_points) {
  bool thinned = false;
  for (Series& s : plot.series) {
    if (s.x.size() <= max_points) continue;
    const std::vector<std::size_t> rows = kept_rows(s.y, max_points);
    s.x = chosen(s.x, rows), s.y = chosen(s.y, rows), s.error = chosen(s.error, rows);
    thinned = true;
  }
  for (Band& b : plot.bands) {
    if (b.x.size() <= max_points) continue;
    const std::vector<std::size_t> rows = kept_rows(b.upper, max_points);
    b.x = chosen(b.x, rows), b.lower = chosen(b.lower, rows), b.upper = chosen(b.upper, rows);
    thinned = true;
  }
  return thinned;
}

Json marks_json(const Axis& axis, Limits limits) {
  const AxisMarks marks = axis_marks_along(axis, limits, kTypicalWidth);
  return {{"title", marks.title},
          {"exponent", marks.exponent},
          {"lower", limits.lower},
          {"upper", limits.upper},
          {"log", axis.scale == Scale::log}};
}

void add_looks(Json& panel, const Plot& plot, const StyleBook& styles) {
  panel["xmarks"] = marks_json(plot.x, x_limits(plot));
  panel["ymarks"] = marks_json(plot.y, y_limits(plot));
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    panel["series"][i]["style"] = styles.index_of(plot.series[i]);
  for (std::size_t i = 0; i < plot.bands.size(); ++i)
    panel["bands"][i]["style"] = styles.index_of(plot.bands[i]);
  for (std::size_t i = 0; i < plot.picks.size(); ++i) {
    Json& pick = panel["picks"][i];
    pick["color"] = styles.color_of(plot.picks[i]);
    for (std::size_t s = 0; s < styles.styles().size(); ++s)
      if (!plot.picks[i].series.empty() && styles.styles()[s].name == plot.picks[i].series) pick["style"] = s;
  }
  if (!plot.map) return;
  panel["map"]["title"] = color_title(*plot.map);
  panel["map"]["ticks"] = Json::array();
  for (const ColorTick& t : color_ticks(*plot.map, kTypicalHeight))
    panel["map"]["ticks"].push_back({{"at", t.fraction}, {"label", t.label}});
}

constexpr std::uint8_t kNoValue = 255, kTop = 254;

void add_looks(Json& panel, const Strip& strip) {
  for (std::size_t i = 0; i < strip.fields.size(); ++i) {
    const StripField& field = strip.fields[i];
    const auto [lower, upper] = *field.axis.limits;
    std::vector<std::uint8_t> levels;
    for (const double v : field.values)
      levels.push_back(std::isfinite(v) ? static_cast<std::uint8_t>(std::lround(
                                              std::clamp((v - lower) / (upper - lower), 0.0, 1.0) * kTop))
                                        : kNoValue);
    Json& f = panel["fields"][i];
    f["marks"] = marks_json(field.axis, *field.axis.limits);
    f["signed"] = is_signed(*field.axis.limits);
    f["bytes"] = base64(levels);
  }
}

Json styles_json(const StyleBook& styles) {
  constexpr std::string_view dashes[] = {"solid", "dashed", "dotted"},
                             markers[] = {"circle", "square", "triangle", "diamond"};
  Json all = Json::array();
  for (const Style& s : styles.styles())
    all.push_back({{"name", s.name},
                   {"color", color_hex(s.color)},
                   {"dash", dashes[static_cast<std::size_t>(s.dash)]},
                   {"marker", markers[static_cast<std::size_t>(s.marker)]},
                   {"line", s.has_line},
                   {"points", s.has_marker},
                   {"band", s.has_band}});
  return all;
}

}  // namespace

std::string live_figure(const Figure& figure, std::size_t max_points) {
  Figure slim = figure;
  bool thinned = false;
  for (Panel& panel : slim.panels) {
    if (Plot* plot = std::get_if<Plot>(&panel))
      thinned = thin(*plot, max_points) || thinned;
    else
      for (StripField& field : std::get<Strip>(panel).fields) field.values.clear();
  }
  Json arrays = Json::array();
  std::map<std::string, std::size_t> places;  // of arrays that several series share
  Json document = to_json(slim, [&](const std::vector<double>& values) {
    Json array = array_json(values);
    const auto [place, is_new] = places.try_emplace(array.dump(), places.size());
    if (is_new) arrays.push_back(std::move(array));
    return Json(place->second);
  });
  const StyleBook styles(figure);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    if (const Plot* plot = std::get_if<Plot>(&figure.panels[i]))
      add_looks(document["panels"][i], *plot, styles);
    else
      add_looks(document["panels"][i], std::get<Strip>(figure.panels[i]));
  }
  document["styles"] = styles_json(styles);
  document["thinned"] = thinned;
  return script_text({{"figure", std::move(document)}, {"arrays", std::move(arrays)}});
}

std::string live_palette() {
  const auto list = [](int count, auto color) {
    Json colors = Json::array();
    for (int i = 0; i < count; ++i) colors.push_back(hex(color(static_cast<double>(i) / (count - 1))));
    return colors;
  };
  return script_text({{"viridis", list(16, viridis)},
                      {"diverging", list(11, [](double t) { return diverging(2.0 * t - 1.0); })},
                      {"white_to_blue", list(6, [](double t) { return diverging(-t); })}});
}

}  // namespace ddem::reports
