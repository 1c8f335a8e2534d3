#pragma once
/// Rate and state: when the speed rises, friction first rises at once and then falls over a distance of slip.
///
///   F = a N asinh(v/(2 V0) exp((mu0 + b psi)/a))   [N]
///   psi' = (V0/Dc) (exp(-psi) - |v|/V0)            aging: contacts grow with time, also at v = 0
///   psi' = -(|v|/Dc) (ln(|v|/V0) + psi)            slip: contacts change with slip only
///
/// N = normal_force, Dc = slip_distance, V0 = reference_velocity; psi = ln(V0 theta/Dc) for the state theta of the
/// papers. It starts at 0, that is with steady sliding at V0. asinh makes the logarithm odd and finite at v = 0.
/// Where v >> V0 exp(-mu0/a), F = N (mu0 + a ln(v/V0) + b psi). In steady sliding psi = -ln(|v|/V0) and F = N (mu0
/// + (a - b) ln(v/V0)). With b > a steady friction falls with speed: slip driven at V through a spring then becomes
/// stick-slip below the stiffness N (b - a)/Dc (1 + m V^2/(N a Dc)).
///
/// The mass never sticks, it creeps: near v = 0 the law is a dashpot of a N/(2 V0) exp((mu0 + b psi)/a), which for
/// a << mu0 is extremely large. The logarithm is measured only for |v| far from 0; a motion that reverses depends
/// on the regularisation by asinh.
///
/// Source: dieterich1979 (aging), ruina1983 (slip), rice1983 (stability), rice2001 (asinh) in `docs/refs.bib`.
/// Smooth engine, implicit steps. Cost: an exponential, a logarithm and a root a call.

#include <span>
#include <string>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class RateState {
 public:
  enum class Evolution { aging, slip };

  struct Contact {
    double normal_force = 0.0;        ///< N >= 0
    double mu0 = 0.0;                 ///< > 0
    double a = 0.0;                   ///< > 0
    double b = 0.0;                   ///< >= 0
    double slip_distance = 0.0;       ///< m > 0
    double reference_velocity = 0.0;  ///< m/s > 0
    Evolution evolution = Evolution::aging;
  };

  static const std::vector<Parameter>& parameters();
  /// A warning if these values do not suit motions that reverse.
  static std::vector<std::string> warnings(const ParameterValues& values);

  explicit RateState(const Contact& contact) : contact_(contact) {}
  /// From the parameters.
  explicit RateState(const ParameterValues& values);

  [[nodiscard]] Memory start(const Instant&) const { return {.state = {0.0}}; }
  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction direction,
                               std::span<double> rates) const;
  void scales(const Memory&, std::span<double> scales) const { scales[0] = 1.0; }

 private:
  Contact contact_;
};

}  // namespace dualdamp::friction
