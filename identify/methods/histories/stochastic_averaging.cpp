#include "identify/methods/histories/stochastic_averaging.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/records/usable_histories.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/uncertainty/parametric_bootstrap.hpp"
#include "identify/uncertainty/random_response.hpp"

namespace dualdamp::identify {

namespace {

/// Means of A^n under p(A) = A exp(-alpha A - beta A^2)/Z, n = 0 ... 6.
std::array<double, 7> moments(const Eigen::Vector2d& p) {
  const double alpha = p[0], beta = p[1];
  // Beyond this the exponent is below -60, wherever its maximum lies.
  constexpr double far = 60.0;
  const double end = (-alpha + std::sqrt(alpha * alpha + 4.0 * beta * far)) / (2.0 * beta);
  constexpr int cells = 600;
  std::array<double, 7> sums{};
  for (int i = 1; i < cells; ++i) {  // the integrand is 0 at both ends: the trapezoidal rule is accurate
    const double A = end * i / cells;
    double weight = A * std::exp(-alpha * A - beta * A * A);
    for (double& sum : sums) {
      sum += weight;
      weight *= A;
    }
  }
  for (std::size_t n = 1; n < sums.size(); ++n) sums[n] /= sums[0];
  sums[0] = 1.0;
  return sums;
}

/// Covariance of (A, A^2) under p.
Eigen::Matrix2d information(const std::array<double, 7>& m) {
  Eigen::Matrix2d I;
  I << m[2] - m[1] * m[1], m[3] - m[1] * m[2], m[3] - m[1] * m[2], m[4] - m[2] * m[2];
  return I;
}

/// (alpha, beta) whose means of A and A^2 are those given, A in units of its rms; Newton's method on a convex
/// function. Nothing when beta tends to zero, without viscous friction.
std::optional<Eigen::Vector2d> match(double mean, double square) {
  Eigen::Vector2d p(0.0, 1.0 / square);
  for (int step = 0; step < 100; ++step) {
    const std::array<double, 7> m = moments(p);
    const Eigen::Vector2d excess(m[1] - mean, m[2] - square);
    Eigen::Vector2d move = information(m).inverse() * excess;
    while (p[1] + move[1] <= 0.2 * p[1]) move *= 0.5;
    p += move;
    if (p[1] < 1e-4 / square) return std::nullopt;
    if (move.norm() < 1e-12 * p.norm()) return p;
  }
  return std::nullopt;
}

/// Means of A, A^2, A^3 over the blocks of the record.
struct Blocks {
  static constexpr int count = 40;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the mean
};

Blocks blocks_of(const std::vector<double>& amplitude) {
  Blocks blocks;
  std::vector<Eigen::Vector3d> means;
  for (std::size_t b = 0; b < Blocks::count; ++b) {
    const std::size_t begin = b * amplitude.size() / Blocks::count;
    const std::size_t end = (b + 1) * amplitude.size() / Blocks::count;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = begin; i < end; ++i) {
      const double A = amplitude[i];
      sum += Eigen::Vector3d(A, A * A, A * A * A);
    }
    means.emplace_back(sum / static_cast<double>(end - begin));
    blocks.mean += means.back() / Blocks::count;
  }
  for (const Eigen::Vector3d& mean : means)
    blocks.covariance +=
        (mean - blocks.mean) * (mean - blocks.mean).transpose() / (Blocks::count * (Blocks::count - 1.0));
  return blocks;
}

/// D: twice the mean power of y and force on the mass, over m.
double intensity_from_work(const History& history, const KnownConstants& constants) {
  const auto drive = [&](std::size_t i) { return constants.stiffness * history.y_at(i) + history.force_at(i); };
  double work = 0.0;
  const std::size_t n = history.x.size();
  for (std::size_t i = 0; i + 1 < n; ++i)
    work += 0.5 * (drive(i) + drive(i + 1)) * (history.x[i + 1] - history.x[i]);
  return 2.0 * work * history.sample_rate / (static_cast<double>(n - 1) * constants.mass);
}

/// Increments of the velocity over `stride` samples, less those by the spring. Differences of x are means of v,
/// whose increments have two thirds of the variance.
double intensity_from_increments(const History& history, const KnownConstants& constants, std::size_t stride) {
  const double dt = static_cast<double>(stride) / history.sample_rate;
  const double stiffness = constants.stiffness / constants.mass;
  const std::vector<double>&x = history.x, &v = history.v;
  const bool measured = !v.empty();
  double sum = 0.0;
  for (std::size_t i = stride; i + stride < x.size(); ++i) {
    const double increment = measured ? v[i + stride] - v[i] : (x[i + stride] - 2.0 * x[i] + x[i - stride]) / dt;
    const double position = measured ? 0.5 * (x[i] + x[i + stride]) : x[i];
    const double random = increment + stiffness * position * dt;
    sum += random * random;
  }
  return (measured ? 1.0 : 1.5) * sum / (dt * static_cast<double>(x.size() - 2 * stride));
}

/// The variance of increments of a white acceleration grows as their duration; of a smoother one it grows faster,
/// of noisy signals more slowly.
bool increments_are_white(const History& history, const KnownConstants& constants, double D) {
  constexpr double tolerance = 0.2;
  return std::abs(intensity_from_increments(history, constants, 2) / D - 1.0) < tolerance;
}

bool driven(const History& history) {
  const auto moves = [](const std::vector<double>& signal) {
    return std::ranges::any_of(signal, [](double value) { return value != 0.0; });
  };
  return moves(history.y) || moves(history.force);
}

/// The third moment of A against that of p, as a t test over the blocks.
LackOfFit third_moment_test(const Blocks& blocks, const std::array<double, 7>& m) {
  // Derivatives of the third moment with respect to the first two, through alpha and beta.
  const Eigen::RowVector2d by_parameters(-(m[4] - m[1] * m[3]), -(m[5] - m[2] * m[3]));
  const Eigen::RowVector2d by_moments = -by_parameters * information(m).inverse();
  const Eigen::RowVector3d test_of(-by_moments[0], -by_moments[1], 1.0);
  const double excess = blocks.mean[2] - m[3];
  const double variance = test_of.dot((blocks.covariance * test_of.transpose()).transpose());
  LackOfFit test;
  test.test = "third moment of the amplitude t-test";
  test.freedom = Blocks::count - 1;
  test.statistic = excess * excess / variance;
  test.p_value = f_test_p_value(test.statistic, 1.0, test.freedom);
  test.effect = std::abs(excess) / m[3];
  test.level = 0.01;
  test.least_effect = 0.02;
  test.fired = test.p_value < test.level && test.effect > test.least_effect;
  return test;
}

void judge(double visible, Estimate& estimate, std::vector<std::string>& faults,
           std::vector<std::string>& warnings) {
  constexpr double invisible = 30.0;
  if (visible > invisible)
    faults.push_back("the spring's force is " + core::format_number(visible, 3) +
                     " times the Coulomb friction on average: it does not show in the amplitude");
  if (estimate.lack_of_fit->fired)
    estimate.findings.emplace_back("the amplitude is not distributed as Coulomb and viscous friction make it");
  constexpr double small = 0.05;
  if (estimate.value.zeta > small)
    warnings.emplace_back("averaging is for small damping: at this one the estimates are some per cent off");
}

/// Results of the method for one history, or why there are none.
struct Averages {
  std::string fault;
  bool by_work = false;  ///< D follows from the recorded drive
  double D = 0.0;        ///< m^2/s^3
  double unit = 0.0;     ///< rms of A [m], in units of which the blocks are
  Blocks blocks;
  std::array<double, 7> m{};
  ParameterReading reading;  ///< (m, c, k, F0), where mass and stiffness are constants; errors from the blocks
};

/// Amplitudes in units of their rms, which is stored in `unit`.
std::vector<double> amplitude_of(const History& history, double W, double& unit) {
  const PreparedHistory motion = prepared_history(history, 0.0);
  std::vector<double> amplitude(motion.x.size());
  double square = 0.0;
  for (std::size_t i = 0; i < amplitude.size(); ++i) {
    amplitude[i] = std::hypot(motion.x[i], motion.v[i] / W);
    square += amplitude[i] * amplitude[i];
  }
  unit = std::sqrt(square / static_cast<double>(amplitude.size()));
  for (double& A : amplitude) A /= unit;
  return amplitude;
}

Averages averages_of(const History& history, const KnownConstants& constants) {
  const double W = constants.natural_frequency();
  Averages averages;
  const std::vector<double> amplitude = amplitude_of(history, W, averages.unit);
  if (!(averages.unit > 0.0)) {
    averages.fault = "the mass does not move";
    return averages;
  }
  averages.blocks = blocks_of(amplitude);
  const std::optional<Eigen::Vector2d> p = match(averages.blocks.mean[0], averages.blocks.mean[1]);
  averages.by_work = driven(history);
  averages.D =
      averages.by_work ? intensity_from_work(history, constants) : intensity_from_increments(history, constants, 1);
  if (!p || !(averages.D > 0.0)) {
    averages.fault = p ? "the recorded drive does no work on the mass: it is not what excites it"
                       : "no viscous damping fits the distribution of the amplitude";
    return averages;
  }
  averages.m = moments(*p);
  const double to_F0 = std::numbers::pi * constants.mass * averages.D / (8.0 * W * averages.unit);
  const double to_c = constants.mass * averages.D / (W * W * averages.unit * averages.unit);
  const Eigen::Matrix2d inverse = information(averages.m).inverse();
  const Eigen::Matrix2d of_p = inverse * averages.blocks.covariance.topLeftCorner<2, 2>() * inverse;
  averages.reading.parameters =
      Eigen::Vector4d(constants.mass, to_c * (*p)[1], constants.stiffness, to_F0 * (*p)[0]);
  averages.reading.errors = Eigen::Vector4d(0.0, to_c * std::sqrt(of_p(1, 1)), 0.0, to_F0 * std::sqrt(of_p(0, 0)));
  return averages;
}

/// Spread of the estimates from other random responses of a mass with the estimated friction.
std::optional<BootstrapSpread> spread_of(const History& history, const Averages& averages,
                                         const KnownConstants& constants) {
  Eigen::VectorXd truth = averages.reading.parameters.cwiseMax(0.0);
  const RandomResponse response{history, {truth[0], truth[1], truth[2], truth[3]}, averages.D};
  const auto again = [&](const Record& drawn) -> std::optional<ParameterReading> {
    const Averages other = averages_of(drawn.histories.front(), constants);
    return other.fault.empty() ? std::optional(other.reading) : std::nullopt;
  };
  constexpr int records = 20;  // each is long
  std::optional<BootstrapSpread> spread = bootstrap_spread(
      averages.reading, truth, [&](int number) { return response.record(number); }, again, records);
  if (spread) spread->covariance *= response.share();
  return spread;
}

}  // namespace

Estimate stochastic_averaging(const Record& record, const KnownConstants& constants) {
  Estimate estimate;
  estimate.method = stochastic_averaging_method.name;
  const std::optional<NumberedHistory> longest =
      longest_history(record, constants, estimate, UnmeasuredDrive::noise);
  if (!longest) return estimate;
  const auto& [number, history] = *longest;
  const double W = constants.natural_frequency();
  const double periods = static_cast<double>(history->x.size()) / history->sample_rate * W / core::two_pi;
  constexpr double fewest = 400.0;
  if (periods < fewest) {
    refuse(estimate, "a random response of at least 400 natural periods is needed, and there are " +
                         core::format_number(periods, 3));
    return estimate;
  }
  const double samples = static_cast<double>(history->x.size()) / periods;
  constexpr double coarsest = 8.0;
  if (samples < coarsest) {
    refuse(estimate, "the amplitude needs at least 8 samples in a natural period, and there are " +
                         core::format_number(samples, 3));
    return estimate;
  }
  const Averages averages = averages_of(*history, constants);
  if (!averages.fault.empty()) {
    refuse(estimate, averages.fault);
    return estimate;
  }
  const Eigen::VectorXd& p = averages.reading.parameters;
  const ForceParameters force{p[0], p[1], p[2], p[3]};
  set_estimate(estimate, force, spread_of(*history, averages, constants));
  estimate.used = {number};
  estimate.others.push_back({"intensity", "m^2/s^3", averages.D, std::nullopt, std::nullopt});
  estimate.lack_of_fit = third_moment_test(averages.blocks, averages.m);
  std::vector<std::string> faults;
  judge_force_signs(estimate, 0.0, 0.0, faults);
  if (!averages.by_work && !increments_are_white(*history, constants, averages.D))
    faults.emplace_back(
        "the excitation is not white up to the sample rate, so its intensity is not known: record it");
  const double x_rms = averages.unit / std::numbers::sqrt2;
  judge(constants.stiffness * x_rms / std::abs(force.F0), estimate, faults, estimate.warnings);
  conclude(estimate, faults, "rests on " + core::format_number(std::floor(periods), 6) + " natural periods");
  return estimate;
}

constinit const MethodEntry stochastic_averaging_method{
    .name = "stochastic_averaging",
    .summary = "friction from the distribution of the amplitude of a random response",
    .assumes =
        "long stationary response to an excitation that is white about the natural frequency, small damping; checked: "
        "third moment of the amplitude, friction against the spring's force",
    .equation = "p(A) = A exp(-alpha A - beta A^2)/Z, F0 = pi m D alpha/(8 W), c = m D beta/W^2",
    .sources = "liang2004identifying, roberts1986",
    .needs = RecordKind::history,
    .lacks = lacks_histories,
    .call = call_of<stochastic_averaging>,
    .rests_on = AssumptionSet::all_but(Assumption::drive),
};

}  // namespace dualdamp::identify
