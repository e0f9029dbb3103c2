#pragma once
// Pieces of a study from functions that return plain data. For .cc files of studies only: it is long to compile.

#include <string>
#include <utility>
#include <vector>

#include "harness/campaign/study.h"
#include "harness/io/data_json.h"

namespace ddem::harness {

/// A file may say of its result that it is another unit's.
inline void require_same(bool same) {
  if (!same) throw std::runtime_error("it is another unit's");
}

/// `run` returns the result, `take` is given it, after require_whole(result) where there is one.
template <class Run, class Take, class Miss>
Piece piece(std::string id, std::string inputs, std::size_t work, Run run, Take take, Miss miss) {
  using Result = std::invoke_result_t<Run>;
  return {{std::move(id), std::move(inputs), work, [run] { return nlohmann::json(run()); }},
          [take](const nlohmann::json& j) {
            Result found = j.get<Result>();
            if constexpr (requires { require_whole(found); }) require_whole(found);
            take(std::move(found));
          },
          std::move(miss)};
}

/// The result takes the place of what was planned, which must outlive the piece and have a member `failure`; is_planned(planned,
/// result) says whether it is its own.
template <class Result, class Run, class IsPlanned>
Piece piece_at(Result& place, std::string id, std::string inputs, std::size_t work, Run run, IsPlanned is_planned) {
  return piece(
      std::move(id), std::move(inputs), work, std::move(run),
      [&place, is_planned](Result&& found) {
        require_same(is_planned(place, found));
        place = std::move(found);
      },
      [&place](const std::string& reason) { place.failure = reason; });
}

/// Of a result that is there or not: nothing is judged by its absence but what says so.
template <class Result, class Run>
Piece piece_at(std::optional<Result>& place, std::string id, std::string inputs, std::size_t work, Run run) {
  return piece(
      std::move(id), std::move(inputs), work, std::move(run), [&place](Result&& found) { place = std::move(found); },
      [&place](const std::string&) { place.reset(); });
}

}  // namespace ddem::harness
