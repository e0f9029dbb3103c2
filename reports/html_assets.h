#pragma once
// Style sheet and script of the report: report.css; report.js, film.js and figures.js, as text of the program.

#include <string_view>

namespace ddem::reports {

extern const std::string_view kStyleSheet;
extern const std::string_view kScript;

}  // namespace ddem::reports
