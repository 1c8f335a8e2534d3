#include "identify/fit/serial_test.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "identify/fit/residual_test.hpp"
#include "identify/record.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

/// The readings in order of their values; those within `tolerance` of the one before are at one place.
ReadingLine places_of(SamePlace readings, const std::vector<double>& values, double tolerance) {
  const auto value = [&](Eigen::Index i) { return values[static_cast<std::size_t>(i)]; };
  std::ranges::sort(readings, {}, value);
  ReadingLine places;
  double last = 0.0;
  for (const Eigen::Index i : readings) {
    if (places.empty() || value(i) > last * (1.0 + tolerance)) places.emplace_back();
    places.back().push_back(i);
    last = value(i);
  }
  return places;
}

/// Frequencies and levels of a generator are held to this, as in `is_same_frequency`.
constexpr double same_value = 1e-4;

/// A measured level scatters by some percent. Steps as small as that in a ladder of levels would join them all.
ReadingLine levels_of(const SamePlace& readings, const std::vector<double>& values) {
  constexpr double scatter = 0.05;
  constexpr double widest = 1.2;
  ReadingLine levels = places_of(readings, values, scatter);
  const auto is_wide = [&](const SamePlace& level) {
    const auto value = [&](Eigen::Index i) { return values[static_cast<std::size_t>(i)]; };
    return value(level.back()) > widest * value(level.front());
  };
  return std::ranges::any_of(levels, is_wide) ? places_of(readings, values, same_value) : levels;
}

double mean_of(const SamePlace& place, const Eigen::VectorXd& residuals) {
  double sum = 0.0;
  for (const Eigen::Index i : place) sum += residuals[i];
  return sum / static_cast<double>(place.size());
}

double squared_differences(const std::vector<ReadingLine>& lines, const Eigen::VectorXd& residuals) {
  const Eigen::VectorXd squares = residuals.cwiseAbs2();
  double sum = 0.0;
  for (const ReadingLine& line : lines)
    for (std::size_t g = 0; g < line.size(); ++g) {
      const double mean = mean_of(line[g], residuals);
      const double square = mean_of(line[g], squares);
      sum += 2.0 * static_cast<double>(line[g].size()) * (square - mean * mean);
      if (g + 1 < line.size())
        sum += square + mean_of(line[g + 1], squares) - 2.0 * mean * mean_of(line[g + 1], residuals);
    }
  return sum;
}

/// Diagonal of A, which has for each pair of readings at one place 2/m, of neighbours 1/(m m').
Eigen::VectorXd diagonal_of(const std::vector<ReadingLine>& lines, Eigen::Index count) {
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(count);
  for (const ReadingLine& line : lines)
    for (std::size_t g = 0; g < line.size(); ++g) {
      const auto m = static_cast<double>(line[g].size());
      const double neighbours = (g > 0 ? 1.0 : 0.0) + (g + 1 < line.size() ? 1.0 : 0.0);
      for (const Eigen::Index i : line[g]) diagonal[i] = (2.0 * (m - 1.0) + neighbours) / m;
    }
  return diagonal;
}

/// A: the matrix of the sum of the squared differences of neighbours.
Eigen::MatrixXd matrix_of_differences(const std::vector<ReadingLine>& lines, Eigen::Index count) {
  Eigen::MatrixXd matrix = diagonal_of(lines, count).asDiagonal();
  for (const ReadingLine& line : lines)
    for (std::size_t g = 0; g < line.size(); ++g) {
      const auto m = static_cast<double>(line[g].size());
      for (const Eigen::Index i : line[g]) {
        for (const Eigen::Index j : line[g])
          if (i != j) matrix(i, j) = -2.0 / m;
        if (g + 1 == line.size()) continue;
        for (const Eigen::Index j : line[g + 1])
          matrix(i, j) = matrix(j, i) = -1.0 / (m * static_cast<double>(line[g + 1].size()));
      }
    }
  return matrix;
}

/// The chance of a smaller d of many independent normal errors: mean tr A/n, variance 2 (n tr A^2 - (tr A)^2) /
/// (n^2 (n + 2)).
double normal_limit(const std::vector<ReadingLine>& lines, Eigen::Index count, double d) {
  const auto n = static_cast<double>(count);
  const Eigen::VectorXd diagonal = diagonal_of(lines, count);
  double square = diagonal.squaredNorm();
  for (const ReadingLine& line : lines)
    for (std::size_t g = 0; g < line.size(); ++g) {
      const auto m = static_cast<double>(line[g].size());
      square += 4.0 * (m - 1.0) / m;
      if (g + 1 < line.size()) square += 2.0 / (m * static_cast<double>(line[g + 1].size()));
    }
  const double trace = diagonal.sum();
  const double variance = 2.0 * (n * square - trace * trace) / (n * n * (n + 2.0));
  constexpr double nothing = 1e-9;
  if (!(variance > nothing / n)) return unknown;
  return 0.5 * std::erfc((trace / n - d) / std::sqrt(2.0 * variance));
}

double integrand(const Eigen::VectorXd& lambda, double u) {
  double angle = 0.0;
  double size = 0.0;
  for (const double value : lambda) {
    angle += 0.5 * std::atan(value * u);
    size += 0.25 * std::log1p(value * value * u * u);
  }
  return std::sin(angle) * std::exp(-size) / u;
}

}  // namespace

double chance_below_zero(const Eigen::VectorXd& lambda) {
  const double unit = 1.0 / lambda.cwiseAbs().maxCoeff();
  // Trapezoidal rule over w with u = unit e^w: the integrand falls exponentially on both sides.
  constexpr double reach = 40.0;
  constexpr int steps = 1600;
  constexpr double step = 2.0 * reach / steps;
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double u = unit * std::exp(-reach + step * i);
    sum += step * u * integrand(lambda, u);
  }
  return std::clamp(0.5 - sum * std::numbers::inv_pi, 0.0, 1.0);
}

Eigen::MatrixXd FitInfluence::covariance() const {
  const Eigen::MatrixXd cross = product(Q, T.transpose());
  return Eigen::MatrixXd::Identity(Q.rows(), Q.rows()) - cross - cross.transpose() + propagated(Q, gram);
}

std::vector<ReadingLine> lines_of(const Signal& signal, bool steady_states) {
  SamePlace all(signal.measured.size());
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  const double tolerance = steady_states ? same_value : 0.0;
  const std::vector<double>& beside = signal.companion.values;
  if (!steady_states || beside.empty()) return {places_of(std::move(all), signal.at, tolerance)};
  const ReadingLine levels = levels_of(all, beside);
  const ReadingLine frequencies = places_of(all, signal.at, same_value);
  const bool over_frequency = levels.size() <= frequencies.size();
  const ReadingLine& shorter = over_frequency ? levels : frequencies;
  // A level of its own for most readings, as in a sweep at constant acceleration: one line over the frequency.
  if (2 * shorter.size() > all.size()) return {frequencies};
  std::vector<ReadingLine> lines;
  for (const SamePlace& line : shorter)
    lines.push_back(places_of(line, over_frequency ? signal.at : beside, same_value));
  return lines;
}

double serial_p_value(const Eigen::VectorXd& residuals, const std::vector<ReadingLine>& lines,
                      const FitInfluence& influence) {
  const Eigen::Index count = residuals.size();
  constexpr double least_for_test = 3.5;
  if (static_cast<double>(count) - influence.Q.cwiseProduct(influence.T).sum() < least_for_test ||
      !(residuals.squaredNorm() > 0.0))
    return unknown;
  const double d = squared_differences(lines, residuals) / residuals.squaredNorm();
  constexpr Eigen::Index many = 400;
  if (count > many) return normal_limit(lines, count, d);
  const Eigen::MatrixXd differences =
      matrix_of_differences(lines, count) - d * Eigen::MatrixXd::Identity(count, count);
  const SymmetricSpectrum covariance = symmetric_spectrum(influence.covariance());
  const Eigen::MatrixXd root = covariance.matrix_with(covariance.values.cwiseMax(0.0).cwiseSqrt());
  const SymmetricSpectrum spectrum = symmetric_spectrum(product(product(root, differences), root));
  // Without neighbours, d has one value.
  constexpr double nothing = 1e-9;
  if (!(spectrum.values.cwiseAbs().maxCoeff() > nothing)) return unknown;
  return chance_below_zero(spectrum.values);
}

double serial_p_value(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& base) {
  ReadingLine line;
  for (Eigen::Index i = 0; i < residuals.size(); ++i) line.push_back({i});
  return serial_p_value(residuals, {line},
                        {.Q = base, .T = base, .gram = Eigen::MatrixXd::Identity(base.cols(), base.cols())});
}

SerialTest::SerialTest(const FitProblem& problem, const Eigen::VectorXd& unbounded, const Eigen::VectorXd& weights,
                       const Eigen::VectorXd& misses, const Eigen::MatrixXd& jacobian)
    : problem_(problem), misses_(misses), scores_(Eigen::VectorXd::Zero(misses.size())) {
  influence_.Q = influence_.T = Eigen::MatrixXd(misses.size(), 0);
  const auto is_tested = [&](const SignalRows& rows) { return !problem.readings().signal(rows).is_sampled; };
  if (std::ranges::none_of(problem.readings().signals(), is_tested)) return;
  Eigen::MatrixXd columns = unbounded.asDiagonal() * jacobian;
  for (Eigen::Index j = 0; j < columns.cols(); ++j)
    if (const double norm = columns.col(j).norm(); norm > 0.0) columns.col(j) /= norm;
  Eigen::MatrixXd within = columns;
  std::vector<Eigen::Index> bounded;
  for (Eigen::Index i = 0; i < misses.size(); ++i) {
    if (unbounded[i] > 0.0) scores_[i] = misses[i] * weights[i] * weights[i] / unbounded[i];
    constexpr double rounding = 1e-9;
    if (!(weights[i] < (1.0 - rounding) * unbounded[i])) continue;
    within.row(i).setZero();
    bounded.push_back(i);
  }
  constexpr double rounding = 1e-7;
  if (jacobian.cols() > 0) influence_.Q = orthonormal_basis(within, rounding);
  influence_.T = influence_.Q;
  if (influence_.Q.cols() > 0 && !bounded.empty()) {
    // The rows of `within` are those of Q, times Q^T within.
    const DependentColumns mix(product(within.transpose(), influence_.Q));
    const Eigen::MatrixXd rows = columns(bounded, Eigen::all);
    influence_.T(bounded, Eigen::all) = mix.solve_each(rows.transpose()).transpose();
  }
  influence_.gram = gram(influence_.T);
}

double SerialTest::p_value(const SignalRows& rows) const {
  const Signal& signal = problem_.readings().signal(rows);
  const ExperimentKind kind = problem_.readings().experiment(rows).kind;
  const Eigen::Index count = rows.size();
  const Eigen::VectorXd measured = problem_.readings().measured().segment(rows.begin, count);
  if (is_rounding(misses_.segment(rows.begin, count), measured)) return unknown;
  Eigen::VectorXd sides = Eigen::VectorXd::Ones(count);
  if (kind == ExperimentKind::decay && signal.name == "x")
    sides = (measured.array() < measured.mean()).select(-sides, sides);
  const FitInfluence own{.Q = sides.asDiagonal() * influence_.Q.middleRows(rows.begin, count),
                         .T = sides.asDiagonal() * influence_.T.middleRows(rows.begin, count),
                         .gram = influence_.gram};
  return serial_p_value(sides.cwiseProduct(scores_.segment(rows.begin, count)),
                        lines_of(signal, kind == ExperimentKind::steady_states), own);
}

}  // namespace dualdamp::identify
