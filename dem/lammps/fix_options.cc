#include "dem/lammps/fix_options.h"

#include <lammps/error.h>
#include <lammps/group.h>
#include <lammps/utils.h>

#include <map>

namespace ddem::lammps {
namespace {

class Words {
 public:
  Words(LAMMPS_NS::LAMMPS* lmp, int count, char** words) : lmp_(lmp), words_(words, words + count) {}

  bool left() const { return at_ < words_.size(); }
  [[noreturn]] void refuse(const std::string& why) const { lmp_->error->all(FLERR, "fix ddem: " + why); }

  std::string text(const std::string& what) {
    if (!left()) refuse(what + " is missing at the end of the command");
    return words_[at_++];
  }

  double number(const std::string& what) { return LAMMPS_NS::utils::numeric(FLERR, text(what).c_str(), false, lmp_); }

  double positive(const std::string& what) {
    const double value = number(what);
    if (!(value > 0.0)) refuse(what + " must be above 0");
    return value;
  }

  int whole(const std::string& what) {
    const int value = LAMMPS_NS::utils::inumeric(FLERR, text(what).c_str(), false, lmp_);
    if (value < 1) refuse(what + " must be at least 1");
    return value;
  }

  int group_bit(const std::string& what) {
    const std::string name = text(what);
    const int group = lmp_->group->find(name);
    if (group < 0) refuse("there is no group " + name);
    return lmp_->group->bitmask[group];
  }

  template <class T>
  T one_of(const std::string& what, const std::map<std::string, T>& values) {
    const std::string word = text(what);
    const auto found = values.find(word);
    if (found != values.end()) return found->second;
    std::string all;
    for (const auto& [name, value] : values) all += (all.empty() ? "" : ", ") + name;
    refuse(what + " is " + word + "; there are " + all);
  }

 private:
  LAMMPS_NS::LAMMPS* lmp_;
  std::vector<std::string> words_;
  std::size_t at_ = 0;
};

void take_strain(Words& words, FixOptions& o) {
  DeformationParameters& d = o.deformation;
  d.scheme = words.one_of<Scheme>("the scheme", {{"none", Scheme::none}, {"lagged", Scheme::lagged}, {"implicit", Scheme::implicit}});
  if (d.scheme == Scheme::none) return;
  d.correction = words.one_of<Correction>("the correction", {{"normal", Correction::normal},
                                                              {"full", Correction::full},
                                                              {"normal-only-stress", Correction::normal_only_stress}});
  d.young_modulus = words.positive("Young's modulus of the discs");
  d.poisson_ratio = words.number("Poisson's ratio of the discs");
  if (!(d.poisson_ratio > -1.0 && d.poisson_ratio < 1.0)) words.refuse("Poisson's ratio must lie between -1 and 1");
}

void take_drive(Words& words, Drive& drive) {
  drive.on = true;
  drive.along_x = words.one_of<bool>("the drive's direction", {{"x", true}, {"y", false}});
  drive.group_bit = words.group_bit("the driven group");
  drive.amplitude = words.number("the drive's amplitude");
  drive.duration = words.positive("the drive's duration");
}

void take_initial(Words& words, FixOptions& o) {
  for (std::string& name : o.initial) {
    const std::string word = words.text("an initial displacement");
    if (word == "NULL") continue;
    if (word.rfind("v_", 0) != 0) words.refuse("an initial displacement is an atom-style variable, v_NAME, or NULL");
    name = word.substr(2);
  }
}

void take(Words& words, const std::string& key, FixOptions& o) {
  if (key == "hold") {
    const int which = words.one_of<int>("what is held", {{"x", 0}, {"y", 1}, {"theta", 2}});
    o.held[static_cast<std::size_t>(which)] |= words.group_bit("the held group");
  } else if (key == "drive") {
    take_drive(words, o.drive);
  } else if (key == "displacement") {
    take_initial(words, o);
  } else if (key == "integrate") {
    o.integrate = words.one_of<bool>("integrate", {{"yes", true}, {"no", false}});
  } else if (key == "strain") {
    take_strain(words, o);
  } else if (key == "plane") {
    o.deformation.plane = words.one_of<Plane>("the plane", {{"stress", Plane::stress}, {"strain", Plane::strain}});
  } else if (key == "thickness") {
    o.thickness = words.positive("the thickness");
  } else if (key == "volume") {
    o.volume_over_disc = words.positive("the volume over that of the disc");
  } else if (key == "evaluations") {
    o.deformation.evaluations = words.whole("the number of evaluations");
  } else if (key == "relaxation") {
    o.deformation.relaxation = words.positive("the relaxation");
  } else if (key == "weights") {
    o.weights.resize(static_cast<std::size_t>(words.whole("the number of weights")));
    for (double& w : o.weights) w = words.number("a weight");
  } else {
    words.refuse("there is no keyword " + key + "; there are hold, drive, displacement, integrate, strain, plane, thickness, volume, "
                 "evaluations, relaxation, weights");
  }
}

}  // namespace

FixOptions fix_options(LAMMPS_NS::LAMMPS* lmp, int count, char** words_of_command) {
  Words words(lmp, count, words_of_command);
  FixOptions o;
  while (words.left()) take(words, words.text("a keyword"), o);
  const DeformationParameters& d = o.deformation;
  if (d.scheme == Scheme::implicit && o.weights.empty())
    words.refuse("implicit strains need weights, those of the passes of their polynomial (ddem export finds them)");
  if (d.scheme != Scheme::implicit && !o.weights.empty()) words.refuse("weights belong to implicit strains");
  if (d.scheme != Scheme::lagged && (d.evaluations != 1 || d.relaxation != 1.0)) words.refuse("evaluations and relaxation belong to lagged strains");
  if (d.plane == Plane::strain && d.poisson_ratio >= 0.5) words.refuse("in plane strain Poisson's ratio must be below 0.5");
  return o;
}

}  // namespace ddem::lammps
