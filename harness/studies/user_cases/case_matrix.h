#pragma once
// [case.matrix]: which keys of a case's scene are varied.

#include <functional>
#include <string>
#include <vector>

#include "harness/scene/document.h"

namespace ddem::harness {

struct MatrixAxis {
  std::string key;  ///< "contact.stiffness_ratio"
  int line = 0;
  std::vector<std::string> values, names;  ///< as TOML; as a part of a case's name, no two alike
};

/// Hears of what is wrong.
using ReportProblem = std::function<void(int line, const std::string& key, const std::string& value, const std::string& message,
                                         const std::string& remedy)>;

/// "x" as a part of a name: without quotes, and '-' for what is no letter, digit, '-', '_', '.', '+' or '='.
std::string plain_name(std::string text);

/// The axes of a [[case]] that are right.
std::vector<MatrixAxis> read_matrix(const Element& element, const ReportProblem& report);

}  // namespace ddem::harness
