#include "identify/ledger/sensor_or_symmetry.hpp"

#include <cmath>

#include "core/numbers.hpp"

namespace dualdamp::identify {

namespace {

bool is_of(const JointModel& model, const RelaxationTest& test, Assumption assumption) {
  return model.relaxations[test.index].assumption == assumption;
}

}  // namespace

std::size_t sensor_before_symmetry(const JointModel& model, const std::vector<RelaxationTest>& list,
                                   const std::vector<double>& misfits, std::size_t best) {
  if (!is_of(model, list[best], Assumption::symmetry)) return best;
  std::size_t charged = best;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const bool as_well = misfits[i] <= misfits[best] + equal_likelihood;
    if (as_well && is_of(model, list[i], Assumption::sensors) && (charged == best || misfits[i] < misfits[charged]))
      charged = i;
  }
  return charged;
}

bool yields_to_sensor(const JointModel& model, const std::vector<RelaxationTest>& list,
                      const std::vector<double>& misfits, std::size_t charged, std::size_t i) {
  constexpr double same = 0.5;  // of twice a log-likelihood: the record cannot tell them apart at all
  return is_of(model, list[charged], Assumption::sensors) && is_of(model, list[i], Assumption::symmetry) &&
         misfits[i] > misfits[charged] + same;
}

std::string size_of_constant_force(const JointModel& model, const RelaxationTest& test) {
  const double force = std::abs(model.relaxations[test.index].constant_force * test.coefficient);
  if (!(force > 0.0)) return {};
  constexpr int digits = 3;
  const auto with_unit = [&](double value, const char* unit) {
    return core::format_number(value, digits) + " " + model.constants.unit(unit);
  };
  return "; half of the difference of F0 between the directions is " + with_unit(force, "N") +
         ", the same as a zero of x that is off by " + with_unit(force / model.constants.stiffness, "m");
}

}  // namespace dualdamp::identify
