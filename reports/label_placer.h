#pragma once
// Puts labels where they cover as little of the drawing, and of each other, as possible.

#include <vector>

#include "reports/geometry.h"

namespace ddem::reports {

class LabelPlacer {
 public:
  /// The drawing that labels should stay off.
  void add_obstacle(const Polyline& line) { obstacles_.push_back(line); }
  void reserve(const Rect& taken) { taken_.push_back(taken); }
  /// The best of the candidates (the first of equals), which is reserved then; needs at least one.
  Rect place(const std::vector<Rect>& candidates);

 private:
  double cost(const Rect& r) const;

  std::vector<Polyline> obstacles_;
  std::vector<Rect> taken_;
};

}  // namespace ddem::reports
