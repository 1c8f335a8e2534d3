#pragma once
/// The table of departures of `identify/departures/`, which this folder scores, under its own names here.

#include "identify/departures/departures.hpp"

namespace dualdamp::bench {

using namespace identify::departures;

}  // namespace dualdamp::bench
