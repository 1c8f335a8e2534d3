#pragma once
/// Error of a prediction by an estimate: the motion of the same rig in a test that was not made.
///
/// Two tests beside each range of excitation:
///
/// * 1.5 times the largest input amplitude, at the frequency in the middle of the range;
/// * 0.9 times the lowest frequency, at the input amplitude in the middle of the range.
///
/// The truth is the amplitude x of the rig as it is, departure included. The prediction is x of Coulomb + viscous
/// friction with the estimated zeta and F0 on the constants that the laboratory believes in. An F0 below zero
/// counts as zero, and a zeta below 1e-6 as 1e-6.
///
///   prediction error = mean over both tests of |predicted x / true x - 1|, 1 at most each; 1 without an answer.
///
/// NaN where a test has no truth: a rig without a steady state there, or one that does not move.

#include <array>

#include "bench/score/case_answer.hpp"
#include "bench/stress_test.hpp"

namespace dualdamp::bench {

/// Input amplitude [m] and frequency that the laboratory sets [rad/s].
struct UnmeasuredTest {
  double Y = 0.0;
  double frequency = 0.0;
};

using UnmeasuredTests = std::array<UnmeasuredTest, 2>;

/// x in each test [m].
using UnmeasuredAmplitudes = std::array<double, 2>;

[[nodiscard]] UnmeasuredTests unmeasured_tests(const ExcitationRange& range, const TrueRig& rig);

/// `believed`: the rig with the constants that the laboratory believes in; its damping and F0 are not used.
[[nodiscard]] double prediction_error(const CaseAnswer& answer, const Truth& believed, const UnmeasuredTests& tests,
                                      const UnmeasuredAmplitudes& truth);

}  // namespace dualdamp::bench
