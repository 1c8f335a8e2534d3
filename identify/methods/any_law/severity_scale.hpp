#pragma once
/// Severities and the coordinate over which a law is interpolated between them.

#include <vector>

#include "identify/departures/departures.hpp"

namespace dualdamp::identify {

/// The coordinate in which the readings of a law are smooth down to severity zero. A contact that yields moves the
/// phase with the root of its deflection; friction over speed or position acts in proportion to the severity.
class SeverityScale {
 public:
  /// nullptr: Coulomb + viscous friction.
  explicit SeverityScale(const departures::Departure* departure)
      : root_(departure != nullptr && departure->family == departures::Family::presliding) {}

  /// The coordinate of a severity, of the same sign.
  [[nodiscard]] double of(double severity) const;
  [[nodiscard]] double severity(double coordinate) const;
  /// Severities from zero to `largest`, `count` after zero. Mild ones are closer together.
  [[nodiscard]] std::vector<double> first_severities(double largest, int count) const;

 private:
  bool root_;
};

}  // namespace dualdamp::identify
