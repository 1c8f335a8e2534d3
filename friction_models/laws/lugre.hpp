#pragma once
/// LuGre: bristles of mean deflection z between the surfaces, which give way at a level that falls with speed.
///
///   z' = v - sigma0 |v| z/g(v)
///   F  = sigma0 z + sigma1 z' + sigma2 v           [N]
///   g(v) = kinetic + (static - kinetic) exp(-(v/stribeck_velocity)^2)     [N]
///
/// g is a force here; the paper of 1995 prints sigma0 g in its place. At constant speed z = g sgn v/sigma0 and F =
/// g sgn v + sigma2 v. A contact that moves little is a spring sigma0 with a damper sigma1 + sigma2; it never holds
/// the mass.
///
/// Two known faults of the model. Under a load that oscillates below break-away about a mean z creeps on, so the
/// mass drifts (dupont2002; `elasto_plastic` does not). And it gives out work where sigma2 < sigma1 (static -
/// kinetic)/kinetic: a spring loaded slowly beyond the kinetic level is let go in a fast stroke, where sigma1 z'
/// pushes (barabanov2000: the condition is necessary and sufficient).
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
  /// Of the bristles: N/m > 0, N.s/m >= 0, N.s/m >= 0.
  struct Bristles {
    double sigma0 = 0.0;
    double sigma1 = 0.0;
    double sigma2 = 0.0;
  };

  static const std::vector<Parameter>& parameters();
  [[nodiscard]] static Bristles bristles(const ParameterValues& values);
  /// That these values are not passive.
  static std::vector<std::string> warnings(const ParameterValues& values);

  Lugre(const StribeckCurve& curve, const Bristles& bristles) : curve_(curve), bristles_(bristles) {}
  /// From the parameters.
  explicit Lugre(const ParameterValues& values);

  [[nodiscard]] Memory start(const Instant&) const { return {.state = {0.0}}; }
  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction direction,
                               std::span<double> rates) const;
  void scales(const Memory&, std::span<double> scales) const { scales[0] = curve_.kinetic() / bristles_.sigma0; }
  /// F v less what the bristles store, sigma0 z z'.
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction direction) const;

 private:
  StribeckCurve curve_;
  Bristles bristles_;
};

}  // namespace dualdamp::friction
