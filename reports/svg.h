#pragma once
// A figure as SVG.

#include <string>

#include "reports/figure.h"

namespace ddem::reports {

/// A standalone SVG file, with title, legend, description and a white background. Throws
/// std::invalid_argument for a figure that require_valid() refuses. The same figure gives the same bytes.
std::string render_svg(const Figure& figure);

struct EmbeddedSvg {
  double width = 860.0;        ///< of the view box, pixels; texts have 12 to 13
  bool side_by_side = true;    ///< false: panels below each other, for narrow screens
  std::string id_prefix = {};  ///< unique within the document
};

/// The `<svg>` element for use inside HTML, where heading and caption are the page's.
std::string render_embedded_svg(const Figure& figure, const EmbeddedSvg& options);

}  // namespace ddem::reports
