#pragma once
/// The motion of  m x'' + c x' + k x + F0 sgn x' = k y(t) + f(t)  where y and f are known by samples, and its
/// derivatives with respect to the parameters and the initial state.
///
/// Between samples y and f are polynomials through the eight nearest samples. Under a polynomial the motion is its
/// own Taylor series, of which as many terms are summed as double precision holds: nothing is integrated in steps.
/// Reversals, stops and releases are found as roots of that series. The exact engine (`sim/`) knows harmonic drives
/// and ramps alone; a measured base motion is neither.
///
/// Derivatives S = dx/dp obey  m S'' + c S' + k S = dm-, dc-, dk-, dF0-terms  within an interval. At v = 0 the
/// acceleration jumps from a- to a+, and S_x+ = S_x-, S_v+ = S_v- a+/a- (filippov1988, leine2004); at a stop S_v =
/// 0.
///
/// Errors: two reversals within a quarter of a sample interval may be missed. Cost: about 0.2 us a sample, and as
/// much again for each derivative.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

class SampledOscillator {
 public:
  struct Parameters {
    double m = 1.0;   ///< kg, > 0
    double c = 0.0;   ///< N.s/m
    double k = 1.0;   ///< N/m, >= 0
    double F0 = 0.0;  ///< N, >= 0
    double x0 = 0.0;  ///< m
    double v0 = 0.0;  ///< m/s
  };
  /// What the motion is differentiated by; `drag`: a force c2 v|v| beside the others, at c2 = 0 [N.s^2/m^2].
  enum class By { mass, damping, stiffness, friction, position, velocity, drag };

  /// The drive of a history: y and force, each zero when it was not measured. At least eight samples.
  explicit SampledOscillator(const History& history);

  /// x at the samples. `derivatives`, where there is one: a row a sample, a column for each of `by`; `v`, where
  /// there is one: the velocity. False: the parameters are too fast for the sample rate, or a value is not finite.
  bool run(const Parameters& parameters, const std::vector<By>& by, Eigen::VectorXd& x,
           Eigen::MatrixXd* derivatives, Eigen::VectorXd* v = nullptr);

 private:
  static constexpr int nodes = 8;
  static constexpr int most_terms = 28;
  using Drive = std::array<double, nodes>;
  using Series = std::array<double, most_terms>;

  /// d(x, v)/dp at the present time, v by the sample interval.
  struct Tangent {
    By by = By::mass;
    double x = 0.0;
    double v = 0.0;
    Series series{};
  };

  bool walk_interval(std::size_t interval);
  double slip(double begin, double end);
  double rest(double begin, double end) const;
  void expand(double begin);
  void expand(Tangent& tangent) const;
  void move_to(double u);
  void settle(double at);
  [[nodiscard]] double pull(double at) const;
  [[nodiscard]] double first_reversal(double length) const;

  std::size_t count_;
  double rate_;
  std::vector<Drive> y_, force_;  ///< of each interval, by powers of the time within it in sample intervals

  Parameters p_;
  double inertia_ = 0.0;  ///< m, c by the unit of time of one sample interval
  double damping_ = 0.0;
  Series integration_{};  ///< from a coefficient of the force to that of x two powers on
  int terms_ = 0;
  std::size_t interval_ = 0;
  int direction_ = 0;
  double x_ = 0.0;
  double v_ = 0.0;  ///< by sample interval
  double fastest_ = 0.0;
  Drive y_here_{};
  Drive drive_{};
  Series series_{};
  std::vector<Tangent> tangents_;
};

}  // namespace dualdamp::identify
