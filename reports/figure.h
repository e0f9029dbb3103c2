#pragma once
// What a figure shows, as plain data. Nothing here knows how it is drawn: an SVG, a plotly or a text renderer
// reads the same model. Fill it with designated initialisers:
//
//   Figure{.id = "nu", .title = "Poisson's ratio", .caption = "DDEM stays above DEM.",
//          .panels = {Plot{.x = {.label = "k_t/k_n"}, .y = {.label = "nu"},
//                          .series = {{.name = "DEM", .x = ratio, .y = nu}}}}};
//
// Data are in SI units; renderers choose prefixes (1e-6 m is shown as um). A value that is not finite, or not
// positive on a logarithmic axis, is a gap, and the reader is told how many there are.

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ddem::reports {

enum class Scale { linear, log };
enum class SeriesKind { line, markers, line_markers };
enum class Dash { solid, dashed, dotted };
enum class Direction { horizontal, vertical };
/// Okabe and Ito's colours, which colour-blind readers can tell apart, and a grey for references.
enum class Color { automatic, blue, vermilion, green, orange, purple, sky, black, yellow, grey };

struct Limits {
  double lower = 0.0;
  double upper = 1.0;
};

struct Axis {
  std::string label = {};
  std::string unit = {};  ///< SI unit of the data ("m", "m/s"); empty: dimensionless
  Scale scale = Scale::linear;
  std::optional<Limits> limits = {};  ///< left out: all data are in view; what is outside is not drawn
};

/// Series, bands and picks with the same name belong together: one colour and one legend entry in all panels.
struct Series {
  std::string name = {};  ///< legend entry; empty: none
  SeriesKind kind = SeriesKind::line;
  std::vector<double> x = {};
  std::vector<double> y = {};
  std::vector<double> error = {};  ///< half-length of the error bar of each y; empty: none
  Color color = Color::automatic;
  Dash dash = Dash::solid;
};

/// The region between two curves, e.g. mean -+ standard deviation over seeds.
struct Band {
  std::string name = {};
  std::vector<double> x = {};
  std::vector<double> lower = {};
  std::vector<double> upper = {};
  Color color = Color::automatic;
};

/// A line across the panel at y = value (horizontal) or x = value (vertical).
struct ReferenceLine {
  Direction direction = Direction::horizontal;
  double value = 0.0;
  std::string label = {};
  Dash dash = Dash::dashed;
};

/// Where a picker found something in a signal: a vertical line, and a ring at y if there is one.
struct Pick {
  double x = 0.0;
  std::optional<double> y = {};
  std::string label = {};
  std::string series = {};  ///< name of the series whose colour it takes
};

/// From values to colours. log: decades from the lower to the upper limit. signed_log: blue below, white at, red above zero,
/// by decades of the magnitude between the limits; what is smaller is white.
enum class ColorScale { linear, log, signed_log };

/// Values over a grid of cells, which fill the panel behind its series.
struct HeatMap {
  std::vector<double> x = {};      ///< centres of the columns, ascending; a cell ends halfway between (on the axis's scale)
  std::vector<double> y = {};      ///< centres of the rows, ascending
  std::vector<double> value = {};  ///< value[row * columns + column]; not finite (log: not positive): a grey cell
  Axis value_axis = {};            ///< label and unit of the colour bar; limits are needed, and positive unless linear
  ColorScale scale = ColorScale::linear;
};

struct Plot {
  std::string title = {};  ///< of this panel; empty: none
  Axis x = {};
  Axis y = {};
  std::optional<HeatMap> map = {};
  std::vector<Series> series = {};
  std::vector<Band> bands = {};
  std::vector<ReferenceLine> references = {};
  std::vector<Pick> picks = {};
};

struct Probe {
  double x = 0.0;  ///< m
  double y = 0.0;  ///< m
  std::string label = {};
};

/// A value of every disc at every time of a strip's frames.
struct StripField {
  Axis axis = {};                   ///< label, unit and limits of the colours; limits are needed
  std::vector<double> values = {};  ///< values[frame * discs + disc]
};

/// The assembly itself, to equal aspect ratio: discs coloured by a value, probes ringed and labelled.
struct Strip {
  std::string title = {};
  std::vector<double> x = {};       ///< centres, m
  std::vector<double> y = {};       ///< centres, m
  std::vector<double> radius = {};  ///< m
  std::vector<double> value = {};   ///< one a disc; empty: geometry only
  Axis value_axis = {};             ///< label, unit and limits of the colour bar (always linear)
  std::vector<Probe> probes = {};
  std::vector<double> times = {};        ///< of the frames of `fields`, s; empty: a still picture
  std::vector<StripField> fields = {};   ///< what a renderer that can move shows instead of `value`
};

using Panel = std::variant<Plot, Strip>;

struct Figure {
  std::string id = {};  ///< anchor and file name: letters, digits, hyphens; anything else is replaced
  std::string title = {};
  std::string made_by = {};  ///< the command that makes it again
  std::string caption = {};  ///< says what to see
  std::vector<Panel> panels = {};
  std::size_t columns = 0;  ///< plots side by side where there is room; 0: one for a single plot, else two
};

/// Throws std::invalid_argument, naming figure and series, if lengths differ within a series, a radius is not
/// positive and finite, a disc's or probe's position or a frame's time is not finite, a heat map's centres do not ascend, or
/// limits are empty or not drawable.
void require_valid(const Figure& figure);

}  // namespace ddem::reports
