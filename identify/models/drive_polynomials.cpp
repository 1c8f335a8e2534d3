#include "identify/models/drive_polynomials.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/finer_samples.hpp"

namespace dualdamp::identify {

namespace {

/// The samples from one step to the next.
struct Section {
  std::size_t first, last;
};

std::vector<Section> sections_between(const std::vector<std::size_t>& steps, std::size_t count) {
  std::vector<Section> sections;
  std::size_t first = 0;
  for (const std::size_t step : steps) {
    sections.push_back({first, step});
    first = step + 1;
  }
  sections.push_back({first, count - 1});
  return sections;
}

/// Whether polynomials through eight samples miss a smooth drive between them, so that those through twelve are
/// nearer to it: they differ by more than 1e-5 of the drive, and those through four by ten times as much. With
/// noise, or at jumps, they do not.
bool needs_wide_polynomials(const std::vector<double>& samples, const std::vector<Section>& sections) {
  constexpr double half = 0.5;
  constexpr double least = 1e-5;
  constexpr double converging = 0.1;
  const WidePolynomial wide(half);
  const MiddlePolynomial<8> middle(half);
  const MiddlePolynomial<4> narrow(half);
  double squares = 0.0;
  double of_middle = 0.0;
  double of_narrow = 0.0;
  for (const Section& section : sections)
    for (std::size_t i = section.first + WidePolynomial::before; i + WidePolynomial::after <= section.last; ++i) {
      const double value = wide.between(samples, i);
      squares += value * value;
      of_middle += std::pow(middle.between(samples, i) - value, 2);
      of_narrow += std::pow(narrow.between(samples, i) - value, 2);
    }
  return of_middle > least * least * squares && of_middle < converging * converging * of_narrow;
}

/// Coefficients of the polynomial through eight places of an interval, both ends among them, from the twelve
/// samples around it. Of a polynomial through these samples it is as good as exact.
Eigen::Matrix<double, DrivePolynomials::nodes, WidePolynomial::count> coefficients_of_wide() {
  constexpr int nodes = DrivePolynomials::nodes;
  Eigen::Matrix<double, nodes, nodes> powers;
  Eigen::Matrix<double, nodes, WidePolynomial::count> values;
  for (int r = 0; r < nodes; ++r) {
    const double place = 0.5 - 0.5 * std::cos(std::numbers::pi * r / (nodes - 1));
    for (int c = 0; c < nodes; ++c) powers(r, c) = std::pow(place, c);
    const WidePolynomial wide(place);
    for (std::size_t c = 0; c < WidePolynomial::count; ++c) values(r, static_cast<int>(c)) = wide.weights()[c];
  }
  return inverse_of(powers) * values;
}

/// Polynomials through neighbouring samples.
class Interpolation {
 public:
  explicit Interpolation(const std::vector<double>& samples) : samples_(samples) {}

  /// Through those of a section that are nearest to an interval, at most so many.
  DrivePolynomials::Polynomial through_nearest(const Section& section, std::size_t interval, std::size_t most) {
    const std::size_t used = std::min(most, section.last - section.first + 1);
    const auto place = [](std::size_t sample) { return static_cast<std::ptrdiff_t>(sample); };
    const std::ptrdiff_t first = std::clamp(place(interval) - place(used) / 2 + 1, place(section.first),
                                            place(section.last) - place(used) + 1);
    const Eigen::MatrixXd& weights = weights_of(place(interval) - first, used);
    const auto size = static_cast<Eigen::Index>(used);
    const Eigen::VectorXd coefficients = weights * Eigen::Map<const Eigen::VectorXd>(samples_.data() + first, size);
    DrivePolynomials::Polynomial polynomial{};
    std::copy_n(coefficients.data(), used, polynomial.begin());
    return polynomial;
  }

 private:
  /// From the samples to the coefficients, where the interval begins at sample number `back` of these.
  const Eigen::MatrixXd& weights_of(std::ptrdiff_t back, std::size_t used) {
    if (back == laid_out_ && weights_.rows() == static_cast<Eigen::Index>(used)) return weights_;
    const auto size = static_cast<Eigen::Index>(used);
    Eigen::MatrixXd powers(size, size);
    for (Eigen::Index r = 0; r < size; ++r)
      for (Eigen::Index c = 0; c < size; ++c)
        powers(r, c) = std::pow(static_cast<double>(r - back), static_cast<double>(c));
    weights_ = inverse_of(powers);
    laid_out_ = back;
    return weights_;
  }

  const std::vector<double>& samples_;
  Eigen::MatrixXd weights_;
  std::ptrdiff_t laid_out_ = -1;
};

}  // namespace

DrivePolynomials::DrivePolynomials(const std::vector<double>& samples, const std::vector<std::size_t>& steps,
                                   std::size_t count)
    : all_(count - 1) {
  for (const std::size_t step : steps) after_[step] = {};
  if (samples.empty()) return;
  const std::vector<Section> sections = sections_between(steps, count);
  const bool is_wide = needs_wide_polynomials(samples, sections);
  const Eigen::Matrix<double, nodes, WidePolynomial::count> wide_weights = coefficients_of_wide();
  Interpolation interpolation(samples);
  constexpr std::size_t beside_step = 3;  // more samples carry their noise further
  for (const Section& section : sections) {
    if (section.first > 0)
      after_[section.first - 1] = interpolation.through_nearest(section, section.first - 1, beside_step);
    for (std::size_t i = section.first; i < section.last; ++i) {
      if (!is_wide || i < section.first + WidePolynomial::before || i + WidePolynomial::after > section.last) {
        all_[i] = interpolation.through_nearest(section, i, nodes);
        continue;
      }
      const Eigen::Map<const Eigen::Matrix<double, WidePolynomial::count, 1>> around(samples.data() + i -
                                                                                     WidePolynomial::before);
      const Eigen::Matrix<double, nodes, 1> coefficients = wide_weights * around;
      std::copy_n(coefficients.data(), nodes, all_[i].begin());
    }
    if (section.last + 1 < count)
      all_[section.last] = interpolation.through_nearest(section, section.last, beside_step);
  }
}

}  // namespace dualdamp::identify
