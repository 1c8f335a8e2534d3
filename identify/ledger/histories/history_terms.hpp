#pragma once
/// How assumptions may fail in histories: forces beside those of the oscillator with plain friction.

#include <span>
#include <string_view>

#include "identify/assumption.hpp"
#include "identify/ledger/joint_model.hpp"
#include "identify/models/sampled_oscillator.hpp"

namespace dualdamp::identify {

/// What the terms are scaled by: the amplitude of the record, and its speed at the natural frequency.
struct MotionScale {
  double length = 1.0;  ///< m
  double speed = 1.0;   ///< m/s
};

/// A dimensionless force, positive against the positive direction.
struct HistoryTerm {
  Assumption assumption;
  std::string_view test;
  double (*force)(const SampledOscillator::Instant& at, const MotionScale& scale);
  int sign = 0;            ///< of the coefficient in such a departure; 0: either
  bool one_sided = false;  ///< damping that is larger in one direction
  Freed freed = Freed::effect;
  bool is_of_contact = false;  ///< shows a contact that yields before it slides
  bool is_constant = false;    ///< the part of Coulomb friction that differs between the directions
  bool is_law = false;         ///< with a positive coefficient, as drag beside Coulomb and viscous friction
  bool is_hidden = false;      ///< fitted where a departure of friction is to be explained, and not tested
};

/// The terms, by assumption.
[[nodiscard]] std::span<const HistoryTerm> history_terms();

}  // namespace dualdamp::identify
