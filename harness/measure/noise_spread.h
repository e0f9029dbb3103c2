#pragma once
// What the noise of a recording, of whatever colour, does to a number that is a weighted sum of its samples.

#include <span>

namespace ddem::harness {

/// Root mean square of sum_k weights(k) noise(n + k) over the places n of a piece of noise, whose end is followed by its begin:
/// the spread that such noise gives to the same sum over a pulse. 0 without noise.
double projected_noise(std::span<const double> noise, std::span<const double> weights);

/// Over how many samples noise remembers itself: 1 + 2 sum of its autocorrelation up to the first lag at which that is negative;
/// 1 for white noise. At least 1.
double correlation_length(std::span<const double> noise);

/// By how much a spread that was found from so many independent pieces of noise is widened, so that 1.96 of it hold the truth
/// in 95 of 100 cases: Student's t over 1.96. At least one piece.
double student_widening(double independent);

/// How many times above a noise level, found from so many independent pieces, a value must stand to come from it in at most
/// one of 1000 cases: Student's t, and infinite for less than one piece.
double student_threshold(double independent);

}  // namespace ddem::harness
