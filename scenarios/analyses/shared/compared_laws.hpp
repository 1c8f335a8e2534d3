#pragma once
/// What a fit of several laws states or seeks of one of them, under names that begin with the law: iwan.count.

#include <string>
#include <vector>

#include "scenarios/analyses/shared/fit_setup.hpp"

namespace dualdamp::scenarios {

/// What is sought of one of these laws: a name that begins with it begins with `friction` instead, and those of the
/// other laws are left out.
[[nodiscard]] Sought sought_of_law(const Sought& sought, const std::vector<std::string>& laws,
                                   const std::string& law);

/// Puts the numbers of `analysis.stated` into the laws of the rigs, one law each. A name without a law is that of
/// the only law that has such a parameter.
void state_values(const Json& analysis, std::vector<identify::Rig>& rigs, std::vector<SetupFault>& faults);

}  // namespace dualdamp::scenarios
