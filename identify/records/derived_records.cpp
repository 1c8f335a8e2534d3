#include "identify/records/derived_records.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "core/numbers.hpp"
#include "identify/records/sine_fit.hpp"

namespace dualdamp::identify {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr int most_harmonics = 9;
constexpr int most_blocks = 24;
/// Residuals above this share of the signal: it is no steady state at this frequency.
constexpr double most_residual = 0.2;
/// A harmonic of the base above this share of its fundamental is worth a word.
constexpr double notable_distortion = 0.02;
/// A drift of the amplitude over the cycles used that is worth a word.
constexpr double notable_drift = 0.005;
/// Below this a settling amplitude makes no difference to any method.
constexpr double settled = 1e-6;

std::string percent_text(double share) { return core::format_number(100.0 * share, 2) + " %"; }

/// Harmonics below half of the sample rate, with some room.
int harmonics_within(double omega, double sample_rate, int most) {
  constexpr double room = 0.9;
  return std::clamp(static_cast<int>(room * std::numbers::pi * sample_rate / omega), 1, most);
}

std::string_view sweep_of(std::string_view label) {
  const std::size_t cut = label.rfind('/');
  return cut == std::string_view::npos ? std::string_view{} : label.substr(0, cut);
}

/// The steady part of a history: samples from `first` on, whole cycles.
struct SteadyPart {
  std::size_t first = 0;
  std::size_t size = 0;
  double drift = 0.0;        ///< of the amplitude from the first to the last block, relative
  double drift_error = 0.0;  ///< what noise makes of it
};

/// The fundamental of one piece as a complex number at the first sample of the record.
struct Phasor {
  double cos = 0.0;
  double sin = 0.0;
  double std = 0.0;

  [[nodiscard]] double distance(const Phasor& other) const { return std::hypot(cos - other.cos, sin - other.sin); }
  [[nodiscard]] double size() const { return std::hypot(cos, sin); }
};

/// How far noise alone puts a piece from the mean of the late ones, but for one history in 5000.
///
/// Such a distance is that of two components, each of variance s^2 (1 + 1/L) for L late pieces: its square over
/// 2 s^2 (1 + 1/L) is F(2, n) distributed, n = 2 (L - 1), when s is the scatter of the late pieces, and exceeds
/// (n/2)(p^(-2/n) - 1) with probability p. Few late pieces know their scatter badly. Where it is what the residuals
/// of the fits make of white noise these know it better: n = infinity, -ln p. Slower noise has the scatter alone.
double reach_of_noise(std::span<const Phasor> late, const Phasor& mean) {
  constexpr double p = 1e-4;  // of each of the two ways
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

/// Pieces of whole cycles; those at the beginning that are farther from the second half's mean than noise puts them
/// are the transient.
std::optional<SteadyPart> steady_part(const History& history, double omega) {
  const std::span<const double> x = history.x;
  const double period = two_pi / omega * history.sample_rate;
  constexpr double rounding = 1e-9;
  const auto cycles = static_cast<int>(static_cast<double>(x.size()) / period * (1.0 + rounding));
  if (cycles < 1) return std::nullopt;
  const int cycles_a_block = (cycles + most_blocks - 1) / most_blocks;
  const int blocks = cycles / cycles_a_block;
  const int harmonics = harmonics_within(omega, history.sample_rate, 3);
  const auto samples_of = [&](int count) {
    return std::min(static_cast<std::size_t>(std::ceil(count * cycles_a_block * period * (1.0 - rounding))),
                    x.size());
  };
  // No piece may be shorter than its cycles: the last one begins a sample early rather.
  const std::size_t size = samples_of(1);
  const auto begin = [&](int block) {
    return std::min(static_cast<std::size_t>(std::llround(block * cycles_a_block * period)), x.size() - size);
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
  Phasor mean;
  for (const Phasor& phasor : late) {
    mean.cos += phasor.cos / static_cast<double>(late.size());
    mean.sin += phasor.sin / static_cast<double>(late.size());
  }
  const double tolerance = std::max(reach_of_noise(late, mean), settled * mean.size());
  std::size_t skipped = 0;
  while (skipped < half && phasors[skipped].distance(mean) > tolerance) ++skipped;

  SteadyPart part;
  part.first = begin(static_cast<int>(skipped));
  part.size = std::min(x.size() - part.first, samples_of(blocks - static_cast<int>(skipped)));
  const Phasor& early = phasors[skipped];
  part.drift = (phasors.back().size() - early.size()) / mean.size();
  part.drift_error = std::hypot(phasors.back().std, early.std) / mean.size();
  return part;
}

class PairReader {
 public:
  PairReader(const History& history, std::size_t index, std::vector<std::string>& warnings)
      : history_(history),
        name_(history.sweep.empty() ? "history " + std::to_string(index + 1) : "history '" + history.sweep + "'"),
        warnings_(warnings) {}

  std::optional<Pair> read(double frequency) {
    if (history_.x.empty() || history_.y.empty()) return std::nullopt;
    const SineFit drive = drive_fit(frequency);
    if (!drive.outcome.ok()) return nothing(drive.outcome.reason);
    const auto steady = steady_part(history_, drive.omega);
    if (!steady) return nothing("it holds no whole cycle");

    const auto cut = [&steady](const std::vector<double>& signal) {
      return std::span<const double>(signal).subspan(steady->first, steady->size);
    };
    const SineFit y = fit(cut(history_.y), drive.omega, 3);
    const SineFit x = fit(cut(history_.x), drive.omega, most_harmonics);
    if (!x.outcome.ok() || !y.outcome.ok()) return nothing("its cycles are too short to fit");
    if (is_other(y) || is_other(x)) return nothing("it is no steady state at the frequency of the drive");
    Pair pair;
    pair.Y = y.harmonics[0].amplitude;
    pair.x = half_peak_to_peak(x);
    pair.omega = drive.omega;
    pair.fundamental = x.harmonics[0].amplitude;
    pair.phase = std::remainder(y.harmonics[0].phase - x.harmonics[0].phase, two_pi);
    pair.mean_square_speed = mean_square_speed(x, cut);
    pair.sweep = sweep_of(history_.sweep);
    doubt(y, *steady, drive.omega);
    return pair;
  }

 private:
  std::optional<Pair> nothing(const std::string& reason) {
    warnings_.push_back(name_ + " gives no x-Y pair: " + reason);
    return std::nullopt;
  }

  [[nodiscard]] SineFit fit(std::span<const double> signal, double omega, int most, bool refine = false) const {
    // A single cycle may have as many samples as its harmonics have unknowns.
    const auto enough = static_cast<int>(std::max<std::size_t>(signal.size(), 5) - 3) / 2;
    const int harmonics = std::min(harmonics_within(omega, history_.sample_rate, most), enough);
    return fit_sine(signal, history_.sample_rate, omega, {.harmonics = harmonics, .refine = refine});
  }

  [[nodiscard]] SineFit drive_fit(double frequency) const {
    if (!std::isnan(frequency)) return fit(history_.y, frequency, 3);
    const double guess = guess_frequency(history_.y, history_.sample_rate);
    if (std::isnan(guess)) return fit_sine({}, history_.sample_rate, 1.0);
    return fit(history_.y, guess, 3, true);
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

  void doubt(const SineFit& y, const SteadyPart& steady, double omega) {
    for (std::size_t k = 1; k < y.harmonics.size(); ++k) {
      const double share = y.harmonics[k].amplitude / y.harmonics[0].amplitude;
      if (share > notable_distortion && y.harmonics[k].amplitude > 4.0 * y.harmonics[k].amplitude_std)
        warnings_.push_back(name_ + ": the base is no pure sine, its harmonic " + std::to_string(k + 1) + " has " +
                            percent_text(share) + " of the fundamental");
    }
    if (steady.first > 0)
      warnings_.push_back(
          name_ + ": the first " +
          core::format_number(static_cast<double>(steady.first) / history_.sample_rate * omega / two_pi, 3) +
          " cycles are left out: the motion was not yet steady");
    if (std::abs(steady.drift) > std::max(notable_drift, 4.0 * steady.drift_error))
      warnings_.push_back(name_ + ": the amplitude of x still changes by " + percent_text(steady.drift) +
                          " over the cycles used");
  }

  const History& history_;
  std::string name_;
  std::vector<std::string>& warnings_;
};

/// A turning point of the samples, before it is fitted.
struct Turn {
  std::size_t index = 0;
  bool at_rest = false;  ///< the mass is held or stays there
};

/// Standard deviation of white noise on a smooth signal, from its second differences.
double noise_of(std::span<const double> x) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const double second = x[i - 1] - 2.0 * x[i] + x[i + 1];
    sum += second * second;
  }
  return std::sqrt(sum / 6.0 / static_cast<double>(x.size() - 2));
}

/// Alternating extremes farther apart than `band`. The last one is the current candidate, not yet turned back from.
std::vector<std::size_t> zigzag(std::span<const double> x, double band) {
  std::vector<std::size_t> turns;
  std::size_t low = 0;
  std::size_t high = 0;
  int direction = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i] > x[high]) high = i;
    if (x[i] < x[low]) low = i;
    if (direction >= 0 && x[i] < x[high] - band) {
      turns.push_back(high);
      direction = -1;
      low = i;
    } else if (direction <= 0 && x[i] > x[low] + band) {
      turns.push_back(low);
      direction = 1;
      high = i;
    }
  }
  turns.push_back(direction > 0 ? high : low);
  return turns;
}

struct LocalFit {
  double value = 0.0;
  double std = 0.0;
  double sum_of_squares = 0.0;
  double slope = 0.0;
};

/// Least squares on samples [first, last) in u = (i - centre)/width; `fill(u, row)` writes the columns, the first
/// of which is 1.
template <typename Fill>
LocalFit local_fit(std::span<const double> x, std::size_t first, std::size_t last, double centre, double width,
                   Eigen::Index columns, Fill fill) {
  const auto n = static_cast<Eigen::Index>(last - first);
  Eigen::MatrixXd design(n, columns);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t sample = first + static_cast<std::size_t>(i);
    fill((static_cast<double>(sample) - centre) / width, design.row(i));
    values(i) = x[sample];
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(design);
  const Eigen::VectorXd solution = qr.solve(values);
  LocalFit fit;
  fit.value = solution(0);
  fit.slope = solution(1);
  fit.sum_of_squares = (values - design * solution).squaredNorm();
  const Eigen::MatrixXd R = qr.matrixQR().topRows(columns).triangularView<Eigen::Upper>();
  // The first row of the inverse of R is the first coefficient's.
  const Eigen::VectorXd row = R.transpose().triangularView<Eigen::Lower>().solve(Eigen::VectorXd::Unit(columns, 0));
  const double variance = fit.sum_of_squares / static_cast<double>(std::max<Eigen::Index>(n - columns - 1, 1));
  fit.std = std::sqrt(variance) * row.norm();
  return fit;
}

class DecayReader {
 public:
  explicit DecayReader(const History& history) : history_(history), x_(history.x) {}

  DerivedDecay run() {
    DerivedDecay result;
    constexpr std::size_t fewest = 16;
    if (x_.size() < fewest) return result;
    const auto [low, high] = std::minmax_element(x_.begin(), x_.end());
    constexpr double noises = 8.0;
    constexpr double rounding = 1e-9;
    band_ = std::max(noises * noise_of(x_), rounding * (*high - *low));
    const std::vector<std::size_t> turns = zigzag(x_, band_);
    if (turns.size() < 3) return result;
    // Of the swings between turning points, whose ends are known best, the median.
    std::vector<double> swings;
    for (std::size_t i = 2; i + 1 < turns.size(); ++i)
      swings.push_back(static_cast<double>(turns[i] - turns[i - 1]));
    const std::size_t begin = is_held(turns[0]) ? held_until() : turns[0];
    if (swings.empty()) swings.push_back(static_cast<double>(turns[1]) - static_cast<double>(begin));
    std::nth_element(swings.begin(), swings.begin() + static_cast<std::ptrdiff_t>(swings.size() / 2), swings.end());
    half_period_ = swings[swings.size() / 2];
    width_ = half_period_ / 4.0;
    constexpr double fewest_in_width = 8.0;
    if (width_ < fewest_in_width) return result;

    add_first(result, turns.front());
    for (std::size_t i = 0; i + 1 < turns.size(); ++i)
      if (turns[i] > 0 && !is_held(turns[i])) add(result, turns[i]);
    add_last(result, turns.back());
    if (!decays(result.record.extremes)) return {};
    return result;
  }

 private:
  void put(DerivedDecay& result, double index, double value, double std) const {
    result.record.times.push_back(history_.start + index / history_.sample_rate);
    result.record.extremes.push_back(value);
    result.standard_errors.push_back(std);
  }

  void put_mean(DerivedDecay& result, std::size_t first, std::size_t last, std::size_t index) const {
    const auto n = static_cast<double>(last - first);
    const double mean = std::reduce(x_.begin() + static_cast<std::ptrdiff_t>(first),
                                    x_.begin() + static_cast<std::ptrdiff_t>(last)) /
                        n;
    double square = 0.0;
    for (std::size_t i = first; i < last; ++i) square += (x_[i] - mean) * (x_[i] - mean);
    put(result, static_cast<double>(index), mean, std::sqrt(square / n / std::max(n - 1.0, 1.0)));
  }

  /// Samples at the beginning that stay where the first one is: the mass is held.
  [[nodiscard]] std::size_t held_until() const {
    std::size_t i = 0;
    while (i < x_.size() && std::abs(x_[i] - x_[0]) < band_) ++i;
    return i;
  }

  /// A turning point of the noise on the mass while it is held.
  [[nodiscard]] bool is_held(std::size_t turn) const { return turn < held_until(); }

  /// The position of release: that in which the mass is held, or the first sample where it starts from rest.
  void add_first(DerivedDecay& result, std::size_t first_turn) const {
    const std::size_t held = held_until();
    if (static_cast<double>(held) > 2.0 * width_) {
      put_mean(result, 0, held, held - 1);
      return;
    }
    if (static_cast<double>(first_turn) < 2.0 * width_ && first_turn > held) return;  // a turning point of its own
    const auto last = static_cast<std::size_t>(width_) + 1;
    if (last < 2 * std::size_t{start_columns} || x_.size() < 2 * last) return;
    const LocalFit fit = local_fit(x_, 0, last, 0.0, width_, start_columns, [](double u, auto row) {
      for (Eigen::Index k = 0; k < row.size(); ++k) row(k) = std::pow(u, static_cast<double>(k));
    });
    // A slope of 1 % of the largest costs the amplitude 5e-5 of itself.
    constexpr double least_slope = 0.01;
    const double swing = std::abs(x_[static_cast<std::size_t>(half_period_)] - x_[0]);
    if (std::abs(fit.slope) < least_slope * 0.5 * swing * std::numbers::pi / 4.0)
      put(result, 0.0, fit.value, fit.std);
  }

  /// The fit's value where its slope is zero, with cubes and fourth powers of its own on each side.
  void add(DerivedDecay& result, std::size_t turn) const {
    const auto reach = static_cast<std::size_t>(width_);
    const std::size_t first = turn > reach ? turn - reach : 0;
    const std::size_t last = std::min(turn + reach + 1, x_.size());
    if (last - first < 2 * std::size_t{turn_columns}) return;
    const auto at = [&](double centre) {
      return local_fit(x_, first, last, centre, width_, turn_columns, [](double u, auto row) {
        const Eigen::Index side = u < 0.0 ? 0 : 1;
        row.setZero();
        row(0) = 1.0;
        for (Eigen::Index k = 0; k < 3; ++k) row(1 + 2 * k + side) = std::pow(u, static_cast<double>(k + 2));
      });
    };
    const auto middle = static_cast<double>(turn);
    constexpr int bits = 26;
    const double centre = boost::math::tools::brent_find_minima([&](double c) { return at(c).sum_of_squares; },
                                                                middle - 0.3 * width_, middle + 0.3 * width_, bits)
                              .first;
    const LocalFit fit = at(centre);
    put(result, centre, fit.value, fit.std);
  }

  /// Where the mass stays to the end of the record.
  void add_last(DerivedDecay& result, std::size_t turn) const {
    std::size_t first = x_.size();
    while (first > 0 && std::abs(x_[first - 1] - x_.back()) < band_) --first;
    const bool rests = static_cast<double>(x_.size() - first) > half_period_;
    if (rests && first > 0 && turn + 1 >= first) put_mean(result, first, x_.size(), first);
  }

  /// Extremes of a free decay alternate, and their swings shrink.
  static bool decays(const std::vector<double>& extremes) {
    if (extremes.size() < 3) return false;
    double last = std::abs(extremes[1] - extremes[0]);
    for (std::size_t i = 2; i < extremes.size(); ++i) {
      const double swing = std::abs(extremes[i] - extremes[i - 1]);
      if (swing >= last) return false;
      last = swing;
    }
    return true;
  }

  static constexpr Eigen::Index start_columns = 5;
  static constexpr Eigen::Index turn_columns = 7;

  const History& history_;
  std::span<const double> x_;
  double band_ = 0.0;         ///< differences below it are noise [m]
  double half_period_ = 0.0;  ///< samples
  double width_ = 0.0;        ///< half of the samples of a local fit
};

}  // namespace

DerivedPairs pairs_of(const std::vector<History>& histories, double frequency) {
  DerivedPairs result;
  for (std::size_t i = 0; i < histories.size(); ++i) {
    auto pair = PairReader(histories[i], i, result.warnings).read(frequency);
    if (!pair) continue;
    pair->number = static_cast<int>(result.record.pairs.size()) + 1;
    result.record.pairs.push_back(std::move(*pair));
  }
  return result;
}

DerivedDecay decay_of(const History& history) { return DecayReader(history).run(); }

std::vector<std::string> complete(Record& record, double frequency) {
  if (record.pairs || record.decay || record.histories.empty()) return {};
  DerivedPairs driven = pairs_of(record.histories, frequency);
  if (!driven.record.pairs.empty()) {
    record.pairs = std::move(driven.record);
    return std::move(driven.warnings);
  }
  const History& only = record.histories.front();
  if (record.histories.size() == 1 && !only.x.empty() && only.force.empty() && only.y.empty()) {
    DerivedDecay decay = decay_of(only);
    if (!decay.record.extremes.empty()) record.decay = std::move(decay.record);
  }
  return {};
}

}  // namespace dualdamp::identify
