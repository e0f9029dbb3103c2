#include <set>
#include <span>
#include <stdexcept>
#include <string>

#include "reports/html_assets.h"
#include "reports/html_parts.h"
#include "reports/interactive.h"
#include "reports/report.h"
#include "reports/text.h"

namespace ddem::reports {
namespace {

/// Ids of the page; the second figure "nu" becomes "nu-2".
class Anchors {
 public:
  std::string make(std::string_view text) {
    const std::string base = slug(text);
    std::string id = base;
    for (int n = 2; !used_.insert(id).second; ++n) id = base + "-" + std::to_string(n);
    return id;
  }

 private:
  std::set<std::string> used_ = {"verdicts", "provenance"};
};

constexpr std::string_view kMark = "ddem-campaign";

void append_head(Markup& out, const Report& report, std::string_view campaign) {
  out.open("head").newline();
  out.empty("meta", {{"charset", "utf-8"}});
  if (!campaign.empty()) out.empty("meta", {{"name", kMark}, {"content", campaign}});
  out.empty("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
  // Without an icon of its own a page from a server asks for one.
  out.empty("link", {{"rel", "icon"}, {"href", "data:,"}});
  out.element("title", {}, report.title.empty() ? "Report" : report.title);
  out.open("style").raw(kStyleSheet).close().newline();
  out.close().newline();
}

void append_headlines(Markup& out, const Report& report) {
  if (report.headlines.empty()) return;
  out.open("dl", {{"class", "tiles"}});
  for (const Headline& h : report.headlines) {
    out.open("div").element("dt", {}, h.label).element("dd", {{"class", "value"}}, h.value);
    if (!h.note.empty()) out.element("dd", {{"class", "small"}}, h.note);
    out.close();
  }
  out.close().newline();
}

void append_nights(Markup& out, const Report& report) {
  if (report.nights.empty()) return;
  out.open("ol", {{"class", "nights"}, {"aria-label", "Nights"}});
  for (const NightTile& night : report.nights) {
    out.open("li", {{"class", state_class(night.state)}, {"title", night.label}}).element("span", {{"class", "hidden"}}, night.label).close();
  }
  out.close().newline();
}

void append_contents(Markup& out, const Report& report, const std::vector<std::string>& section_ids) {
  const auto entry = [&](const std::string& id, std::string_view text) {
    out.open("li").element("a", {{"href", "#" + id}}, text).close();
  };
  if (report.sections.empty() && report.verdicts.empty() && report.provenance.empty()) return;
  out.open("nav", {{"aria-label", "Contents"}}).open("ul");
  if (!report.verdicts.empty()) entry("verdicts", "Verdicts");
  for (std::size_t i = 0; i < section_ids.size(); ++i) entry(section_ids[i], report.sections[i].heading);
  if (!report.provenance.empty()) entry("provenance", "Provenance");
  out.close().close().newline();
}

void append_provenance(Markup& out, const Report& report) {
  if (report.provenance.empty()) return;
  out.open("section", {{"id", "provenance"}}).element("h2", {}, "Provenance");
  out.open("dl", {{"class", "provenance"}});
  for (const auto& [key, value] : report.provenance) out.element("dt", {}, key).element("dd", {}, value);
  out.close().close().newline();
}

/// Any script: what follows // is no markup to XML, and a comment to the script. As text/plain it waits until it is asked for.
void append_script(Markup& out, std::string_view script, Markup::Attributes attributes = {}) {
  out.open("script", attributes).raw("//<![CDATA[\n").raw(script).raw("\n//]]>").close().newline();
}

/// What made the report, for its figures: empty where the provenance does not say.
std::string program_of(const Report& report) {
  std::string program;
  for (const auto& [key, value] : report.provenance) {
    if (key == "version") program = "version " + value;
    if (key == "commit" && value != "unknown") program += (program.empty() ? "commit " : ", commit ") + value;
  }
  return program;
}

std::string render(const Report& report, Detail detail, const HtmlOptions& options) {
  const std::string program = program_of(report);
  detail.program = program;
  Anchors anchors;
  std::vector<std::string> section_ids;
  for (const Section& s : report.sections) section_ids.push_back(anchors.make("section-" + s.heading));

  Markup out;
  out.raw("<!DOCTYPE html>\n").open("html", {{"lang", "en"}}).newline();
  append_head(out, report, options.campaign);
  out.open("body").newline().open("header").element("h1", {}, report.title.empty() ? "Report" : report.title);
  append_nights(out, report);
  append_conclusion(out, report);
  append_headlines(out, report);
  for (const std::string& line : report.summary) out.element("p", {{"class", "note"}}, line);
  append_contents(out, report, section_ids);
  out.close().newline().open("main").newline();
  append_verdicts(out, report.verdicts);
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    const Section& section = report.sections[i];
    out.open("section", {{"id", section_ids[i]}}).open("h2").text(section.heading);
    append_permalink(out, section_ids[i], section.heading);
    out.close().newline();
    for (const std::string& paragraph : section.paragraphs) out.element("p", {}, paragraph).newline();
    for (const Figure& figure : section.figures)
      append_figure(out, figure, anchors.make("figure-" + figure.id), detail);
    for (const Table& table : section.tables) append_table(out, table);
    out.close().newline();
  }
  append_provenance(out, report);
  out.close().newline();
  if (detail.live_points > 0) {
    out.open("script", {{"type", "application/json"}, {"id", "palette"}}).raw(live_palette()).close().newline();
    append_script(out, options.plotly, {{"type", "text/plain"}, {"id", "plotly"}});
  }
  append_script(out, kScript);
  out.close().close().newline();
  return out.take();
}

}  // namespace

std::string render_html(const Report& report, const HtmlOptions& options) {
  constexpr Detail still[] = {{.csv_rows = 4000, .table_rows = 60, .narrow_drawings = true},
                              {.csv_rows = 800, .table_rows = 20, .narrow_drawings = true},
                              {.csv_rows = 200, .table_rows = 10, .narrow_drawings = false}};
  constexpr Detail live[] = {{.table_rows = 30, .narrow_drawings = false, .live_points = 2000},
                             {.table_rows = 25, .narrow_drawings = false, .live_points = 1000},
                             {.table_rows = 20, .narrow_drawings = false, .live_points = 500},
                             {.table_rows = 10, .narrow_drawings = false, .live_points = 150}};
  for (const std::string_view end : {"]]>", "</script", "<!--"})
    if (options.plotly.find(end) != std::string_view::npos)
      throw std::invalid_argument("the plotting library holds " + std::string(end) + ", which ends a script of a page");
  std::string html;
  for (const Detail& detail : options.plotly.empty() ? std::span<const Detail>(still) : std::span<const Detail>(live)) {
    html = render(report, detail, options);
    if (html.size() < kReportSizeLimit) break;
  }
  return html;
}

std::string marked_campaign(std::string_view page) {
  const std::string before = "name=\"" + std::string(kMark) + "\" content=\"";
  const std::size_t found = page.find(before);
  if (found == std::string_view::npos) return "";
  const std::string_view mark = page.substr(found + before.size());
  return std::string(mark.substr(0, mark.find('"')));
}

}  // namespace ddem::reports
