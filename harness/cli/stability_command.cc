// ddem stability SCENE.toml
#include <fmt/format.h>

#include <charconv>
#include <memory>

#include "harness/cli/commands.h"
#include "harness/cli/print_json.h"
#include "harness/cli/scene_argument.h"
#include "harness/io/errors.h"
#include "harness/run/run_json.h"
#include "harness/scene/units.h"

namespace ddem::harness {
namespace {

struct StabilityOptions {
  std::string scene;
  std::vector<std::string> wavelengths;
  bool json = false;
};

std::vector<double> lengths_of(const std::vector<std::string>& texts) {
  std::vector<double> values;
  for (const std::string& text : texts) {
    double metres = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, metres);
    const bool is_plain = stop == end && error != std::errc::invalid_argument;
    const Quantity q = is_plain ? Quantity{metres, ""} : parse_quantity(text, Dimension::length);
    std::string problem = q.si ? magnitude_problem(*q.si, Dimension::length) : q.problem;
    if (is_plain && error != std::errc{}) problem = "beyond what a number can be";
    if (!problem.empty()) throw InputError(fmt::format("--wavelength {}: {}; write {}", text, problem, quantity_examples(Dimension::length)));
    values.push_back(*q.si);
  }
  return values;
}

void print_row(const char* what, const std::string& value, const std::string& meaning) {
  fmt::print("{:<30} {:<13} {}\n", what, value, meaning);
}

std::string number(double value) { return fmt::format("{:.5g}", value); }

void print_steps(const SceneStability& s) {
  print_row("critical step of rigid discs", format_quantity(s.dem_critical_step, "s", 5), "2/omega_max of the bonded discs (Lanczos)");
  const auto critical = [&](const std::string& why) {
    print_row("critical step of the scheme", s.critical.step ? format_quantity(*s.critical.step, "s", 5) : "none",
              s.critical.step ? fmt::format("{:.4g} of that: {}", *s.critical.step / s.dem_critical_step, why) : why);
  };
  switch (s.critical.bound) {
    case StepBound::oscillation:
      critical(s.deformation.active() ? "2/omega_max with converged strains, which soften the bonds" : "the same: plain DEM");
      break;
    case StepBound::flip: critical("above it the strains of successive steps alternate in sign and grow"); break;
    case StepBound::fixed_point: critical("the strains do not settle at any step: stiffen the discs, or use scheme = \"implicit\""); break;
    case StepBound::feeding: critical("an even number of evaluations overshoots in some strains, and may add energy: an odd one never does"); break;
  }
}

void print_softness(const SceneStability& s) {
  if (!s.fixed_point_radius) return;
  const bool lagged = s.deformation.scheme == Scheme::lagged;
  print_row("spectral radius of K B", number(*s.fixed_point_radius),
            lagged ? fmt::format("how much of a strain's error the next evaluation keeps; must stay below {:.4g}", s.radius_limit)
                   : "how strongly strains answer strains; sets the number of iterations, but no limit");
  print_row("k_n/E_p", number(s.softness), "softness of the discs");
  if (!lagged) return;
  print_row("largest stable k_n/E_p", number(*s.softness_limit), "at vanishing steps: the fixed point's limit");
  const auto& limit = s.softness_limit_at_step;
  if (limit && limit->at_most > limit->at_least) {
    print_row("   at this step, at least", number(limit->at_least), "below it no strain is overshot by the even number of evaluations");
    print_row("   at this step, at most", number(limit->at_most), "beyond it strains alternate and grow");
  } else {
    print_row("   at this step", limit ? number(limit->at_least) : "none", limit ? "a smaller step allows up to the number above" : "lower the step first");
  }
}

void print_flutter(const SceneStability& s) {
  if (s.has_energy()) return;
  fmt::print("The normal-only correction with shear stiffness is the derivative of no energy: vibrations may grow by themselves.\n");
  if (s.flutter && s.flutter->frequency) {
    print_row("flutter", fmt::format("{:.3g} omega_max", s.flutter->frequency->imag() / s.flutter->largest_frequency),
              fmt::format("growth rate of the fastest vibration with converged strains, at {:.4g} rad/s; {}", s.flutter->frequency->real(),
                          s.deformation.scheme == Scheme::lagged ? "the lag's damping may hide it" : "at any step"));
  } else if (s.flutter) {
    print_row("flutter", "none found", fmt::format("down to growth rates of {:.2g} omega_max", s.flutter->detectable));
  } else if (s.noise_flutter) {
    const NoiseFlutter& f = *s.noise_flutter;
    print_row("flutter", f.found ? fmt::format("{:.3g} omega_max", f.growth_rate / f.largest_frequency) : "none found",
              f.found ? "growth rate of noise with converged strains" : fmt::format("from noise with converged strains, down to growth rates of {:.2g} omega_max", f.detectable));
  } else {
    print_row("flutter", "not sought", "the hexagonal lattice has none");
  }
}

void print_growth(const SceneStability& s) {
  if (s.step_growth) print_row("growth a step", fmt::format("{:+.3g}", *s.step_growth), "largest |z| - 1 of the eigenvalues of the very step");
  if (s.noise) {
    print_row("noise in a run", s.noise->diverged ? "diverged" : fmt::format("{:+.3g}", s.noise->growth),
              fmt::format("growth a step after {} steps (below {:.2g} is none)", s.noise->steps, s.noise->resolution));
  }
}

void print_waves(const SceneStability& s) {
  if (s.lattice) {
    const WorstWave& worst = s.lattice->worst;
    print_row("infinite lattice", fmt::format("{:+.3g}", worst.growth),
              fmt::format("largest |z| - 1 of all plane waves, at k = ({:.4g}, {:.4g}) 1/m", worst.wave.x, worst.wave.y));
  }
  if (!s.no_waves.empty()) fmt::print("\nNo prediction for waves: {}\n", s.no_waves);
  if (s.waves.empty()) return;
  fmt::print("\nWaves along x at this step ({}):\n", s.waves.front().exact ? "exact Bloch waves of the infinite lattice"
                                                                           : "long waves, from static moduli, first order in the lag");
  fmt::print("{:>14} {:>9} {:>14} {:>12} {:>14} {:>14}\n", "wavelength", "wave", "omega (rad/s)", "speed (m/s)", "|z|-1 a step", "a period");
  for (const WaveGrowth& w : s.waves) {
    fmt::print("{:>14} {:>9} {:>14.5g} {:>12.5g} {:>+14.3e} {:>+13.3f}%\n", format_quantity(w.wavelength, "m", 5), w.wave, w.frequency, w.phase_speed(), w.growth,
               100.0 * w.growth_per_period(s.time_step));
  }
  if (s.deformation.scheme == Scheme::lagged) {
    fmt::print("The lag acts as a viscosity of first order in the step: half the step, half the loss a period.\n");
  }
}

void print_verdict(const SceneStability& s) {
  fmt::print("\nAt its step of {}, {:.4g} of the critical step of rigid discs, the scene is ", format_quantity(s.time_step, "s", 5),
             s.time_step / s.dem_critical_step);
  switch (s.verdict()) {
    case StabilityVerdict::stable: fmt::print("stable.\n"); break;
    case StabilityVerdict::unstable:
      fmt::print("UNSTABLE:\n");
      for (const std::string& why : s.instabilities()) fmt::print("  {}\n", why);
      break;
    case StabilityVerdict::undecided:
      fmt::print("UNDECIDED:\n  it is too large for the eigenvalues of its step, and noise in a run of {} steps cannot show growth below {:.2g} a step.\n"
                 "  Growth of {:.2g} a step would show in {:.2g} steps.\n",
                 s.noise->steps, s.noise->detectable, s.slowest_growth, s.steps_needed());
  }
}

int stability(const StabilityOptions& o) {
  const SceneStability s = scene_stability(load_scene(o.scene, Purpose::statics), lengths_of(o.wavelengths));
  if (o.json) {
    print_json(stability_json(s));
    return static_cast<int>(ExitCode::done);
  }
  fmt::print("{} discs, {} bonds\n", s.discs, s.bonds);
  print_steps(s);
  print_softness(s);
  print_flutter(s);
  print_growth(s);
  print_waves(s);
  print_verdict(s);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_stability_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<StabilityOptions>();
  CLI::App* command = app.add_subcommand("stability", "Critical time step, stability limits and numerical damping of a scene");
  command->footer("Computed from the very assembly and scheme, without running it. Waves of other lengths:\n"
                  "ddem stability shear.toml --wavelength \"4 mm\" --wavelength \"2 mm\"");
  command->add_option("SCENE", o->scene, "scene file (TOML); needs no load")->required();
  command->add_option("--wavelength", o->wavelengths, "predict the damping or growth of waves of this length (m, or with a unit)")
      ->allow_extra_args(false);
  command->add_flag("--json", o->json, "print the result as JSON");
  command->callback([o, &action] { action = [o] { return stability(*o); }; });
}

}  // namespace ddem::harness
