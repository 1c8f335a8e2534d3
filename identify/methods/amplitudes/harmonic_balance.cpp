#include "identify/methods/amplitudes/harmonic_balance.hpp"

#include <algorithm>
#include <boost/math/interpolators/cubic_hermite.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "identify/conclusion.hpp"
#include "identify/methods/amplitudes/fundamental_laws.hpp"
#include "identify/methods/amplitudes/input_levels.hpp"
#include "identify/methods/amplitudes/steady_states.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/least_squares.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

using std::numbers::pi;

double fundamental_factor(double exponent) {
  return 2.0 / std::sqrt(pi) * std::exp(std::lgamma(0.5 * exponent + 1.0) - std::lgamma(0.5 * exponent + 1.5));
}

double friction_from_fundamental(const std::function<double(double)>& Phi,
                                 const std::function<double(double)>& Phi_slope, double u) {
  // The derivative taken under the integral, with V = u sin(theta).
  const auto integrand = [&](double theta) {
    const double s = std::sin(theta);
    return s * s * (Phi(u * s) + 0.5 * u * s * Phi_slope(u * s));
  };
  return boost::math::quadrature::gauss<double, 30>::integrate(integrand, 0.0, 0.5 * pi);
}

namespace {

constexpr Eigen::Index most_terms = 4;

/// Speed amplitude and fundamental of the friction of one state; nothing if spring and inertia need more force than
/// the drive gives.
std::optional<Datum> friction_point(const Pair& pair, const KnownConstants& constants) {
  const double X = fundamental(pair);
  const double drive = constants.stiffness * pair.Y;
  if (!std::isnan(pair.phase)) {
    const double across = drive * std::sin(pair.phase);
    if (!(across > 0.0)) return std::nullopt;
    return Datum{pair.omega * X, across, pair.number};
  }
  const double along = (constants.stiffness - constants.mass * pair.omega * pair.omega) * X;
  if (!(drive > std::abs(along))) return std::nullopt;
  return Datum{pair.omega * X, std::sqrt((drive - along) * (drive + along)), pair.number};
}

std::vector<Datum> friction_points(const std::vector<Pair>& states, const KnownConstants& constants) {
  std::vector<Datum> points;
  points.reserve(states.size());
  for (const Pair& state : states)
    if (const auto point = friction_point(state, constants)) points.push_back(*point);
  return points;
}

std::optional<ParameterSet> balanced_parameters(const std::vector<Pair>& states, const KnownConstants& constants) {
  const std::optional<ForceLine> line = force_line(friction_points(states, constants), coulomb_share);
  if (!line) return std::nullopt;
  return parameters(ForceParameters{constants.mass, line->c(), constants.stiffness, line->F0()});
}

/// Phi and f as polynomials in V over its largest value.
struct MonomialFit {
  double scale = 1.0;  ///< m/s
  Eigen::MatrixXd columns;
  Eigen::VectorXd coefficients;  ///< of f, N
  Eigen::VectorXd residuals;

  [[nodiscard]] double fundamental(double V) const { return sum(V, true); }
  [[nodiscard]] double friction(double v) const { return sum(v, false); }
  [[nodiscard]] double fundamental_slope(double V) const {
    double slope = 0.0;
    for (Eigen::Index n = 1; n < coefficients.size(); ++n)
      slope += static_cast<double>(n) * coefficients[n] * fundamental_factor(static_cast<double>(n)) / scale *
               std::pow(V / scale, static_cast<double>(n - 1));
    return slope;
  }

 private:
  [[nodiscard]] double sum(double v, bool of_fundamental) const {
    double total = 0.0;
    for (Eigen::Index n = coefficients.size(); n-- > 0;)
      total =
          total * v / scale + coefficients[n] * (of_fundamental ? fundamental_factor(static_cast<double>(n)) : 1.0);
    return total;
  }
};

Eigen::VectorXd monomial(const std::vector<Datum>& points, double scale, Eigen::Index n) {
  Eigen::VectorXd column(static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index i = 0; i < column.size(); ++i)
    column[i] = fundamental_factor(static_cast<double>(n)) *
                std::pow(points[static_cast<std::size_t>(i)].Y / scale, static_cast<double>(n));
  return column;
}

MonomialFit fit_monomials(const std::vector<Datum>& points, Eigen::Index terms) {
  MonomialFit fit;
  fit.scale = std::ranges::max_element(points, {}, &Datum::Y)->Y;
  fit.columns.resize(static_cast<Eigen::Index>(points.size()), terms);
  for (Eigen::Index n = 0; n < terms; ++n) fit.columns.col(n) = monomial(points, fit.scale, n);
  Eigen::VectorXd values(fit.columns.rows());
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = points[static_cast<std::size_t>(i)].x;
  fit.coefficients = linear_least_squares(fit.columns, values);
  fit.residuals = values - fit.columns * fit.coefficients;
  return fit;
}

/// The estimate less the error of the method there.
ParameterSet corrected(const std::vector<Pair>& states, const ParameterSet& value,
                       const KnownConstants& constants) {
  const std::vector<Pair> exact = exact_states(states, value, constants);
  const std::optional<ParameterSet> own =
      exact.size() == states.size() ? balanced_parameters(exact, constants) : std::nullopt;
  return own ? parameters(ForceParameters{constants.mass, 2.0 * value.c - own->c, constants.stiffness,
                                          2.0 * value.F0 - own->F0})
             : value;
}

/// Residuals of harmonic balance on the exact motion. They come from the method and do not count against the law.
Eigen::VectorXd own_residuals(const std::vector<Pair>& states, const std::vector<Datum>& points,
                              const ParameterSet& estimated, const KnownConstants& constants, Eigen::Index terms) {
  const auto none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(points.size()));
  if (!(estimated.zeta > 0.0) || !(estimated.x_f >= 0.0)) return none;
  const ParameterSet value = corrected(states, estimated, constants);
  if (!(value.zeta > 0.0) || !(value.x_f >= 0.0)) return none;
  const std::vector<Datum> exact = friction_points(exact_states(states, value, constants), constants);
  if (exact.size() != points.size()) return none;
  return fit_monomials(exact, terms).residuals;
}

/// Two terms, and one more as long as the test of the next one rejects. The first test is that of the estimate.
MonomialFit fit_curve(const std::vector<Pair>& states, const std::vector<Datum>& points,
                      const KnownConstants& constants, Estimate& estimate) {
  MonomialFit fit = fit_monomials(points, 2);
  const double range = output_range(points);
  for (Eigen::Index terms = 2; terms < most_terms; ++terms) {
    const Eigen::VectorXd residuals =
        fit.residuals - own_residuals(states, points, estimate.value, constants, terms);
    const auto test = added_term_test(fit.columns, residuals, monomial(points, fit.scale, terms), range,
                                      terms == 2 ? "quadratic friction F-test" : "cubic friction F-test");
    if (terms == 2) estimate.lack_of_fit = test;
    if (!test || !test->fired || fit.columns.rows() - terms - 1 < 2) break;
    fit = fit_monomials(points, terms + 1);
  }
  return fit;
}

/// C_n of a curve of more than two terms.
void list_coefficients(const MonomialFit& fit, Estimate& estimate) {
  const std::optional<Eigen::MatrixXd> unit = unit_covariance(fit.columns);
  const auto freedom = static_cast<double>(fit.columns.rows() - fit.columns.cols());
  if (fit.coefficients.size() == 2 || !unit || freedom < 1.0) return;
  const double variance = fit.residuals.squaredNorm() / freedom;
  for (Eigen::Index n = 0; n < fit.coefficients.size(); ++n) {
    const double power = std::pow(fit.scale, -static_cast<double>(n));
    const std::string exponent = n > 1 ? "^" + std::to_string(n) : "";
    estimate.others.push_back(further("C_" + std::to_string(n), n == 0 ? "N" : "N.s" + exponent + "/m" + exponent,
                                      fit.coefficients[n] * power, variance * (*unit)(n, n) * power * power,
                                      quantile95(freedom)));
  }
}

/// Slope of the parabola through each point and its neighbours; at least three points.
std::vector<double> parabolic_slopes(const std::vector<double>& V, const std::vector<double>& Phi) {
  const std::size_t n = V.size();
  const auto secant = [&](std::size_t i) { return (Phi[i + 1] - Phi[i]) / (V[i + 1] - V[i]); };
  std::vector<double> slopes(n);
  for (std::size_t i = 1; i + 1 < n; ++i)
    slopes[i] = std::lerp(secant(i - 1), secant(i), (V[i] - V[i - 1]) / (V[i + 1] - V[i - 1]));
  slopes.front() = 2.0 * secant(0) - slopes[1];
  slopes.back() = 2.0 * secant(n - 2) - slopes[n - 2];
  return slopes;
}

/// Phi through the measured points; points of equal speed are averaged. Below the slowest point it is the fitted
/// curve with a linear correction that meets that point.
class MeasuredFundamental {
 public:
  MeasuredFundamental(std::vector<Datum> points, const MonomialFit& fit) : fit_(fit) {
    std::ranges::sort(points, {}, &Datum::Y);
    constexpr double same = 1e-3;
    std::vector<double> Phi;
    double count = 0.0;
    for (const Datum& point : points) {
      if (speeds_.empty() || point.Y > speeds_.back() * (1.0 + same)) {
        speeds_.push_back(point.Y);
        Phi.push_back(point.x);
        count = 1.0;
        continue;
      }
      count += 1.0;
      Phi.back() += (point.x - Phi.back()) / count;
    }
    offset_ = Phi.front() - fit.fundamental(speeds_.front());
    if (speeds_.size() < least) return;
    std::vector<double> slopes = parabolic_slopes(speeds_, Phi);
    curve_.emplace(std::vector<double>(speeds_), std::move(Phi), std::move(slopes));
  }

  [[nodiscard]] bool exists() const { return curve_.has_value(); }
  [[nodiscard]] const std::vector<double>& speeds() const { return speeds_; }

  [[nodiscard]] double friction(double u) const {
    return friction_from_fundamental(
        [this](double V) {
          return V < speeds_.front() ? fit_.fundamental(V) + offset_ * V / speeds_.front()
                                     : (*curve_)(std::min(V, speeds_.back()));
        },
        [this](double V) {
          return V < speeds_.front() ? fit_.fundamental_slope(V) + offset_ / speeds_.front()
                                     : curve_->prime(std::min(V, speeds_.back()));
        },
        u);
  }

 private:
  static constexpr std::size_t least = 4;
  const MonomialFit& fit_;
  std::vector<double> speeds_;
  double offset_ = 0.0;
  std::optional<boost::math::interpolators::cubic_hermite<std::vector<double>>> curve_;
};

void add_curves(const std::vector<Datum>& points, const MonomialFit& fit, Estimate& estimate) {
  EstimateCurve Phi{"fundamental_friction",
                    {{"speed_amplitude", "m/s", {}}, {"measured", "N", {}}, {"fitted", "N", {}}}};
  for (const Datum& point : points) {
    Phi.columns[0].values.push_back(point.Y);
    Phi.columns[1].values.push_back(point.x);
    Phi.columns[2].values.push_back(fit.fundamental(point.Y));
  }
  estimate.curves.push_back(std::move(Phi));
  const MeasuredFundamental measured(points, fit);
  if (!measured.exists()) return;
  EstimateCurve friction{"friction_velocity", {{"v", "m/s", {}}, {"F", "N", {}}, {"F_abel", "N", {}}}};
  for (const double speed : measured.speeds()) {
    friction.columns[0].values.push_back(speed);
    friction.columns[1].values.push_back(fit.friction(speed));
    friction.columns[2].values.push_back(measured.friction(speed));
  }
  estimate.curves.push_back(std::move(friction));
}

/// Why no line goes through the friction of these states; empty when one does.
std::string lack_of_states(const std::vector<Pair>& states, bool has_line, const Estimate& estimate) {
  std::string reason = lacks_levels(states);
  if (states.size() < 2 || (reason.empty() && !has_line))
    reason = "two steady states of different speeds are needed, and " + std::to_string(states.size()) +
             (states.size() == 1 ? " is" : " are") + " left";
  if (reason.empty()) return reason;
  if (!estimate.excluded.empty())
    reason +=
        "; pair " + std::to_string(estimate.excluded.front().number) + ": " + estimate.excluded.front().reason;
  return reason;
}

/// Leaves out states without a friction point and those that stick, until no state sticks; nothing after `estimate`
/// has been refused.
std::optional<ForceLine> fit_sliding(std::vector<Pair>& states, const KnownConstants& constants,
                                     Estimate& estimate) {
  std::erase_if(states, [&](const Pair& state) {
    if (friction_point(state, constants)) return false;
    estimate.excluded.push_back({state.number, std::isnan(state.phase)
                                                   ? "spring and inertia take more than the drive gives"
                                                   : "its phase says that the mass drives the base"});
    return true;
  });
  while (true) {
    std::optional<ForceLine> line = force_line(friction_points(states, constants), coulomb_share);
    if (std::string lack = lack_of_states(states, line.has_value(), estimate); !lack.empty()) {
      refuse(estimate, std::move(lack));
      return std::nullopt;
    }
    set_estimate(estimate, *line, constants);
    if (!drop_sticking(states, estimate.value, constants, estimate)) {
      ForceLine scattered = *line;
      scattered.residuals -= own_residuals(states, line->points, estimate.value, constants, 2);
      set_estimate(estimate, scattered, constants);
      return line;
    }
    estimate.std.reset();
    estimate.interval95.reset();
  }
}

}  // namespace

Estimate harmonic_balance(const Record& record, const KnownConstants& constants) {
  Estimate estimate;
  estimate.method = harmonic_balance_method.name;
  std::optional<std::vector<Pair>> states = take_states(record, constants, false, estimate);
  if (!states) return estimate;
  const auto lacks_phase = [](const Pair& pair) { return std::isnan(pair.phase); };
  if (std::isnan(constants.mass) && std::ranges::any_of(*states, lacks_phase)) {
    refuse(estimate, "the method needs the mass where phases were not measured");
    return estimate;
  }
  const std::optional<ForceLine> line = fit_sliding(*states, constants, estimate);
  if (!line) return estimate;
  estimate.used = numbers_of(line->points);

  std::vector<std::string> faults;
  const double range = output_range(line->points);
  judge_force_signs(estimate, range / line->moments.mean_Y, range, faults);
  const MonomialFit fit = fit_curve(*states, line->points, constants, estimate);
  if (estimate.lack_of_fit && estimate.lack_of_fit->fired) {
    estimate.findings.emplace_back(
        "the fundamental of the friction force bends with the speed, so no single zeta and F0 describes it (see "
        "the curve friction_velocity)");
    estimate.warnings.emplace_back(
        "a curve of amplitudes at one frequency is the same for a suitable law of velocity, of position or of "
        "amplitude: it does not show which of them bends it");
  }
  list_coefficients(fit, estimate);
  add_curves(line->points, fit, estimate);
  judge_own_reading(
      *states, constants, [&](const auto& exact) { return balanced_parameters(exact, constants); },
      "because the motion is not harmonic", estimate, faults);
  conclude(estimate, faults,
           "rests on " + std::to_string(line->points.size()) + " of " + std::to_string(record.pairs->pairs.size()) +
               " steady states");
  return estimate;
}

constinit const MethodEntry harmonic_balance_method{
    .name = "harmonic_balance",
    .summary =
        "viscous damping, friction force and the friction-velocity curve from the balance of the first harmonic",
    .assumes =
        "harmonic balance, no sticking, friction a function of velocity; checked: sticking pairs are left out, "
        "quadratic friction F-test, the bias of harmonic balance at the estimate, Abel inversion beside the fitted "
        "curve",
    .equation = "k Y sin(phi) = sum_n C_n kappa_n (w X)^n, f(v) = sum_n C_n |v|^n sgn(v), C_0 = F0, C_1 = c",
    .sources = "iourtchenko2002, tomlinson1980",
    .needs = RecordKind::states,
    .lacks = lacks_pairs,
    .call = call_of<harmonic_balance>,
    .rests_on = AssumptionSet::all_but(),
};

}  // namespace dualdamp::identify
