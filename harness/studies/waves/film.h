#pragma once
// The strip over time, for looking at: the column release (bar) in the first random packing, with every model
// of the campaign.

#include <string>
#include <vector>

#include "dem/simulation/simulation.h"
#include "harness/solvers/solver.h"
#include "harness/studies/strip/strip_campaign.h"
#include "reports/figure.h"

namespace ddem::harness {

struct FilmedRun {
  Model model = Model::dem;
  ddem::Packing packing;
  std::vector<ddem::Snapshot> frames;  ///< of the first model and the last one; of the others none
  std::vector<ddem::EnergySample> energy;
};

struct StripFilm {
  std::string failure;           ///< empty: ok
  double stiffness_ratio = 0.0;  ///< k_t/k_n
  std::vector<FilmedRun> runs;   ///< one a model
  std::vector<reports::Probe> probes;
};

DDEM_MEMBERS(FilmedRun, model, packing, frames, energy)
DDEM_MEMBERS(StripFilm, failure, stiffness_ratio, runs, probes)

/// Throws std::runtime_error where members that belong together do not fit: a result of another program.
void require_whole(const StripFilm& found);

/// All runs last as long as that of the last model. A run of a model that diverges is left out, and `failure` says so.
StripFilm film_strip(const StripCampaign& campaign, const Solver& solver = builtin_solver());

/// Displacement, stress and strain of the discs over time; the picture on paper is the frame half-way.
reports::Figure film_figure(const StripFilm& film);

/// Kinetic, contact and particle energy over time, a panel a model.
reports::Figure energy_figure(const StripFilm& film);

}  // namespace ddem::harness
