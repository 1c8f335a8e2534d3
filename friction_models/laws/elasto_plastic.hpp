#pragma once
/// Elasto-plastic bristles: LuGre with an elastic range of deflections (presliding). After a load that stays within
/// this range the mass returns to its place.
///
///   z' = v (1 - alpha sigma0 sgn(v) z/g(v))
///   F  = sigma0 z + sigma1 z' + sigma2 v           [N], g as in `lugre`
///   alpha = 0                                                               |z| <= z_ba, or sgn z != sgn v
///           (1 + sin(pi (|z| - (z_m + z_ba)/2)/(z_m - z_ba)))/2              z_ba < |z| < z_m = g(v)/sigma0
///           1                                                               |z| >= z_m
///
/// z_ba is `elastic_limit`, below kinetic/sigma0. Under loads below sigma0 z_ba the mass does not drift, as it does
/// under LuGre. sigma0 z_ba is a force limit, which modifiers change with the others. As lugre the law may give out
/// work where sigma2 < sigma1 (static - kinetic)/kinetic.
///
/// Modes: elastic, alpha = 0; and yielding, sgn(v) z > z_ba. z_m is no event: the slope of alpha is continuous
/// there, and in a long slip z approaches z_m asymptotically.
///
/// Source: dupont2002 in `docs/refs.bib`. Smooth engine. Cost: an exponential and a sine a call.

#include <span>
#include <vector>

#include "friction_models/formulas/stribeck_curve.hpp"
#include "friction_models/law.hpp"
#include "friction_models/laws/lugre.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class ElastoPlastic {
 public:
  static constexpr bool remembers_path = true;
  static const std::vector<Parameter>& parameters();
  /// The fault of an elastic limit that is not below kinetic/sigma0.
  static std::vector<ParameterFault> check(const ParameterValues& values);

  /// elastic_limit: m, > 0 and < kinetic/sigma0.
  ElastoPlastic(const StribeckCurve& curve, const Lugre::Bristles& bristles, double elastic_limit)
      : curve_(curve), bristles_(bristles), elastic_force_(bristles.sigma0 * elastic_limit) {}
  /// From the parameters.
  explicit ElastoPlastic(const ParameterValues& values);

  [[nodiscard]] Memory start(const Instant&) const { return {.state = {0.0}}; }
  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction direction,
                               std::span<double> rates) const;
  void guards(const Memory& memory, const Instant& now, Direction direction, std::vector<double>& values) const;
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction) const {
    // Where there was no force limit the bristles start unstretched.
    if (trigger.cause == Trigger::limit_change && curve_.static_level(now) == 0.0) memory = start(now);
    memory.mode = trigger.cause >= 0 && memory.mode == elastic ? yielding : elastic;
  }
  void scales(const Memory&, std::span<double> scales) const { scales[0] = curve_.kinetic() / bristles_.sigma0; }
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction direction) const;
  /// J in the bristles.
  [[nodiscard]] double stored_energy(const Memory& memory, const Instant&) const {
    return 0.5 * bristles_.sigma0 * memory.state[0] * memory.state[0];
  }

 private:
  enum : int { elastic, yielding };

  /// alpha at |z| = stretch.
  [[nodiscard]] double plastic_share(const Instant& now, double stretch, double level) const;

  StribeckCurve curve_;
  Lugre::Bristles bristles_;
  double elastic_force_;
};

}  // namespace dualdamp::friction
