#include "harness/solvers/reduced.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "harness/io/errors.h"

namespace ddem::harness {

double ReducedUnits::time() const { return std::sqrt(mass / stiffness); }

ReducedUnits reduced_units(const Exchange& e, const std::vector<double>& k_n) {
  const ddem::Assembly& a = e.assembly;
  return {2.0 * mean_radius(a.packing), std::accumulate(a.mass.begin(), a.mass.end(), 0.0) / static_cast<double>(a.size()),
          k_n.empty() ? 1.0 : *std::ranges::max_element(k_n)};
}

std::vector<int> recorded_discs(const SimulationInput& in) {
  std::set<int> discs;
  for (const Receiver& r : in.receivers) discs.insert(r.discs.begin(), r.discs.end());
  return {discs.begin(), discs.end()};
}

SampleMaker::SampleMaker(const SimulationInput& input) : input_(input) {
  signals_.ux.resize(input.receivers.size());
  signals_.uy = signals_.theta = signals_.ux;
}

void SampleMaker::add(const std::vector<double>& ux, const std::vector<double>& uy, const std::vector<double>& theta) {
  const auto n = static_cast<long>(signals_.time.size());
  signals_.time.push_back(static_cast<double>(n * input_.sample_every) * input_.time_step);
  for (std::size_t r = 0; r < input_.receivers.size(); ++r) {
    const std::vector<int>& discs = input_.receivers[r].discs;
    const auto mean = [&](const std::vector<double>& of) {
      double sum = 0.0;
      for (const int d : discs) sum += of[static_cast<std::size_t>(d)];
      if (!std::isfinite(sum)) throw NonFiniteSignal(fmt::format("its motion is not finite at sample {}", n));
      return sum / static_cast<double>(discs.size());
    };
    signals_.ux[r].push_back(mean(ux)), signals_.uy[r].push_back(mean(uy)), signals_.theta[r].push_back(mean(theta));
  }
}

Signals SampleMaker::take() {
  if (static_cast<long>(signals_.time.size()) != sample_count(input_))
    throw InputError(fmt::format("it left {} samples, not {}", signals_.time.size(), sample_count(input_)));
  return std::move(signals_);
}

}  // namespace ddem::harness
