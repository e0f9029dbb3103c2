#pragma once
// Numbers of one column of a table, so that the eye can compare them.

#include <span>
#include <string>

namespace ddem::reports {

/// The same decimals for all: two at most where these say all, else those that the largest needs for `digits` significant ones, without zeros that end all of them. Where
/// the largest is very large or small, or the smallest would be left with less than two digits, all as "1.20×10⁻⁵".
class ColumnFormat {
 public:
  ColumnFormat(std::span<const double> values, int digits);
  /// An en dash if the value is not finite.
  std::string text(double value) const;

 private:
  int decimals_ = 0;
  bool scientific_ = false;
};

}  // namespace ddem::reports
