#pragma once
// A measured value, or the reason why there is none. A failed measurement is a status, never a number.

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace ddem::harness {

enum class Failure {
  non_finite,     ///< the signal holds NaN or infinity
  empty_window,   ///< fewer than three samples in the window
  no_reference,   ///< neither a quiet interval nor an expected amplitude: noise cannot be told from a pulse
  flat,           ///< no extremum: a constant signal, or a plateau without a peak
  at_edge,        ///< the largest value stands at the edge of the window: the peak may lie outside
  below_noise,    ///< not high enough above the noise, or below the amplitude expected
  not_first,      ///< what came before the pulse is too high beside it: noise, or the pulse is coda
  undersampled,   ///< too few samples, or steps, for a pulse so short
  beside_source,  ///< probes inside the source, on its two sides, or where its pulse is not alone
  too_high,       ///< higher than what the source can send
  ambiguous,      ///< a second, separate peak is as high
  not_causal,     ///< the delay between two picks is not positive, or that of no wave as fast as expected
  inconsistent,   ///< the pairs contradict each other
  growing,        ///< the run gained energy that nothing gave it
  narrow_band,    ///< too few frequencies at which both signals carry energy
  too_few_picks,  ///< fewer successful pairs than a mean needs
};

std::string_view name(Failure failure);

struct FailedMeasurement {
  Failure failure{};
  std::string reason;
};

/// Either a T or a FailedMeasurement. Asking a failed outcome for its value throws std::logic_error.
/// Not a std::variant: GCC 12 warns of uninitialised members where sanitizers meet variants of strings.
template <class T>
class Outcome {
 public:
  Outcome(T value) : ok_(true), value_(std::move(value)) {}  // NOLINT(google-explicit-constructor)
  Outcome(FailedMeasurement failed)
      : ok_(false), failed_(std::move(failed)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return ok_; }

  const T& value() const {
    if (!ok_) throw std::logic_error("value of a failed measurement: " + failed_.reason);
    return value_;
  }

  const FailedMeasurement& error() const {
    if (ok_) throw std::logic_error("error of a successful measurement");
    return failed_;
  }

 private:
  bool ok_;
  T value_{};
  FailedMeasurement failed_;
};

}  // namespace ddem::harness
