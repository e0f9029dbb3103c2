#pragma once
// Assemblies and static references of a campaign, each built once, when it is first asked for, by whichever
// thread.

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "dem/statics/moduli.h"
#include "harness/studies/statics/statics_data.h"
#include "harness/campaign/run_options.h"

namespace ddem::harness {

/// Values by name, each made once: another thread that asks for it meanwhile waits. A value whose making
/// throws is not kept.
template <class Value>
class OnceEach {
 public:
  template <class Make>
  const Value& get(const std::string& name, const Make& make) {
    Slot* slot = nullptr;
    {
      const std::lock_guard lock(mutex_);
      auto& found = slots_[name];
      if (!found) found = std::make_unique<Slot>();
      slot = found.get();
    }
    std::call_once(slot->once, [&] { slot->value = std::make_unique<const Value>(make()); });
    return *slot->value;
  }

 private:
  struct Slot {
    std::once_flag once;
    std::unique_ptr<const Value> value;
  };
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<Slot>> slots_;
};

class StripStatics {
 public:
  StripStatics(const StripCampaign& campaign, const CampaignOptions& options)
      : campaign_(campaign), options_(options) {}

  /// A material whose equilibrium is another's (continuum_model()) is solved as that one. Never throws: see
  /// StaticOutcome::failure.
  StaticOutcome of(const StripMaterial& material);
  /// The strip between free edges (bar) or periodic ones. Throws like build_assembly().
  const ddem::Assembly& strip(StripPacking packing, std::int64_t seed, bool periodic);
  /// Of implicit strains in that strip, see SimulationInput::relaxations; of other models none.
  std::vector<double> relaxations(const StripMaterial& material, bool periodic);

 private:
  StaticOutcome solve(const StripMaterial& material);
  void solve_cell(StaticOutcome& lattice);
  /// Of the closed strip and rigid discs, whatever the model: the free one lacks some of its bonds, so that its own is longer.
  double critical_time_step_of(const StripMaterial& material);
  Speeds section_speeds_of(const StripMaterial& material, const GrippedStrip& free, const GrippedStrip& closed);

  StripCampaign campaign_;
  CampaignOptions options_;
  OnceEach<ddem::Assembly> strips_;
  OnceEach<StaticOutcome> solved_;
  OnceEach<std::vector<double>> relaxations_;
  OnceEach<double> critical_time_steps_;
};

}  // namespace ddem::harness
