#include "harness/studies/strip/strip_campaign.h"

#include <fmt/format.h>

#include <stdexcept>

#include "harness/scene/read_scene.h"

namespace ddem::harness {
namespace {

std::string slug(Model m) {
  switch (m) {
    case Model::dem: return "dem";
    case Model::lagged_normal: return "lagged-normal";
    case Model::lagged_full: return "lagged-full";
    case Model::implicit_full: return "implicit-full";
  }
  throw std::logic_error("unknown model");
}

std::string slug(const StripCase& c) {
  return c.packing == StripPacking::hexagonal ? "hexagonal" : fmt::format("random-{}", c.seed);
}

/// Amplitude: small against a disc, so that the linear models describe the nonlinear ones (theory section 5).
constexpr double kStripAmplitude = 1e-8;

std::string material_text(const StripCampaign& s, const StripCase& c) {
  std::string t = fmt::format("[material]\ndensity = {}\n\n[contact]\nnormal_stiffness = {}\nstiffness_ratio = {}\nnew_contacts = \"off\"\n\n",
                              s.density, s.normal_stiffness, c.stiffness_ratio);
  if (c.model == Model::dem) return t;
  return t + fmt::format("[deformation]\nscheme = \"{}\"\ncorrection = \"{}\"\nyoung_modulus = {}\npoisson_ratio = {}\n\n",
                         c.model == Model::implicit_full ? "implicit" : "lagged", c.model == Model::lagged_normal ? "normal" : "full", s.particle_modulus, s.particle_poisson_ratio);
}

std::string packing_text(const StripCampaign& s, const StripCase& c, const std::string& periodic) {
  std::string t = "[assembly]\n";
  if (c.packing == StripPacking::hexagonal) {
    // The box around the discs is exactly `length` long: half-shifted rows stand out by a radius.
    t += fmt::format("packing = \"hexagonal\"\nclose_packed_along = \"x\"\ncolumns = {}\nrows = {}\nradius = {}\n",
                     s.columns, s.rows, s.length / static_cast<double>(2 * s.columns + 1));
  } else {
    t += fmt::format("packing = \"random\"\nlength = {}\nwidth = {}\ndiscs = {}\nseed = {}\ncoordination = {}\n", s.length,
                     s.width, s.discs, c.seed, s.coordination);
  }
  if (!periodic.empty()) t += fmt::format("periodic = \"{}\"\n", periodic);
  return t + "\n";
}

std::string load_text(const StripCampaign& s, const StripCase& c, double speed) {
  const char* wave = c.wave == StripWave::shear ? "shear" : "longitudinal";
  if (c.protocol == Protocol::paper) {
    return fmt::format("[initial]\nwave = \"{}\"\nshape = \"column\"\namplitude = {}\n\n", wave, kStripAmplitude);
  }
  return fmt::format("[drive]\nwave = \"{}\"\nshape = \"sin2\"\nduration = {}\namplitude = {}\n\n", wave,
                     s.pulse_length / speed, kStripAmplitude);
}

/// Of lagged strains the step is a part: what they do to waves is of first order in it.
std::string time_text(const StripCampaign& s, const StripCase& c) {
  const bool lagged = c.model == Model::lagged_normal || c.model == Model::lagged_full;
  return fmt::format("[time]\nintegrator = \"{}\"\nstep_fraction = {}\n\n", lagged ? "verlet" : "exact",
                     c.protocol == Protocol::paper ? s.step_fraction : s.long_wave_step_fraction);
}

}  // namespace

std::string name(Model model) {
  switch (model) {
    case Model::dem: return "DEM";
    case Model::lagged_normal: return "DDEM N";
    case Model::lagged_full: return "DDEM F";
    case Model::implicit_full: return "DDEM F implicit";
  }
  throw std::logic_error("unknown model");
}

std::string name(StripWave wave) { return wave == StripWave::bar ? "bar" : wave == StripWave::shear ? "shear" : "P"; }

std::string material_slug(Model model, double stiffness_ratio) {
  // Ratios that two decimals cannot tell apart must not share a name.
  const std::string two = fmt::format("{:.2f}", stiffness_ratio);
  return fmt::format("{}/kt{}", slug(model), std::stod(two) == stiffness_ratio ? two : fmt::format("{}", stiffness_ratio));
}

std::string id_of(const StripCase& c) {
  return fmt::format("{}/{}/{}/{}", c.protocol == Protocol::paper ? "paper" : "long-wave", slug(c),
                     material_slug(c.model, c.stiffness_ratio), c.wave == StripWave::p ? "p" : name(c.wave));
}

std::string scene_text(const StripCampaign& s, const StripCase& c, double speed) {
  const bool periodic = c.wave != StripWave::bar;
  // A shear wave's right end is free to move along y; only what the wave moves need be held.
  std::string t = fmt::format("title = \"{}\"\n\n", id_of(c)) + packing_text(s, c, "") + material_text(s, c);
  t += fmt::format("[boundary]\ntop_bottom = \"{}\"\nright = \"fixed_x\"\n\n", periodic ? "periodic" : "free");
  t += load_text(s, c, speed);
  t += time_text(s, c) + "[probes]\npairs = 5\n";
  if (c.protocol == Protocol::long_wave) t += "section = true\n";
  return t;
}

std::string assembly_text(const StripCampaign& s, const StripCase& c, bool cell) {
  std::string t = packing_text(s, c, cell ? "xy" : "") + material_text(s, c);
  if (!cell) t += fmt::format("[boundary]\ntop_bottom = \"{}\"\n", c.wave == StripWave::bar ? "free" : "periodic");
  return t;
}

Scene scene_of(const std::string& text, const std::string& scene_name) {
  const Purpose purpose = text.find("[probes]") == std::string::npos ? Purpose::statics : Purpose::simulation;
  const SceneResult scene = parse_scene(text, scene_name, ".", {purpose});
  if (!scene) throw std::logic_error("the campaign made a scene that the reader refuses:\n" + to_string(scene.violations));
  return *scene;
}

}  // namespace ddem::harness
