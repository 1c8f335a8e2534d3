#pragma once
/// LuGre: bristles of mean deflection z between the surfaces, which yield at a level that falls with speed.
///
///   z' = v - sigma0 |v| z/g(v)
///   F  = sigma0 z + sigma1 z' + sigma2 v           [N]
///   g(v) = kinetic + (static - kinetic) exp(-(v/stribeck_velocity)^2)     [N]
///
/// Here g is a force; the paper of 1995 writes sigma0 g for it. At constant speed z = g sgn v/sigma0 and F = g sgn
/// v + sigma2 v. For small displacements the contact is a spring sigma0 with a damper sigma1 + sigma2; the mass
/// never sticks.
///
/// The model has two known faults. Under a load that oscillates below break-away about a mean value the mass drifts
/// (dupont2002; under `elasto_plastic` it does not). And the law may give out more work than it took in, if and
/// only if sigma2 < sigma1 (static - kinetic)/kinetic (barabanov2000): bristles that are loaded slowly beyond the
/// kinetic level and released in a fast stroke push the mass by sigma1 z'.
///
/// Source: canudas1995, barabanov2000, dupont2002 in `docs/refs.bib`. Smooth engine; z is fast, at a rate of sigma0
/// |v|/g. Cost: one exponential a call.

#include <span>
#include <string>
#include <vector>

#include "friction_models/formulas/stribeck_curve.hpp"
#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class Lugre {
 public:
  static constexpr bool remembers_path = true;
  /// Of the bristles: N/m > 0, N.s/m >= 0, N.s/m >= 0.
  struct Bristles {
    double sigma0 = 0.0;
    double sigma1 = 0.0;
    double sigma2 = 0.0;

    /// N
    [[nodiscard]] double force(double z, double rate, double v) const {
      return sigma0 * z + sigma1 * rate + sigma2 * v;
    }
    /// F v minus the power stored in the bristles [W].
    [[nodiscard]] double heat(double z, double rate, double v) const {
      return force(z, rate, v) * v - sigma0 * z * rate;
    }
  };

  static const std::vector<Parameter>& parameters();
  [[nodiscard]] static Bristles bristles(const ParameterValues& values);
  /// A warning if these values are not passive.
  static std::vector<std::string> warnings(const ParameterValues& values);

  Lugre(const StribeckCurve& curve, const Bristles& bristles) : curve_(curve), bristles_(bristles) {}
  /// From the parameters.
  explicit Lugre(const ParameterValues& values);

  [[nodiscard]] Memory start(const Instant&) const { return {.state = {0.0}}; }
  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction direction,
                               std::span<double> rates) const;
  /// Where there was no force limit the bristles start unstretched.
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction) const {
    if (trigger.cause == Trigger::limit_change && curve_.static_level(now) == 0.0) memory = start(now);
  }
  void scales(const Memory&, std::span<double> scales) const { scales[0] = curve_.kinetic() / bristles_.sigma0; }
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction direction) const;
  /// J in the bristles.
  [[nodiscard]] double stored_energy(const Memory& memory, const Instant&) const {
    return 0.5 * bristles_.sigma0 * memory.state[0] * memory.state[0];
  }

 private:
  StribeckCurve curve_;
  Bristles bristles_;
};

}  // namespace dualdamp::friction
