#include "harness/run/laboratory.h"

namespace ddem::harness {

std::string_view name(LaboratoryWave wave) {
  switch (wave) {
    case LaboratoryWave::p:
      return "p";
    case LaboratoryWave::shear:
      return "shear";
    case LaboratoryWave::bar:
      return "bar";
  }
  return "";
}

std::string_view modulus_symbol(LaboratoryWave wave) {
  switch (wave) {
    case LaboratoryWave::p:
      return "M";
    case LaboratoryWave::shear:
      return "G";
    case LaboratoryWave::bar:
      return "E";
  }
  return "";
}

std::string_view name(Mark mark) {
  switch (mark) {
    case Mark::peak:
      return "peak";
    case Mark::first_break:
      return "first break";
    case Mark::centroid:
      return "centroid";
    case Mark::correlation:
      return "correlation";
  }
  return "";
}

}  // namespace ddem::harness
