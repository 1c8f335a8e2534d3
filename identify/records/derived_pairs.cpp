#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "core/angle.hpp"
#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/records/sine_fit.hpp"
#include "identify/validate.hpp"

namespace dualdamp::identify {

namespace {

constexpr int most_harmonics = 9;
constexpr int most_blocks = 24;
/// With residuals above this share of the amplitude, a signal is no steady state at this frequency.
constexpr double most_residual = 0.2;
/// A harmonic of the base above this share of the fundamental gets a warning.
constexpr double notable_distortion = 0.02;
/// A relative drift of the amplitude above this gets a warning.
constexpr double notable_drift = 0.005;
/// With a drift above this, the motion is no steady state.
constexpr double most_drift = 0.02;
/// A relative change of the amplitude below this has no effect on any method.
constexpr double settled = 1e-6;
/// A stated frequency that is off by more than this share is no rounded one.
constexpr double most_detuning = 0.01;

std::string percent_text(double share) {
  constexpr int digits = 2;
  return core::percent(share, digits);
}

/// Number of harmonics below 0.9 of half the sample rate, at most `most`.
int harmonics_within(double omega, double sample_rate, int most) {
  constexpr double room = 0.9;
  return std::clamp(static_cast<int>(room * std::numbers::pi * sample_rate / omega), 1, most);
}

std::string_view sweep_of(std::string_view label) {
  const std::size_t cut = label.rfind('/');
  return cut == std::string_view::npos ? std::string_view{} : label.substr(0, cut);
}

/// The steady part of a history: `size` samples from `first` on, whole periods.
struct SteadyPart {
  std::size_t first = 0;
  std::size_t size = 0;
  double drift = 0.0;        ///< of the amplitude from the first to the last block, relative
  double drift_error = 0.0;  ///< standard deviation of the drift by noise

  [[nodiscard]] bool drifts() const { return std::abs(drift) > std::max(notable_drift, 4.0 * drift_error); }
};

/// The fundamental of one piece as a complex number, with its phase at the first sample of the record.
struct Phasor {
  double cos = 0.0;
  double sin = 0.0;
  double std = 0.0;

  [[nodiscard]] double distance(const Phasor& other) const { return std::hypot(cos - other.cos, sin - other.sin); }
  [[nodiscard]] double size() const { return std::hypot(cos, sin); }
};

/// Largest distance of a piece from the mean of the late pieces that noise alone causes, except in one of 5000
/// histories.
///
/// The distance has two components, each of variance s^2 (1 + 1/L) for L late pieces. If s is the scatter of the
/// late pieces, the square of the distance over 2 s^2 (1 + 1/L) has the distribution F(2, n), n = 2 (L - 1); it
/// exceeds (n/2)(p^(-2/n) - 1) with probability p. A few late pieces give a poor estimate of s. If their scatter
/// agrees with that of white noise, the residuals of the fits give a better one: n = infinity, limit -ln p. For
/// slower noise, only the scatter can be used.
double reach_of_noise(std::span<const Phasor> late, const Phasor& mean) {
  constexpr double p = 1e-4;  // for each of the two estimates
  constexpr double alike = 4.0;
  const auto count = static_cast<double>(late.size());
  double scatter = 0.0;
  double white = 0.0;
  for (const Phasor& phasor : late) {
    scatter += phasor.distance(mean) * phasor.distance(mean);
    white += phasor.std * phasor.std / count;
  }
  double square = -std::log(p) * white;
  if (late.size() > 1) {
    const double freedom = 2.0 * (count - 1.0);
    const double by_scatter = scatter / freedom * 0.5 * freedom * (std::pow(p, -2.0 / freedom) - 1.0);
    square = scatter / freedom < alike * white ? std::min(square, by_scatter) : by_scatter;
  }
  return std::sqrt(2.0 * (1.0 + 1.0 / count) * square);
}

Phasor mean_of(std::span<const Phasor> phasors) {
  Phasor mean;
  for (const Phasor& phasor : phasors) {
    mean.cos += phasor.cos / static_cast<double>(phasors.size());
    mean.sin += phasor.sin / static_cast<double>(phasors.size());
  }
  return mean;
}

/// Splits a history into pieces of whole periods. The transient are the pieces at the beginning whose distance from
/// the mean of the second half is larger than noise explains.
std::optional<SteadyPart> steady_part(const History& history, double omega) {
  const std::span<const double> x = history.x;
  const double period = core::two_pi / omega * history.sample_rate;
  constexpr double rounding = 1e-9;
  const auto periods = static_cast<int>(static_cast<double>(x.size()) / period * (1.0 + rounding));
  if (periods < 1) return std::nullopt;
  const int periods_a_block = (periods + most_blocks - 1) / most_blocks;
  const int blocks = periods / periods_a_block;
  const int harmonics = harmonics_within(omega, history.sample_rate, 3);
  const auto samples_of = [&](int count) {
    return std::min(static_cast<std::size_t>(std::ceil(count * periods_a_block * period * (1.0 - rounding))),
                    x.size());
  };
  // No piece may be shorter than its periods, so the last piece may begin one sample early.
  const std::size_t size = samples_of(1);
  const auto begin = [&](int block) {
    return std::min(static_cast<std::size_t>(std::llround(block * periods_a_block * period)), x.size() - size);
  };
  std::vector<Phasor> phasors;
  for (int block = 0; block < blocks; ++block) {
    const std::size_t first = begin(block);
    const SineFit fit = fit_sine(x.subspan(first, size), history.sample_rate, omega, {.harmonics = harmonics});
    if (!fit.outcome.ok()) return std::nullopt;
    const double phase = fit.harmonics[0].phase - omega * static_cast<double>(first) / history.sample_rate;
    const double amplitude = fit.harmonics[0].amplitude;
    phasors.push_back({amplitude * std::cos(phase), amplitude * std::sin(phase), fit.harmonics[0].amplitude_std});
  }
  const std::size_t half = phasors.size() / 2;
  const std::span<const Phasor> late = std::span(phasors).subspan(half);
  const Phasor mean = mean_of(late);
  const double tolerance = std::max(reach_of_noise(late, mean), settled * mean.size());
  std::size_t skipped = 0;
  while (skipped < half && phasors[skipped].distance(mean) > tolerance) ++skipped;

  const auto part_from = [&](std::size_t first) {
    SteadyPart part;
    part.first = begin(static_cast<int>(first));
    part.size = std::min(x.size() - part.first, samples_of(blocks - static_cast<int>(first)));
    const Phasor& early = phasors[first];
    part.drift = (phasors.back().size() - early.size()) / mean.size();
    part.drift_error = std::hypot(phasors.back().std, early.std) / mean.size();
    return part;
  };
  SteadyPart part = part_from(skipped);
  // If the second half still settles, its mean is no reference. The first half of the rest is then skipped, until
  // the rest does not settle. An even drift is no settling.
  constexpr std::size_t fewest = 4;
  constexpr double slower = 2.0;
  while (part.drifts() && phasors.size() - skipped >= fewest) {
    const std::size_t middle = skipped + (phasors.size() - skipped) / 2;
    const double before = std::abs(phasors[middle].size() - phasors[skipped].size());
    if (before < slower * std::abs(phasors.back().size() - phasors[middle].size())) break;
    skipped = middle;
    part = part_from(skipped);
  }
  return part;
}

class PairReader {
 public:
  PairReader(const History& history, std::size_t index, DerivedPairs& result)
      : history_(history),
        name_(history.sweep.empty() ? "history " + std::to_string(index + 1) : "history '" + history.sweep + "'"),
        warnings_(result.warnings),
        lacking_(result.lacking.emplace_back()) {}

  std::optional<Pair> read(double frequency) {
    if (history_.x.empty() || history_.y.empty()) return std::nullopt;
    if (const std::string fault = shape_fault(history_); !fault.empty()) return nothing(fault);
    const SineFit drive = drive_fit(frequency);
    if (!drive.outcome.ok()) return nothing(drive.outcome.reason);
    if (std::abs(drive.omega / frequency - 1.0) > most_detuning)
      return nothing("it is not a steady state at the frequency stated: " + frequencies(drive.omega, frequency) +
                     ", " + percent_text(std::abs(drive.omega / frequency - 1.0)) + " away where at most " +
                     percent_text(most_detuning) + " is taken for rounding");
    const auto steady = steady_part(history_, drive.omega);
    if (!steady) return nothing("it holds no whole period");
    if (steady->drifts() && std::abs(steady->drift) > most_drift)
      return nothing("the amplitude of x still changes by " + percent_text(steady->drift) + " at its end");

    const auto cut = [&steady](const std::vector<double>& signal) {
      return std::span<const double>(signal).subspan(steady->first, steady->size);
    };
    const SineFit y = fit(cut(history_.y), drive.omega, 3);
    const SineFit x = fit(cut(history_.x), drive.omega, most_harmonics);
    if (!x.outcome.ok() || !y.outcome.ok()) return nothing("its periods are too short to fit");
    if (is_other(y) || is_other(x)) return nothing("it is not a steady state at the frequency of the drive");
    Pair pair;
    pair.Y = y.harmonics[0].amplitude;
    pair.x = half_peak_to_peak(x);
    pair.omega = drive.omega;
    pair.fundamental = x.harmonics[0].amplitude;
    pair.phase = core::wrapped(y.harmonics[0].phase - x.harmonics[0].phase);
    pair.mean_square_speed = mean_square_speed(x, cut);
    pair.sweep = sweep_of(history_.sweep);
    diagnose(y, *steady, drive.omega);
    return pair;
  }

 private:
  std::optional<Pair> nothing(const std::string& reason) {
    lacking_ = name_ + " gives no x-Y pair: " + reason;
    warnings_.push_back(lacking_);
    return std::nullopt;
  }

  [[nodiscard]] SineFit fit(std::span<const double> signal, double omega, int most, bool refine = false) const {
    // A short period may have fewer samples than the unknowns of all harmonics.
    const auto enough = static_cast<int>(std::max<std::size_t>(signal.size(), 5) - 3) / 2;
    const int harmonics = std::min(harmonics_within(omega, history_.sample_rate, most), enough);
    return fit_sine(signal, history_.sample_rate, omega, {.harmonics = harmonics, .refine = refine});
  }

  static std::string frequencies(double omega, double stated) {
    constexpr int digits = 6;
    return "the base moves at " + core::format_number(omega / core::two_pi, digits) + " Hz, not at " +
           core::format_number(stated / core::two_pi, digits) + " Hz";
  }

  /// The fit to y. A stated frequency is kept if it agrees with that of y within the error of the fit: in a short
  /// record it is the more exact one. Otherwise it is rounded, or the generator is off.
  SineFit drive_fit(double stated) {
    const double guess = guess_frequency(history_.y, history_.sample_rate);
    if (std::isnan(stated))
      return std::isnan(guess) ? fit_sine({}, history_.sample_rate, 1.0) : fit(history_.y, guess, 3, true);
    for (const double start : {stated, guess}) {
      if (std::isnan(start)) continue;
      SineFit free = fit(history_.y, start, 3, true);
      constexpr double errors = 3.0;
      if (!free.outcome.ok() || is_other(free)) continue;
      const double off = std::abs(free.omega - stated);
      if (off <= errors * free.omega_std) break;
      // A hundredth of a period over the record changes the amplitude by 2e-4.
      constexpr double notable = 0.01;
      const double duration = static_cast<double>(history_.y.size()) / history_.sample_rate;
      if (off * duration > notable * core::two_pi && off < most_detuning * stated)
        warnings_.push_back(name_ + ": " + frequencies(free.omega, stated) +
                            " as stated: its own frequency is used");
      return free;
    }
    return fit(history_.y, stated, 3);
  }

  static bool is_other(const SineFit& fit) { return !(fit.noise < most_residual * fit.harmonics[0].amplitude); }

  template <typename Cut>
  [[nodiscard]] double mean_square_speed(const SineFit& x, Cut cut) const {
    if (history_.v.empty()) return mean_square_derivative(x);
    const SineFit v = fit(cut(history_.v), x.omega, most_harmonics);
    double sum = 0.0;
    for (const Harmonic& harmonic : v.harmonics) sum += 0.5 * harmonic.amplitude * harmonic.amplitude;
    return sum;
  }

  void diagnose(const SineFit& y, const SteadyPart& steady, double omega) {
    for (std::size_t k = 1; k < y.harmonics.size(); ++k) {
      const double share = y.harmonics[k].amplitude / y.harmonics[0].amplitude;
      if (share > notable_distortion && y.harmonics[k].amplitude > 4.0 * y.harmonics[k].amplitude_std)
        warnings_.push_back(name_ + ": the base is not a pure sine, its harmonic " + std::to_string(k + 1) +
                            " has " + percent_text(share) + " of the fundamental");
    }
    if (steady.first > 0)
      warnings_.push_back(
          name_ + ": the first " +
          core::format_number(static_cast<double>(steady.first) / history_.sample_rate * omega / core::two_pi, 3) +
          " periods are left out: the motion was not yet steady");
    if (steady.drifts())
      warnings_.push_back(name_ + ": the amplitude of x still changes by " + percent_text(steady.drift) +
                          " over the periods used");
  }

  const History& history_;
  std::string name_;
  std::vector<std::string>& warnings_;
  std::string& lacking_;
};

}  // namespace

DerivedPairs pairs_of(const std::vector<History>& histories, double frequency) {
  DerivedPairs result;
  for (std::size_t i = 0; i < histories.size(); ++i) {
    auto pair = PairReader(histories[i], i, result).read(frequency);
    if (!pair) continue;
    pair->number = static_cast<int>(result.record.pairs.size()) + 1;
    result.record.pairs.push_back(std::move(*pair));
  }
  return result;
}

}  // namespace dualdamp::identify
