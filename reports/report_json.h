#pragma once
// A report or figure as JSON and back, so that it can be kept and drawn again. Arrays go wherever the caller
// puts them: into the document itself, or into the datasets of a file.
//
//   const Json document = to_json(report, [&](const std::vector<double>& values) { return store.add(values);
//   }); const Report same = report_from_json(document, [&](const Json& place) { return store.get(place); });

#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "reports/report.h"

namespace ddem::reports {

/// Objects keep the order of their keys.
using Json = nlohmann::ordered_json;

/// Puts an array of numbers, some of them perhaps not finite, somewhere; returns what stands for it in the
/// document.
using PutArray = std::function<Json(const std::vector<double>&)>;
/// The array that the document names.
using GetArray = std::function<std::vector<double>(const Json&)>;

/// What is empty has no key; a single number that is not finite is null. Rendering what report_from_json()
/// makes of it gives the bytes that the report itself gives.
Json to_json(const Report& report, const PutArray& put);
Json to_json(const Figure& figure, const PutArray& put);

/// Throws std::invalid_argument where the document is not what to_json() writes, naming the key, and passes
/// on what `get` throws.
Report report_from_json(const Json& document, const GetArray& get);

}  // namespace ddem::reports
