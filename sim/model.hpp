#pragma once
/// A model is all that determines a motion: oscillator, excitation, friction laws in parallel, initial state.

#include <vector>

#include "friction_models/law.hpp"
#include "sim/excitation.hpp"
#include "sim/oscillator.hpp"

namespace dualdamp::sim {

struct InitialState {
  double position = 0.0;  ///< m
  double velocity = 0.0;  ///< m/s
};

struct Model {
  Oscillator oscillator;
  Excitation excitation;
  std::vector<friction::Law> friction;  ///< forces add
  InitialState initial;
};

}  // namespace dualdamp::sim
