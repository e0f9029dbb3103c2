#pragma once
// Which colour, dash and marker each named series of a figure has, the same in all its panels, and the legend
// that says so, above the panels, where it covers no data.

#include <string>
#include <string_view>
#include <vector>

#include "reports/figure.h"
#include "reports/geometry.h"
#include "reports/markup.h"

namespace ddem::reports {

enum class MarkerShape { circle, square, triangle, diamond };

struct Style {
  std::string name = {};
  Color color = Color::automatic;
  Dash dash = Dash::solid;
  MarkerShape marker = MarkerShape::circle;
  bool has_line = false, has_marker = false, has_band = false;
};

class StyleBook {
 public:
  explicit StyleBook(const Figure& figure);
  const Style& of(const Series& series) const { return find(series.name, series.color); }
  const Style& of(const Band& band) const { return find(band.name, band.color); }
  /// Place in styles().
  std::size_t index_of(const Series& series) const { return static_cast<std::size_t>(&of(series) - styles_.data()); }
  std::size_t index_of(const Band& band) const { return static_cast<std::size_t>(&of(band) - styles_.data()); }
  /// Colour of the series that a pick belongs to; that of text if there is none.
  std::string_view color_of(const Pick& pick) const;
  const std::vector<Style>& styles() const { return styles_; }

 private:
  Style& entry(const std::string& name, Color color);
  const Style& find(const std::string& name, Color color) const;

  struct Key {
    std::string name;
    Color asked;
  };
  std::vector<Key> keys_;
  std::vector<Style> styles_;
  std::size_t automatic_ = 0;
};

/// stroke-dasharray
std::string_view dash_array(Dash dash);

void draw_marker(Markup& out, MarkerShape shape, Point at, double size);

/// Draws the legend from (left, top) over `width` pixels, as many rows as it needs; returns its height. With
/// `out` null it only measures.
double draw_legend(Markup* out, const StyleBook& styles, Point corner, double width);

}  // namespace ddem::reports
