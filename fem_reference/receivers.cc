#include "fem_reference/receivers.h"

namespace ddem::fem {
namespace {

void evaluate(const NodeWeights& weights, std::span<const double> u, std::vector<double>& out) {
  double ux = 0.0, uy = 0.0;
  for (const auto& [node, weight] : weights) {
    ux += weight * u[2 * node];
    uy += weight * u[2 * node + 1];
  }
  out.push_back(ux);
  out.push_back(uy);
}

}  // namespace

void evaluate_receivers(const StripModel& model, std::span<const double> u, std::vector<double>& out) {
  for (const NodeWeights& weights : model.points) evaluate(weights, u, out);
  for (const NodeWeights& weights : model.sections) evaluate(weights, u, out);
}

}  // namespace ddem::fem
