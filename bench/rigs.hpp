#pragma once
/// The names of the table of departures in this namespace.

#include "identify/rigs/rigs.hpp"

namespace dualdamp::bench {

using identify::rigs::Apparatus;
using identify::rigs::departed;
using identify::rigs::Departure;
using identify::rigs::DepartureParameter;
using identify::rigs::departures;
using identify::rigs::driven;
using identify::rigs::Family;
using identify::rigs::find_departure;
using identify::rigs::find_mechanism;
using identify::rigs::Laboratory;
using identify::rigs::mechanisms;
using identify::rigs::name_of;
using identify::rigs::natural_scale;
using identify::rigs::PlausibleValues;
using identify::rigs::ReferenceMotion;
using identify::rigs::released;
using identify::rigs::RigFriction;
using identify::rigs::Truth;
using identify::rigs::undisturbed;

}  // namespace dualdamp::bench
