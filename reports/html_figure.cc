#include <algorithm>

#include "reports/figure_data.h"
#include "reports/html_parts.h"
#include "reports/interactive.h"
#include "reports/svg.h"
#include "reports/text.h"

namespace ddem::reports {
namespace {

// A data URI; an interactive page makes the file from the figure's data, which it holds already.
void append_csv_link(Markup& out, const Figure& figure, const Detail& detail) {
  if (detail.live_points > 0) {
    out.element("p", {{"class", "note csv"}}, "").newline();
    return;
  }
  const Csv csv = figure_csv(figure, detail.csv_rows);
  out.open("p", {{"class", "note"}});
  out.open("a", {{"download", slug(figure.id) + ".csv"},
                 {"href", std::string("data:text/csv;charset=utf-8,").append(percent_encode(csv.text))}});
  out.text("Download CSV").open("span", {{"class", "hidden"}}).text(" of " + figure.title).close().close();
  out.text(csv.thinned ? " (SI units; long series are thinned, their extremes kept)."
                       : " (SI units, all points).");
  out.close().newline();
}

// A table row takes some ten times as many bytes as it has digits, so that long data are only in the CSV.
void append_data(Markup& out, const Figure& figure, const Detail& detail) {
  out.open("details", {{"class", "data"}}).element("summary", {}, "Data").newline();
  append_csv_link(out, figure, detail);
  if (!figure.made_by.empty()) {
    out.open("p", {{"class", "note"}}).text("Made by ").element("code", {}, figure.made_by);
    out.text(detail.program.empty() ? "." : " of " + std::string(detail.program) + ".").close().newline();
  }
  for (const Table& table : data_tables(figure, detail.table_rows)) append_table(out, table, Folding::none);
  out.close().newline();
}

// A strip moves only where it has frames; without them its SVG shows all there is.
bool is_live(const Figure& figure) {
  return std::all_of(figure.panels.begin(), figure.panels.end(), [](const Panel& panel) {
    const Strip* strip = std::get_if<Strip>(&panel);
    return strip == nullptr || (!strip->fields.empty() && !strip->times.empty());
  });
}

}  // namespace

void append_figure(Markup& out, const Figure& figure, const std::string& anchor, const Detail& page) {
  require_valid(figure);
  Detail detail = page;
  if (!is_live(figure)) detail.live_points = 0;
  out.open("figure", {{"id", anchor}}).newline();
  if (!figure.title.empty()) {
    out.open("h3").text(figure.title);
    append_permalink(out, anchor, figure.title);
    out.close().newline();
  }
  if (detail.live_points > 0) {
    out.open("div", {{"class", "live"}}).text("").close();
    out.open("script", {{"type", "application/json"}, {"class", "figure-data"}});
    out.raw(live_figure(figure, detail.live_points)).close().newline();
  }
  out.open("div", {{"class", detail.narrow_drawings ? "drawing wide" : detail.live_points > 0 ? "drawing still" : "drawing"}});
  out.raw(render_embedded_svg(figure, {.width = 860.0, .side_by_side = true, .id_prefix = anchor + "-w"}))
      .close();
  if (detail.narrow_drawings) {
    out.open("div", {{"class", "drawing narrow"}});
    out.raw(render_embedded_svg(figure, {.width = 400.0, .side_by_side = false, .id_prefix = anchor + "-n"}))
        .close();
  }
  out.newline().open("figcaption").text(figure.caption);
  for (const std::string& note : notes_of(figure)) out.text(" ").element("span", {{"class", "note"}}, note);
  out.close().newline();
  append_data(out, figure, detail);
  out.close().newline();
}

}  // namespace ddem::reports
