#include "identify/statistics/finer_samples.hpp"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "sim/sampled_signal.hpp"

namespace dualdamp::identify {

namespace {

using Narrow = MiddlePolynomial<8>;

sim::SampledSignal spline_through(const std::vector<double>& samples) {
  std::vector<double> times(samples.size());
  std::iota(times.begin(), times.end(), 0.0);
  return {std::move(times), samples, sim::Interpolation::cubic};
}

double value_at(const sim::PolynomialPiece& piece, double s) {
  const auto& [y, slope, second, third] = piece.derivatives;
  return y + s * (slope + s * (second / 2.0 + s * third / 6.0));
}

double rms_about_mean(const std::vector<double>& samples) {
  const auto count = static_cast<double>(samples.size());
  const double mean = std::reduce(samples.begin(), samples.end()) / count;
  double square = 0.0;
  for (const double value : samples) square += (value - mean) * (value - mean);
  return std::sqrt(square / count);
}

}  // namespace

SplineError spline_error(const std::vector<double>& samples) {
  constexpr std::size_t fewest = 24;
  if (samples.size() < fewest) return {};
  const double size = rms_about_mean(samples);
  if (!(size > 0.0)) return {};
  const sim::SampledSignal spline = spline_through(samples);
  constexpr double half = 0.5;
  const WidePolynomial wide(half);
  const Narrow narrow(half);
  double miss = 0.0;
  double disagreement = 0.0;
  double count = 0.0;
  for (std::size_t i = WidePolynomial::before; i + WidePolynomial::after < samples.size(); ++i) {
    const double value = wide.between(samples, i);
    const double by_spline = value_at(spline.piece(static_cast<long>(i)), half) - value;
    const double by_narrow = narrow.between(samples, i) - value;
    miss += by_spline * by_spline;
    disagreement += by_narrow * by_narrow;
    count += 1.0;
  }
  return {std::sqrt(miss / count) / size, std::sqrt(disagreement / count) / size};
}

std::optional<FinerSamples> finer_samples(const std::vector<double>& samples) {
  constexpr double least = 4e-6;
  const SplineError error = spline_error(samples);
  if (!(error.miss > least) || !error.is_resolved()) return std::nullopt;
  constexpr double of_halves = 16.0;  // the error of the spline falls with the fourth power of the distance
  FinerSamples finer{.factor = error.miss > of_halves * least ? 4 : 2, .values = {}};
  std::vector<double> shares;
  std::vector<WidePolynomial> polynomials;
  for (int part = 1; part < finer.factor; ++part) {
    shares.push_back(static_cast<double>(part) / static_cast<double>(finer.factor));
    polynomials.emplace_back(shares.back());
  }
  const sim::SampledSignal spline = spline_through(samples);
  finer.values.reserve(static_cast<std::size_t>(finer.factor) * samples.size());
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    finer.values.push_back(samples[i]);
    const bool is_inside = i >= WidePolynomial::before && i + WidePolynomial::after < samples.size();
    for (std::size_t part = 0; part < shares.size(); ++part)
      finer.values.push_back(is_inside ? polynomials[part].between(samples, i)
                                       : value_at(spline.piece(static_cast<long>(i)), shares[part]));
  }
  finer.values.push_back(samples.back());
  return finer;
}

}  // namespace dualdamp::identify
