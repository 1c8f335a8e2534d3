#pragma once
/// The ways in which the joint model of histories is relaxed: constants, forces, friction of single histories, and
/// what is free in a sensor.

#include <cstddef>
#include <vector>

#include "identify/ledger/history_terms.hpp"
#include "identify/ledger/joint_model.hpp"
#include "identify/methods/histories/forward_fit.hpp"
#include "identify/models/sampled_oscillator.hpp"

namespace dualdamp::identify {

enum class MotionSensor { x, v, a };

/// The zero of a sensor of v or of a, in one history. It is always free: no force depends on it.
struct FreeZero {
  std::size_t history = 0;
  MotionSensor sensor = MotionSensor::v;
  double unit = 1.0;  ///< m/s or m/s^2
  double near = 0.0;  ///< a value near it, in this unit
};

[[nodiscard]] std::vector<FreeZero> free_zeros(const std::vector<ForwardTest>& tests, const MotionScale& scale);

/// What a relaxation sets free.
struct Way {
  enum class Kind { constant, force, friction_of_history, gain, delay, zero, zero_drift } kind = Kind::constant;
  SampledOscillator::By by = SampledOscillator::By::mass;  ///< of a constant
  const HistoryTerm* term = nullptr;                       ///< of a force
  std::size_t history = 0;
  MotionSensor sensor = MotionSensor::x;
};

/// Share of the free friction force of one history in every history, so that F0 stays the mean over all.
[[nodiscard]] double share_of(const Way& way, std::size_t test, std::size_t tests);

/// All relaxations that the histories may show, each with its way.
struct HistoryWays {
  std::vector<Relaxation> relaxations;
  std::vector<Way> ways;  ///< of each relaxation
};

/// Gain and delay of x are free only beside another signal: x alone, with its initial state free, tells neither.
[[nodiscard]] HistoryWays history_ways(const std::vector<ForwardTest>& tests, const KnownConstants& constants);

}  // namespace dualdamp::identify
