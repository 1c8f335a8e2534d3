#pragma once
/// The table of departures of `identify/departures/`, which this folder scores, under its own names here.

#include "identify/departures/departures.hpp"

namespace dualdamp::bench {

using identify::departures::Apparatus;
using identify::departures::departed;
using identify::departures::Departure;
using identify::departures::DepartureParameter;
using identify::departures::departures;
using identify::departures::driven;
using identify::departures::Family;
using identify::departures::find_departure;
using identify::departures::find_mechanism;
using identify::departures::Laboratory;
using identify::departures::mechanisms;
using identify::departures::name_of;
using identify::departures::natural_scale;
using identify::departures::PlausibleValues;
using identify::departures::ReferenceMotion;
using identify::departures::released;
using identify::departures::RigFriction;
using identify::departures::Truth;
using identify::departures::undisturbed;

}  // namespace dualdamp::bench
