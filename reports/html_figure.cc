#include "reports/figure_data.h"
#include "reports/html_parts.h"
#include "reports/svg.h"
#include "reports/text.h"

namespace ddem::reports {
namespace {

// A table row takes some ten times as many bytes as it has digits, so that long data are only in the CSV.
void append_data(Markup& out, const Figure& figure, const Detail& detail) {
  const Csv csv = figure_csv(figure, detail.csv_rows);
  out.open("details", {{"class", "data"}}).element("summary", {}, "Data").newline();
  out.open("p", {{"class", "note"}});
  out.open("a", {{"download", slug(figure.id) + ".csv"},
                 {"href", std::string("data:text/csv;charset=utf-8,").append(percent_encode(csv.text))}});
  out.text("Download CSV").open("span", {{"class", "hidden"}}).text(" of " + figure.title).close().close();
  out.text(csv.thinned ? " (SI units; long series are thinned, their extremes kept)."
                       : " (SI units, all points).");
  out.close().newline();
  for (const Table& table : data_tables(figure, detail.table_rows)) append_table(out, table);
  out.close().newline();
}

}  // namespace

void append_figure(Markup& out, const Figure& figure, const std::string& anchor, const Detail& detail) {
  out.open("figure", {{"id", anchor}}).newline();
  if (!figure.title.empty()) out.element("h3", {}, figure.title).newline();
  out.open("div", {{"class", detail.narrow_drawings ? "drawing wide" : "drawing"}});
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
