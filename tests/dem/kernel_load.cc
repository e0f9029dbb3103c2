// kernel_load LAW: a fixed load, in a function of its own, for a program that counts instructions (costs_test.cc). Writes the
// bond-steps done, or the steps of the march.
//
// dem, dem_shear, dem_shear_per_bond, lagged, lagged_shear, implicit, implicit_shear: 200 steps of the kernels on a lattice of
// 682 discs, all moving; with _random, on the random strip of as many, and new contacts are watched for.
// wave: a released column in the random strip of 682 discs, exact in time at ten discs for 7 us, every fifth of a step.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "dem/simulation/exact.h"
#include "dem/simulation/stepper.h"
#include "dem/spectra/spectra.h"
#include "tests/support/wave_strip.h"

namespace {

using namespace ddem;

constexpr long kSteps = 200;

extern "C" [[gnu::noinline]] void counted_steps(Stepper& stepper) {
  for (long done = 0; done < kSteps; done += stepper.finish_stage() ? 1 : 0) stepper.advance(0);
}

extern "C" [[gnu::noinline]] long counted_wave(const Assembly& a, const SimulationInput& in, const Sampling& sampling) {
  return simulate_exact(a, in, sampling).steps_done;
}

void kernels(const ContactParameters& contact, const DeformationParameters& deformation, bool random) {
  const Assembly a = random ? test::random_free_strip() : test::hexagonal_assembly({.columns = 62, .rows = 11, .radius = 1.3e-4});
  SimulationInput in;
  if (random && deformation.active()) in.new_contacts = ContactWatch::bound;
  in.contact = contact;
  in.deformation = deformation;
  in.initial.ux = test::Noise(1).vector(a.size(), 1e-9);
  in.initial.uy = test::Noise(2).vector(a.size(), 1e-9);
  in.time_step = 0.3 * 2.0 / std::sqrt(6.0) * std::sqrt(*std::min_element(a.mass.begin(), a.mass.end()) / test::kNormalStiffness);
  Stepper stepper(a, in, best_instruction_set());
  counted_steps(stepper);
  std::cout << static_cast<double>(a.bonds.size()) * static_cast<double>(kSteps) << "\n";
}

void wave() {
  const test::WaveStrip strip(0.25);
  std::cout << counted_wave(strip.assembly, strip.input, strip.sampling) << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  const std::string load = argc == 2 ? argv[1] : "", suffix = "_random";
  const bool random = load.ends_with(suffix);
  const std::string law = random ? load.substr(0, load.size() - suffix.size()) : load;
  const double k_n = test::kNormalStiffness;
  const DeformationParameters soft{Scheme::implicit, Correction::full, 4.0 * k_n, 0.3, Plane::stress};
  DeformationParameters lagged = soft;
  lagged.scheme = Scheme::lagged;
  const std::map<std::string, std::pair<ContactParameters, DeformationParameters>> laws{
      {"dem", {{k_n, 0.0}, {}}},
      {"dem_shear", {{k_n, 0.5}, {}}},
      {"dem_shear_per_bond", {{k_n, 0.5, Kinematics::linear, k_n}, {}}},
      {"lagged", {{k_n, 0.0}, lagged}},
      {"lagged_shear", {{k_n, 0.5}, lagged}},
      {"implicit", {{k_n, 0.0}, soft}},
      {"implicit_shear", {{k_n, 0.5}, soft}}};
  if (law == "wave") {
    wave();
  } else if (const auto found = laws.find(law); found != laws.end()) {
    kernels(found->second.first, found->second.second, random);
  } else {
    std::cerr << "kernel_load dem|dem_shear|dem_shear_per_bond|lagged|lagged_shear|implicit|implicit_shear, or with _random; wave\n";
    return 2;
  }
  return 0;
}
