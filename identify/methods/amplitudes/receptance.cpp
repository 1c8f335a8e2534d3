#include "identify/methods/amplitudes/receptance.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/equal_work.hpp"
#include "identify/methods/amplitudes/steady_states.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/least_squares.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

using std::numbers::pi;

namespace {

/// k Y/X, N/m.
double dynamic_stiffness(const Pair& pair, double stiffness) { return stiffness * pair.Y / fundamental(pair); }

struct PartFit {
  Eigen::MatrixXd columns;
  Eigen::VectorXd coefficients;
  Eigen::VectorXd residuals;

  [[nodiscard]] double freedom() const { return static_cast<double>(columns.rows() - columns.cols()); }
  [[nodiscard]] double variance() const { return residuals.squaredNorm() / freedom(); }
};

using Row = std::function<Eigen::Vector3d(const Pair&)>;

/// Least squares of two columns; `row` gives them and the value of one state.
PartFit fit_states(const std::vector<Pair>& states, const Row& row) {
  PartFit fit;
  fit.columns.resize(static_cast<Eigen::Index>(states.size()), 2);
  Eigen::VectorXd values(fit.columns.rows());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const Eigen::Vector3d numbers = row(states[static_cast<std::size_t>(i)]);
    fit.columns.row(i) = numbers.head<2>();
    values[i] = numbers[2];
  }
  fit.coefficients = linear_least_squares(fit.columns, values);
  fit.residuals = values - fit.columns * fit.coefficients;
  return fit;
}

Eigen::Vector3d imaginary_row(const Pair& state, double stiffness) {
  return {state.omega, 4.0 / (pi * fundamental(state)),
          dynamic_stiffness(state, stiffness) * std::sin(state.phase)};
}

/// Coefficients (c, F0).
PartFit imaginary_part(const std::vector<Pair>& states, double stiffness) {
  return fit_states(states, [stiffness](const Pair& state) { return imaginary_row(state, stiffness); });
}

/// Error of the residual of the imaginary part for an error of the phasor of x, per metre, of equal size along x
/// and across it. Across x it rotates the real part into the imaginary part. Along x it changes both sides of the
/// equation, and c w/X remains.
double error_gain(const Pair& state, double c, double stiffness) {
  const double real = dynamic_stiffness(state, stiffness) * std::cos(state.phase);
  return std::hypot(real, c * state.omega) / fundamental(state);
}

/// The imaginary part with the states weighted by their errors, so that the residuals have equal variances.
PartFit weighted_part(const std::vector<Pair>& states, const std::vector<Pair>& weights, double c,
                      double stiffness) {
  std::size_t i = 0;
  return fit_states(states, [&](const Pair& state) -> Eigen::Vector3d {
    return imaginary_row(state, stiffness) / error_gain(weights[i++], c, stiffness);
  });
}

/// Coefficients (k, m).
PartFit real_part(const std::vector<Pair>& states, double stiffness) {
  return fit_states(states, [stiffness](const Pair& state) {
    return Eigen::Vector3d(1.0, -state.omega * state.omega,
                           dynamic_stiffness(state, stiffness) * std::cos(state.phase));
  });
}

std::optional<ParameterSet> receptance_parameters(const std::vector<Pair>& states,
                                                  const KnownConstants& constants) {
  const PartFit fit = imaginary_part(states, constants.stiffness);
  if (!fit.coefficients.allFinite()) return std::nullopt;
  return parameters(ForceParameters{constants.mass, fit.coefficients[0], constants.stiffness, fit.coefficients[1]});
}

/// Residuals of the weighted fit less those of harmonic balance on the exact motion at the estimate, which do not
/// count against the law.
Eigen::VectorXd weighted_residuals(const std::vector<Pair>& states, const ParameterSet& value,
                                   const KnownConstants& constants) {
  Eigen::VectorXd residuals = weighted_part(states, states, value.c, constants.stiffness).residuals;
  if (!(value.zeta > 0.0) || !(value.x_f >= 0.0)) return residuals;
  const std::vector<Pair> exact = exact_states(states, value, constants);
  if (exact.size() == states.size())
    residuals -= weighted_part(exact, states, value.c, constants.stiffness).residuals;
  return residuals;
}

/// The covariance is that of an unweighted fit to data of unequal errors; the size of the errors follows from the
/// weighted fit.
void set_estimate(const std::vector<Pair>& states, const PartFit& fit, const KnownConstants& constants,
                  Estimate& estimate) {
  const double c = fit.coefficients[0];
  const ForceParameters force{constants.mass, c, constants.stiffness, fit.coefficients[1]};
  estimate.value = parameters(force);
  const std::optional<Eigen::MatrixXd> unit = unit_covariance(fit.columns);
  if (fit.freedom() < 1.0 || !unit) return;
  Eigen::VectorXd gain(fit.residuals.size());
  for (Eigen::Index i = 0; i < gain.size(); ++i)
    gain[i] = error_gain(states[static_cast<std::size_t>(i)], c, constants.stiffness);
  const Eigen::MatrixXd scaled = gain.asDiagonal() * fit.columns * *unit;
  const double variance = weighted_residuals(states, estimate.value, constants).squaredNorm() / fit.freedom();
  const Eigen::Matrix2d of_fit = variance * (scaled.transpose() * scaled);
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  covariance(1, 1) = of_fit(0, 0);
  covariance(3, 3) = of_fit(1, 1);
  covariance(1, 3) = covariance(3, 1) = of_fit(0, 1);
  set_estimate(estimate, force, covariance, quantile95(fit.freedom()));
}

/// Stiffness and mass by the real part; harmonic balance alone makes errors of some percent in them.
void list_real_part(const std::vector<Pair>& states, const KnownConstants& constants, Estimate& estimate) {
  const PartFit fit = real_part(states, constants.stiffness);
  const double k = fit.coefficients[0];
  const double m = fit.coefficients[1];
  if (!(k > 0.0) || !(m > 0.0)) {
    estimate.warnings.emplace_back("the real part of the inverse receptance shows no stiffness and mass");
    return;
  }
  // In the real part the error by harmonics is larger than noise, so there is no interval.
  estimate.others.push_back({"stiffness", "N/m", k, std::nullopt, std::nullopt});
  estimate.others.push_back({"natural_frequency", "rad/s", std::sqrt(k / m), std::nullopt, std::nullopt});
  constexpr double largest = 0.1;
  if (std::abs(k / constants.stiffness - 1.0) > largest)
    estimate.warnings.push_back("the real part shows a stiffness " +
                                core::signed_percent(k / constants.stiffness - 1.0, 3) +
                                " off the known one: another spring, or phases with a lag");
}

/// |X/(k Y)| = A sin(phi) - B, hysteretic damping h = 1/A, as a line of 1 over the quantities measured.
struct Limacon {
  ParameterSet value;
  double c_std = 0.0;  ///< N.s/m
};

std::optional<Limacon> limacon_of(const std::vector<Pair>& states, const KnownConstants& constants) {
  std::vector<Datum> points;
  double force = 0.0;
  for (const Pair& state : states) {
    points.push_back({std::sin(state.phase), 1.0 / dynamic_stiffness(state, constants.stiffness), state.number});
    force += constants.stiffness * state.Y / static_cast<double>(states.size());
  }
  const std::optional<ForceLine> line = force_line(std::move(points), 1.0);
  if (!line || !(line->line.slope > 0.0) || line->freedom() < 1.0) return std::nullopt;
  const double omega_n = constants.natural_frequency();
  const double c = 1.0 / (line->line.slope * omega_n);
  const double variance = line->residuals.squaredNorm() / line->freedom() / line->moments.S_YY;
  return Limacon{
      parameters(ForceParameters{constants.mass, c, constants.stiffness,
                                 -coulomb_per_viscous * force * line->line.intercept / line->line.slope}),
      c * std::sqrt(variance) / line->line.slope};
}

/// The limacon of one input amplitude. Its bias is large if phases vary little, so it is compared with the limacon
/// of the exact motion at the estimate.
void list_limacon(const std::vector<Pair>& states, const KnownConstants& constants, Estimate& estimate) {
  const auto [least, greatest] = std::ranges::minmax_element(states, {}, &Pair::Y);
  constexpr double constant = 0.01;
  if (std::isnan(constants.mass) || greatest->Y - least->Y > constant * greatest->Y) return;
  const std::optional<Limacon> limacon = limacon_of(states, constants);
  if (!limacon) return;
  estimate.subsets.push_back({"limacon", static_cast<int>(states.size()), limacon->value});
  if (!(estimate.value.zeta > 0.0) || !(estimate.value.x_f >= 0.0)) return;
  const std::vector<Pair> exact = exact_states(states, estimate.value, constants);
  const std::optional<Limacon> own = exact.size() == states.size() ? limacon_of(exact, constants) : std::nullopt;
  constexpr double deviations = 4.0;
  constexpr double fraction = 0.1;
  if (!own) return;
  const double expected = own->value.c;
  if (std::abs(limacon->value.c - expected) <= std::max(fraction * expected, deviations * limacon->c_std)) return;
  const std::string unit = " " + constants.unit("N.s/m");
  estimate.warnings.push_back("the limacon gives c = " + core::format_number(limacon->value.c, 4) + unit +
                              " where the estimate's own would give " + core::format_number(expected, 4) + unit +
                              ": damping, sticking or the phases are not what the method assumes");
}

/// A friction that grows with the amplitude adds w^2 X to the imaginary part.
void test_amplitude(const std::vector<Pair>& states, const KnownConstants& constants, Estimate& estimate) {
  const double c = estimate.value.c;
  const PartFit fit = weighted_part(states, states, c, constants.stiffness);
  const Eigen::VectorXd residuals = weighted_residuals(states, estimate.value, constants);
  Eigen::VectorXd term(residuals.size());
  for (Eigen::Index i = 0; i < term.size(); ++i) {
    const Pair& state = states[static_cast<std::size_t>(i)];
    term[i] = state.omega * state.omega * fundamental(state) / error_gain(state, c, constants.stiffness);
  }
  const Eigen::VectorXd values = fit.columns * fit.coefficients + fit.residuals;
  estimate.lack_of_fit = added_term_test(fit.columns, residuals, term, values.maxCoeff() - values.minCoeff(),
                                         "quadratic friction F-test");
  if (estimate.lack_of_fit && estimate.lack_of_fit->fired)
    estimate.findings.emplace_back("the imaginary part is not that of Coulomb and viscous friction");
}

bool enough(const std::vector<Pair>& states, Estimate& estimate) {
  std::vector<double> frequencies;
  for (const Pair& state : states)
    if (std::ranges::none_of(frequencies, [&](double w) { return is_same_frequency(state.omega, w); }))
      frequencies.push_back(state.omega);
  if (frequencies.size() >= 3) return true;
  std::string reason = "phases at three frequencies are needed, and " + std::to_string(frequencies.size()) +
                       (frequencies.size() == 1 ? " is" : " are") + " left";
  if (!estimate.excluded.empty())
    reason +=
        "; pair " + std::to_string(estimate.excluded.front().number) + ": " + estimate.excluded.front().reason;
  refuse(estimate, std::move(reason));
  return false;
}

/// Why the record has no phases at three frequencies; empty when it has.
std::string lacks_receptance(const Record& record) {
  if (std::string lack = lacks_phases(record); !lack.empty()) return lack;
  constexpr std::size_t least = 3;
  std::vector<double> frequencies;
  for (const Pair& pair : record.pairs->pairs)
    if (frequencies.size() < least && !std::isnan(pair.omega) && !std::isnan(pair.phase) &&
        std::ranges::find(frequencies, pair.omega) == frequencies.end())
      frequencies.push_back(pair.omega);
  return frequencies.size() >= least ? "" : "the pairs with phases are at fewer than three frequencies";
}

}  // namespace

Estimate receptance(const Record& record, const KnownConstants& constants) {
  Estimate estimate;
  estimate.method = receptance_method.name;
  if (std::string lack = lacks_receptance(record); !lack.empty()) {
    refuse(estimate, std::move(lack));
    return estimate;
  }
  std::optional<std::vector<Pair>> states = take_states(record, constants, true, estimate);
  if (!states) return estimate;
  PartFit fit;
  do {
    if (!enough(*states, estimate)) return estimate;
    fit = imaginary_part(*states, constants.stiffness);
    estimate.value = receptance_parameters(*states, constants).value_or(ParameterSet{});
  } while (drop_sticking(*states, estimate.value, constants, estimate));
  if (!fit.coefficients.allFinite()) {
    refuse(estimate, "these outputs do not distinguish c from F0");
    return estimate;
  }
  set_estimate(*states, fit, constants, estimate);
  for (const Pair& state : *states) estimate.used.push_back(state.number);

  std::vector<std::string> faults;
  judge_force_signs(estimate, constants.stiffness / states->front().omega, constants.stiffness * states->front().x,
                    faults);
  test_amplitude(*states, constants, estimate);
  judge_own_reading(
      *states, constants, [&](const auto& exact) { return receptance_parameters(exact, constants); },
      "because the motion is not harmonic", estimate, faults);
  list_real_part(*states, constants, estimate);
  list_limacon(*states, constants, estimate);
  conclude(estimate, faults,
           "rests on " + std::to_string(states->size()) + " of " + std::to_string(record.pairs->pairs.size()) +
               " steady states");
  return estimate;
}

constinit const MethodEntry receptance_method{
    .name = "receptance",
    .summary = "viscous damping and friction force from amplitude and phase over frequency",
    .assumes =
        "harmonic balance, no sticking, a true phase; checked: sticking pairs are left out, linear term F-test, the "
        "bias of harmonic balance at the estimate, the limacon where the input was constant",
    .equation = "Im(k Y/X exp(i phi)) = c w + 4 F0/(pi X); Re = k - m w^2",
    .sources = "tomlinson1980",
    .needs = RecordKind::phases,
    .lacks = lacks_receptance,
    .call = call_of<receptance>,
    .rests_on = AssumptionSet::all_but(Assumption::spring, Assumption::one_mode, Assumption::symmetry),
};

}  // namespace dualdamp::identify
