#include "fem_reference/receivers.h"

#include <algorithm>

namespace ddem::fem {
namespace {

void evaluate_one(const NodeWeights& weights, std::span<const double> u, double* value) {
  double ux = 0.0, uy = 0.0;
  for (const auto& [node, weight] : weights) {
    ux += weight * u[2 * node];
    uy += weight * u[2 * node + 1];
  }
  value[0] = ux;
  value[1] = uy;
}

}  // namespace

ReceiverReader::ReceiverReader(const StripModel& model, const ElasticOperator& stiffness) {
  for (const NodeWeights& weights : model.points) receivers_.push_back(&weights);
  for (const NodeWeights& weights : model.sections) receivers_.push_back(&weights);
  const Team& team = stiffness.team();
  const auto threads = static_cast<std::size_t>(team.size());
  shares_.resize(threads + 1);
  for (std::size_t r = 0; r < receivers_.size(); ++r) {
    const NodeWeights& nodes = *receivers_[r];
    const bool at_edge = std::any_of(nodes.begin(), nodes.end(), [&](const auto& entry) {
      return std::binary_search(model.left_nodes.begin(), model.left_nodes.end(), entry.first);
    });
    std::size_t owner = threads;
    for (std::size_t thread = 0; thread < threads && !at_edge; ++thread) {
      const auto [first, last] = team.part(stiffness.vector_size(), static_cast<int>(thread));
      const bool own = std::all_of(nodes.begin(), nodes.end(), [&, first = first, last = last](const auto& entry) {
        return 2 * entry.first >= first && 2 * entry.first + 1 < last;
      });
      if (own) owner = std::min(owner, thread);
    }
    shares_[owner].push_back(r);
  }
}

void ReceiverReader::evaluate(std::span<const double> u, double* row) const {
  for (const auto& share : shares_) evaluate(share, u, row);
}

void ReceiverReader::evaluate(const std::vector<std::size_t>& which, std::span<const double> u, double* row) const {
  for (const std::size_t r : which) evaluate_one(*receivers_[r], u, row + 2 * r);
}

}  // namespace ddem::fem
