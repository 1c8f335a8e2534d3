#include "identify/methods/amplitudes/den_hartog_fit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/angle.hpp"
#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/amplitudes/bootstrap.hpp"
#include "identify/methods/amplitudes/input_levels.hpp"
#include "identify/methods/amplitudes/line_estimate.hpp"
#include "identify/models/sticking.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/least_squares.hpp"
#include "identify/statistics/profile_likelihood.hpp"
#include "identify/statistics/scatter.hpp"
#include "identify/statistics/statistics.hpp"
#include "identify/statistics/unequal_errors.hpp"
#include "sim/analytic/den_hartog.hpp"

namespace dualdamp::identify {

namespace analytic = sim::analytic;

namespace {

constexpr double greatest_zeta = 0.95;
using core::infinity;

/// Parameters (zeta, x_f in the unit of the data, ln(wn/wn of the constants)); the last may be held at 0.
class AmplitudeLaw {
 public:
  AmplitudeLaw(std::vector<Datum> pairs, bool free) : pairs_(std::move(pairs)), size_(free ? 3 : 2) {
    for (const Datum& datum : pairs_) {
      const auto found = std::ranges::find_if(ratios_, [&](double r) { return is_same_frequency(r, datum.r); });
      frequency_.push_back(static_cast<std::size_t>(found - ratios_.begin()));
      if (found == ratios_.end()) ratios_.push_back(datum.r);
    }
  }

  [[nodiscard]] const std::vector<Datum>& pairs() const { return pairs_; }
  [[nodiscard]] std::size_t frequencies() const { return ratios_.size(); }
  [[nodiscard]] const std::vector<double>& ratios() const { return ratios_; }
  [[nodiscard]] std::size_t frequency(std::size_t pair) const { return frequency_[pair]; }
  [[nodiscard]] Eigen::Index rows() const { return static_cast<Eigen::Index>(pairs_.size()); }
  [[nodiscard]] Eigen::Index size() const { return size_; }

  /// Law less measurement; derivatives in all three directions whether fitted or not. False outside the law's
  /// range.
  bool evaluate(const Eigen::Vector3d& p, Eigen::VectorXd& residual, Eigen::MatrixX3d* jacobian) const {
    if (!(p[0] > 0.0 && p[0] < greatest_zeta)) return false;
    const double scale = std::exp(-p[2]);
    functions_.clear();
    slopes_.clear();
    for (const double r : ratios_) {
      functions_.push_back(analytic::den_hartog(p[0], r * scale));
      if (jacobian != nullptr) slopes_.push_back(analytic::slopes(functions_.back()));
    }
    residual.resize(rows());
    if (jacobian != nullptr) jacobian->resize(rows(), 3);
    for (Eigen::Index i = 0; i < rows(); ++i) {
      const Datum& datum = pairs_[static_cast<std::size_t>(i)];
      const std::size_t k = frequency_[static_cast<std::size_t>(i)];
      const analytic::DenHartog& d = functions_[k];
      const double viscous = datum.Y / d.q;
      const double reactive = d.H * p[1];
      if (!(viscous > std::abs(reactive))) return false;
      const double root = std::sqrt((viscous - reactive) * (viscous + reactive));
      residual[i] = root - d.G * p[1] - datum.x;
      if (jacobian == nullptr) continue;
      const analytic::DenHartogSlopes& s = slopes_[k];
      const auto slope = [&](double G, double H, double q) {
        return -G * p[1] - (viscous * viscous * q / d.q + reactive * H * p[1]) / root;
      };
      (*jacobian)(i, 0) = slope(s.G_zeta, s.H_zeta, s.q_zeta);
      (*jacobian)(i, 1) = -d.G - d.H * reactive / root;
      (*jacobian)(i, 2) = -d.r * slope(s.G_r, s.H_r, s.q_r);
    }
    return true;
  }

  /// Mean square of dx/dY: factor from the variance of the input to that of the output.
  [[nodiscard]] double mean_square_gain(const Eigen::Vector3d& p) const {
    double sum = 0.0;
    for (const Datum& datum : pairs_) {
      const analytic::DenHartog d = analytic::den_hartog(p[0], datum.r * std::exp(-p[2]));
      const double viscous = datum.Y / d.q;
      const double gain = viscous / (d.q * std::sqrt(viscous * viscous - d.H * d.H * p[1] * p[1]));
      sum += gain * gain;
    }
    return sum / static_cast<double>(pairs_.size());
  }

 private:
  std::vector<Datum> pairs_;
  std::vector<double> ratios_;
  std::vector<std::size_t> frequency_;
  Eigen::Index size_;
  mutable std::vector<analytic::DenHartog> functions_;
  mutable std::vector<analytic::DenHartogSlopes> slopes_;
};

double sum_of_squares(const AmplitudeLaw& law, const Eigen::Vector3d& p) {
  Eigen::VectorXd residual;
  return law.evaluate(p, residual, nullptr) ? residual.squaredNorm() : infinity;
}

/// The best point of a grid in zeta (and wn); its friction by linear least squares with H neglected.
std::optional<Eigen::Vector3d> starting_point(const AmplitudeLaw& law) {
  std::optional<Eigen::Vector3d> best;
  double least = infinity;
  std::vector<analytic::DenHartog> functions;
  const double reach = law.size() == 3 ? 0.15 : 0.0;
  for (double u = -reach; u <= reach; u += 0.03) {
    for (double zeta = 0.003; zeta < greatest_zeta; zeta *= 1.35) {
      functions.clear();
      for (const double r : law.ratios()) functions.push_back(analytic::den_hartog(zeta, r * std::exp(-u)));
      double S_GG = 0.0;
      double S_Gx = 0.0;
      for (std::size_t i = 0; i < law.pairs().size(); ++i) {
        const analytic::DenHartog& d = functions[law.frequency(i)];
        S_GG += d.G * d.G;
        S_Gx += d.G * (law.pairs()[i].Y / d.q - law.pairs()[i].x);
      }
      const Eigen::Vector3d p(zeta, std::max(S_Gx / S_GG, 0.0), u);
      const double squares = sum_of_squares(law, p);
      if (squares >= least) continue;
      least = squares;
      best = p;
    }
  }
  return best;
}

struct ExactFit {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::VectorXd residual;
  Eigen::MatrixX3d jacobian;  ///< in all three directions
};

std::optional<ExactFit> fit_model(const AmplitudeLaw& law) {
  const std::optional<Eigen::Vector3d> start = starting_point(law);
  if (!start) return std::nullopt;
  ExactFit result;
  const auto full = [&law](const Eigen::VectorXd& p) {
    return Eigen::Vector3d(p[0], p[1], law.size() == 3 ? p[2] : 0.0);
  };
  LeastSquaresProblem problem;
  problem.residuals = law.rows();
  problem.start = start->head(law.size());
  problem.evaluate = [&](const Eigen::VectorXd& p, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
    if (!law.evaluate(full(p), residual, jacobian == nullptr ? nullptr : &result.jacobian)) return false;
    if (jacobian != nullptr) *jacobian = result.jacobian.leftCols(law.size());
    return true;
  };
  const LeastSquaresFit found = fit(problem);
  if (!found.outcome.ok()) return std::nullopt;
  result.p = full(found.parameters);
  if (!law.evaluate(result.p, result.residual, &result.jacobian)) return std::nullopt;
  return result;
}

/// A few Gauss-Newton steps from a near point, which suffice for the replicates of a bootstrap.
std::optional<Eigen::Vector3d> refine(const AmplitudeLaw& law, Eigen::Vector3d p) {
  Eigen::VectorXd residual;
  Eigen::MatrixX3d jacobian;
  constexpr int steps = 6;
  for (int i = 0; i < steps; ++i) {
    if (!law.evaluate(p, residual, &jacobian)) return std::nullopt;
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    const Eigen::MatrixXd columns = jacobian.leftCols(law.size());
    step.head(law.size()) = DefiniteMatrix(gram(columns)).solve(columns.transpose() * residual);
    p -= step;
    if (std::abs(step[0]) < 1e-9 * p[0]) return p;
  }
  return p;
}

/// Fits, leaves out the pairs that stick at the estimate, and fits again until none does.
std::optional<ExactFit> fit_sliding(AmplitudeLaw& law, double unit, const KnownConstants& constants,
                                    Estimate& estimate) {
  while (law.rows() >= law.size()) {
    std::optional<ExactFit> fit = fit_model(law);
    if (!fit) return std::nullopt;
    const double x_f = fit->p[1];
    std::vector<Datum> left;
    Sticking sticking(fit->p[0], x_f);
    for (const Datum& datum : law.pairs()) {
      const double least_ratio = sticking.limit(datum.r * std::exp(-fit->p[2]));
      if (x_f <= 0.0 || datum.x > least_ratio * x_f) {
        left.push_back(datum);
        continue;
      }
      estimate.excluded.push_back(
          {datum.number, "the mass sticks: x/x_f = " + core::format_number(datum.x / x_f, 4) + " is not above " +
                             core::format_number(least_ratio, 4) +
                             " (at zeta = " + core::format_number(fit->p[0], 4) +
                             ", x_f = " + core::format_number(x_f * unit, 4) + " " + constants.unit("m") + ")"});
    }
    std::ranges::sort(estimate.excluded, {}, &Exclusion::number);
    if (left.size() == law.pairs().size()) return fit;
    law = AmplitudeLaw(std::move(left), law.size() == 3);
  }
  return std::nullopt;
}

/// The constants with the mass that makes the fitted natural frequency of the known stiffness.
KnownConstants fitted_constants(const KnownConstants& constants, const ExactFit& fit) {
  KnownConstants result = constants;
  result.mass *= std::exp(-2.0 * fit.p[2]);
  return result;
}

/// Errors of equal size, or stated ones: their variance times the covariance of unit errors. At several frequencies
/// an error of the input, or one in proportion to the reading, is largest at resonance.
std::optional<UnequalErrors> errors_of(const AmplitudeLaw& law, const ExactFit& fit, const Scatter& scatter) {
  const Eigen::MatrixXd jacobian = fit.jacobian.leftCols(law.size());
  std::optional<Eigen::MatrixXd> unit = unit_covariance(jacobian);
  if (!unit) return std::nullopt;
  if (!scatter.is_stated && law.frequencies() > 1) return unequal_errors(jacobian, fit.residual);
  return UnequalErrors{scatter.variance * *unit, Eigen::VectorXd::Constant(law.size(), scatter.half_width)};
}

void add_uncertainty(const AmplitudeLaw& law, const ExactFit& fit, double unit, const KnownConstants& constants,
                     const std::optional<Scatter>& scatter, Estimate& estimate) {
  const std::optional<UnequalErrors> errors = scatter ? errors_of(law, fit, *scatter) : std::nullopt;
  if (errors) {
    const Eigen::DiagonalMatrix<double, 2> to_metres(1.0, unit);
    const Eigen::Matrix2d friction = errors->covariance.topLeftCorner<2, 2>();
    const Eigen::Vector2d half_widths = errors->half_widths.head<2>();
    set_uncertainty(estimate, to_metres * friction * to_metres, half_widths, constants);
  }
  if (law.size() < 3) return;
  const double omega_n = constants.natural_frequency();
  FurtherParameter parameter{"natural_frequency", "rad/s", omega_n, std::nullopt, std::nullopt};
  if (errors) {
    const double std = omega_n * std::sqrt(errors->covariance(2, 2));
    parameter.std = std;
    parameter.interval95 = around(omega_n, errors->half_widths[2] * std);
  }
  estimate.others.push_back(std::move(parameter));
}

/// Tests whether friction changes with the amplitude, and whether the natural frequency differs from the stated
/// one.
void test_fit(const AmplitudeLaw& law, const ExactFit& fit, Estimate& estimate) {
  const Eigen::MatrixXd columns = fit.jacobian.leftCols(law.size());
  const Eigen::VectorXd residual = -fit.residual;  // measurement less law
  Eigen::VectorXd square(law.rows());
  for (Eigen::Index i = 0; i < law.rows(); ++i) {
    const double fitted = law.pairs()[static_cast<std::size_t>(i)].x + fit.residual[i];
    square[i] = fitted * fitted;
  }
  const double range = output_range(law.pairs());
  estimate.lack_of_fit = added_term_test(columns, residual, square, range, "quadratic term F-test");
  if (estimate.lack_of_fit && estimate.lack_of_fit->fired)
    estimate.findings.emplace_back(
        "the pairs do not follow the amplitude law, so no single zeta and F0 describes them");
  if (law.size() == 3 || law.frequencies() < 2) return;
  const auto detuned = added_term_test(columns, residual, fit.jacobian.col(2), range, "natural frequency F-test");
  if (detuned && detuned->fired)
    estimate.findings.push_back("the frequencies contradict wn = sqrt(k/m) (F test, " + p_text(detuned->p_value) +
                                "): with three or more of them the natural frequency can be fitted");
}

/// Phases are not fitted; they show a lag of the sensors, or another wn.
void judge_phases(const Record& record, const AmplitudeLaw& law, const ExactFit& fit, Estimate& estimate) {
  double sum = 0.0;
  int count = 0;
  for (const Datum& datum : law.pairs()) {
    const auto pair = std::ranges::find(record.pairs->pairs, datum.number, &Pair::number);
    if (pair == record.pairs->pairs.end() || std::isnan(pair->phase)) continue;
    const auto state = analytic::non_sticking_state(analytic::den_hartog(fit.p[0], datum.r * std::exp(-fit.p[2])),
                                                    datum.Y, std::max(fit.p[1], 0.0));
    if (!state) continue;
    sum += core::wrapped(pair->phase - state->phase);
    ++count;
  }
  constexpr double largest = 0.03;  // rad
  if (count > 0 && std::abs(sum / count) > largest)
    estimate.warnings.push_back("the measured phases differ from those of the fitted motion by " +
                                core::format_number(sum / count * 180.0 / std::numbers::pi, 3) +
                                " degrees on average: a lag of the instruments, or another natural frequency");
}

Deviance deviance_of(const AmplitudeLaw& law, const ExactFit& fit, double unit, double variance) {
  return [&law, &fit, unit, variance, least = fit.residual.squaredNorm()](double zeta, double x_f) {
    const auto deviance = [&](double u) { return (sum_of_squares(law, {zeta, x_f / unit, u}) - least) / variance; };
    if (law.size() == 2) return deviance(0.0);
    constexpr int digits = 20;
    constexpr double reach = 0.05;
    return boost::math::tools::brent_find_minima(deviance, fit.p[2] - reach, fit.p[2] + reach, digits).second;
  };
}

void bootstrap(const AmplitudeLaw& law, const ExactFit& fit, const ResonanceData& data, int replicates,
               Estimate& estimate) {
  const std::vector<std::vector<std::size_t>> blocks = sweep_blocks(law.pairs());
  const double widen = std::sqrt(static_cast<double>(law.rows()) /
                                 static_cast<double>(std::max<Eigen::Index>(law.rows() - law.size(), 1)));
  const auto drawn = [&](Draws& draws) {
    std::vector<Datum> pairs;
    for (std::size_t j = 0; j < blocks.size() && blocks.size() > 1; ++j)
      for (const std::size_t i : blocks[draws.below(blocks.size())]) pairs.push_back(law.pairs()[i]);
    if (blocks.size() > 1) return pairs;
    pairs = law.pairs();
    for (std::size_t i = 0; i < pairs.size(); ++i)
      pairs[i].x += fit.residual[static_cast<Eigen::Index>(i)] -
                    widen * fit.residual[static_cast<Eigen::Index>(draws.below(pairs.size()))];
    return pairs;
  };
  add_bootstrap(estimate, replicates, blocks.size(), data.constants,
                [&](Draws& draws) -> std::optional<Eigen::Vector2d> {
                  const auto p = refine(AmplitudeLaw(drawn(draws), law.size() == 3), fit.p);
                  if (!p || !p->allFinite()) return std::nullopt;
                  return Eigen::Vector2d((*p)[0], (*p)[1] * data.unit);
                });
}

/// Why no fit is possible; empty otherwise.
std::string fault_of(const AmplitudeLaw& law, const std::vector<Exclusion>& excluded) {
  if (law.size() == 3 && law.frequencies() < 3)
    return "fewer than three frequencies do not determine the natural frequency, and the record has " +
           std::to_string(law.frequencies()) + ": zeta would be known tens of times worse";
  if (law.rows() < law.size()) {
    std::string fault = std::to_string(law.size()) + " pairs are needed, and " + std::to_string(law.rows()) +
                        (law.rows() == 1 ? " is" : " are") + " left";
    if (!excluded.empty())
      fault += "; pair " + std::to_string(excluded.front().number) + ": " + excluded.front().reason;
    return fault;
  }
  return lacks_levels(law.pairs());
}

}  // namespace

Estimate den_hartog_fit(const Record& record, const KnownConstants& constants, const DenHartogOptions& options) {
  Estimate estimate;
  estimate.method = den_hartog_fit_method.name;
  std::optional<ResonanceData> data = take_pairs(record, constants, estimate);
  if (!data) return estimate;
  std::ranges::sort(data->pairs, {}, &Datum::number);
  AmplitudeLaw law(data->pairs, options.free_natural_frequency);
  if (std::string fault = fault_of(law, estimate.excluded); !fault.empty()) {
    refuse(estimate, std::move(fault));
    return estimate;
  }
  const std::optional<ExactFit> fit = fit_sliding(law, data->unit, constants, estimate);
  if (!fit) {
    std::string fault = fault_of(law, estimate.excluded);
    refuse(estimate, fault.empty() ? "no zeta below 0.95 fits the pairs" : std::move(fault));
    return estimate;
  }
  const KnownConstants used_constants = fitted_constants(constants, *fit);
  estimate.value = parameters(fit->p[0], fit->p[1] * data->unit, used_constants);
  estimate.used = numbers_of(law.pairs());
  const auto freedom = static_cast<double>(law.rows() - law.size());
  const auto scatter = scatter_of(fit->residual.squaredNorm(), freedom, std::sqrt(law.mean_square_gain(fit->p)),
                                  options, data->unit);
  add_uncertainty(law, *fit, data->unit, used_constants, scatter, estimate);
  if (scatter) warn_of_scatter(scatter->ratio, freedom, estimate);

  std::vector<std::string> faults;
  judge_signs(estimate, law.pairs().front().Y * data->unit, faults);
  test_fit(law, *fit, estimate);
  judge_phases(record, law, *fit, estimate);
  if (options.profile && scatter)
    add_profiles(estimate, deviance_of(law, *fit, data->unit, scatter->variance), scatter->half_width,
                 used_constants);
  if (options.bootstrap > 0) bootstrap(law, *fit, *data, options.bootstrap, estimate);
  conclude(estimate, faults,
           "rests on " + std::to_string(law.rows()) + " of " + std::to_string(record.pairs->pairs.size()) +
               " pairs at " + std::to_string(law.frequencies()) +
               (law.frequencies() == 1 ? " frequency" : " frequencies"));
  return estimate;
}

constinit const MethodEntry den_hartog_fit_method{
    .name = "den_hartog_fit",
    .summary = "damping ratio and friction force from the exact amplitude law, at any frequencies",
    .assumes =
        "Coulomb and viscous friction, no sticking, errors in x alone; checked: sticking pairs are left out, quadratic "
        "term F-test, natural frequency F-test (several frequencies), measured phases where there are any",
    .equation =
        "(x + G x_f)^2 + (H x_f)^2 = (Y/q)^2, Eqs (3)-(6), by nonlinear least squares over zeta, x_f and, if asked "
        "for, wn",
    .sources = "denhartog1931, hundal1979, liang2004identifying",
    .needs = RecordKind::states,
    .lacks = lacks_pairs,
    .call = call_of<den_hartog_fit>,
    .rests_on = AssumptionSet::all_but(),
};

}  // namespace dualdamp::identify
