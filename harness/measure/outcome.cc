#include "harness/measure/outcome.h"

namespace ddem::harness {

std::string_view name(Failure failure) {
  switch (failure) {
    case Failure::non_finite:
      return "non_finite";
    case Failure::empty_window:
      return "empty_window";
    case Failure::no_reference:
      return "no_reference";
    case Failure::flat:
      return "flat";
    case Failure::at_edge:
      return "at_edge";
    case Failure::below_noise:
      return "below_noise";
    case Failure::not_first:
      return "not_first";
    case Failure::undersampled:
      return "undersampled";
    case Failure::beside_source:
      return "beside_source";
    case Failure::too_high:
      return "too_high";
    case Failure::ambiguous:
      return "ambiguous";
    case Failure::not_causal:
      return "not_causal";
    case Failure::inconsistent:
      return "inconsistent";
    case Failure::growing:
      return "growing";
    case Failure::narrow_band:
      return "narrow_band";
    case Failure::too_few_picks:
      return "too_few_picks";
  }
  return "unknown";
}

}  // namespace ddem::harness
