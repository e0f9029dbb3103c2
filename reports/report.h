#pragma once
// A report, as plain data, and its rendering to one self-contained HTML file.

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/figure.h"
#include "reports/svg.h"
#include "reports/table.h"
#include "reports/verdict.h"

namespace ddem::reports {

/// A number that the reader should take home, written out by whoever computed it: {"ν reached by DDEM",
/// "0.479"}.
struct Headline {
  std::string label = {};
  std::string value = {};
  std::string note = {};  ///< small print, e.g. the reference beside it
};

/// A night of a history: a tile coloured by its worst state.
struct NightTile {
  std::string label = {};
  State state = State::error;
};

struct Section {
  std::string heading = {};
  std::vector<std::string> paragraphs = {};
  std::vector<Figure> figures = {};
  std::vector<Table> tables = {};
};

struct Report {
  std::string title = {};
  std::vector<std::string> findings = {};  ///< what was found, a sentence each, in words made from the numbers
  std::vector<std::string> summary = {};   ///< paragraphs: of what the report is
  std::vector<Headline> headlines = {};
  std::vector<NightTile> nights = {};  ///< in their order
  std::vector<Verdict> verdicts = {};  ///< in any order
  std::vector<Section> sections = {};
  std::vector<std::pair<std::string, std::string>> provenance =
      {};  ///< version, compiler, machine, seeds, ...
};

constexpr std::size_t kReportSizeLimit = 5'000'000;  ///< bytes

struct HtmlOptions {
  /// Text of plotly's cartesian bundle, which goes into the page once and makes its figures interactive. Empty: they are SVG.
  std::string_view plotly = {};
  /// Which campaign the report is of, for programs: in the page's head.
  std::string_view campaign = {};
};

/// One HTML5 file (well-formed as XML too) that needs no network. The same report gives the same bytes. Interactive figures
/// have their SVG for browsers without scripts and for paper. If the file would exceed kReportSizeLimit, the data behind the
/// figures are thinned (extremes survive; the page says so), and then the drawings for narrow screens are left out. Throws
/// std::invalid_argument for figures that require_valid() refuses, for table rows longer than their header, naming them, and for a
/// library that cannot stand inside a page. A report that is too large even so (thousands of verdicts) is returned as it is.
std::string render_html(const Report& report, const HtmlOptions& options = {});

/// HtmlOptions::campaign of a page, from its beginning; empty where there is none.
std::string marked_campaign(std::string_view page);

}  // namespace ddem::reports
