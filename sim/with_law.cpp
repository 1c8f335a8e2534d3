#include "sim/with_law.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "friction_models/registry.hpp"

namespace dualdamp::sim {

Model with_law(Model model, std::string_view law, friction::ParameterValues values) {
  const friction::LawEntry* entry = friction::find_law(law);
  if (entry == nullptr || !friction::complete(*entry, values).empty())
    throw std::logic_error("the law " + std::string(law) + " refuses the values of a table");
  for (friction::Law& part : entry->make(values)) model.friction.push_back(std::move(part));
  return model;
}

double bristle_damping(const Oscillator& oscillator, double stiffness) {
  return 0.2 * std::sqrt(stiffness * oscillator.mass);
}

}  // namespace dualdamp::sim
