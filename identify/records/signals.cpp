#include "identify/records/signals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/constants.hpp"
#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "identify/validate.hpp"

namespace dualdamp::identify {

namespace {

using std::numbers::pi;

}  // namespace

std::vector<double> central_difference(std::span<const double> x, double sample_rate) {
  const std::size_t n = x.size();
  std::vector<double> v(n);
  if (n < 3) return v;
  for (std::size_t i = 1; i + 1 < n; ++i) v[i] = 0.5 * sample_rate * (x[i + 1] - x[i - 1]);
  v[0] = 0.5 * sample_rate * (-3.0 * x[0] + 4.0 * x[1] - x[2]);
  v[n - 1] = 0.5 * sample_rate * (3.0 * x[n - 1] - 4.0 * x[n - 2] + x[n - 3]);
  return v;
}

std::vector<double> second_difference(std::span<const double> x, double sample_rate) {
  const std::size_t n = x.size();
  std::vector<double> a(n);
  if (n < 3) return a;
  for (std::size_t i = 1; i + 1 < n; ++i) a[i] = sample_rate * sample_rate * (x[i + 1] - 2.0 * x[i] + x[i - 1]);
  a[0] = a[1];
  a[n - 1] = a[n - 2];
  return a;
}

std::vector<double> sharp_difference(std::span<const double> x, double sample_rate) {
  const std::size_t n = x.size();
  std::vector<double> v = central_difference(x, sample_rate);
  for (std::size_t i = 2; i + 2 < n; ++i) {
    const double near = x[i + 1] - x[i - 1];
    const double next = x[i + 2] - x[i - 2];
    const bool is_inside = i >= 3 && i + 3 < n;
    v[i] = is_inside ? sample_rate / 60.0 * (45.0 * near - 9.0 * next + (x[i + 3] - x[i - 3]))
                     : sample_rate / 12.0 * (8.0 * near - next);
  }
  return v;
}

std::vector<double> sharp_second_difference(std::span<const double> x, double sample_rate) {
  const std::size_t n = x.size();
  const double unit = sample_rate * sample_rate;
  std::vector<double> a = second_difference(x, sample_rate);
  for (std::size_t i = 2; i + 2 < n; ++i) {
    const double near = x[i + 1] - 2.0 * x[i] + x[i - 1];
    const double next = x[i + 2] - 2.0 * x[i] + x[i - 2];
    const bool is_inside = i >= 3 && i + 3 < n;
    a[i] = is_inside ? unit / 180.0 * (270.0 * near - 27.0 * next + 2.0 * (x[i + 3] - 2.0 * x[i] + x[i - 3]))
                     : unit / 12.0 * (16.0 * near - next);
  }
  return a;
}

std::vector<double> running_integral(std::span<const double> x, double sample_rate) {
  std::vector<double> sum(x.size(), 0.0);
  for (std::size_t i = 1; i < x.size(); ++i) sum[i] = sum[i - 1] + 0.5 / sample_rate * (x[i - 1] + x[i]);
  return sum;
}

std::vector<double> sharp_integral(std::span<const double> x, double sample_rate) {
  std::vector<double> sum(x.size(), 0.0);
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double curve = i >= 2 && i + 1 < x.size() ? x[i + 1] - x[i] - x[i - 1] + x[i - 2] : 0.0;
    sum[i] = sum[i - 1] + (0.5 * (x[i - 1] + x[i]) - curve / 24.0) / sample_rate;
  }
  return sum;
}

std::vector<double> five_point_average(std::span<const double> x) {
  const std::size_t n = x.size();
  std::vector<double> mean(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t half = std::min({std::size_t{2}, i, n - 1 - i});
    double sum = 0.0;
    for (std::size_t j = i - half; j <= i + half; ++j) sum += x[j];
    mean[i] = sum / static_cast<double>(2 * half + 1);
  }
  return mean;
}

ZeroPhaseFilter::ZeroPhaseFilter(double cutoff, double sample_rate) {
  if (!(sample_rate > 0.0) || !std::isfinite(sample_rate) || !(cutoff > 0.0 && cutoff < 0.5 * sample_rate))
    throw core::InputError(
        core::Diagnostic{{},
                         "a filter's cut-off frequency must lie between zero and half of the sample rate",
                         "> 0 and < " + core::format_number(0.5 * sample_rate, 6) + " Hz",
                         core::format_number(cutoff, 6) + " Hz",
                         {}});
  warped_ = std::tan(pi * cutoff / sample_rate);
  const double norm = 1.0 / (1.0 + std::numbers::sqrt2 * warped_ + warped_ * warped_);
  b_ = warped_ * warped_ * norm;
  a1_ = 2.0 * (warped_ * warped_ - 1.0) * norm;
  a2_ = (1.0 - std::numbers::sqrt2 * warped_ + warped_ * warped_) * norm;
  // The transient of the filter decays like exp(-2 pi cutoff t/sqrt(2)), to a thousandth in seven time constants.
  constexpr double time_constants = 7.0;
  edge_ = static_cast<std::size_t>(std::ceil(time_constants * sample_rate / (std::numbers::sqrt2 * pi * cutoff)));
}

double ZeroPhaseFilter::gain(double frequency) const {
  const double ratio = std::tan(pi * frequency) / warped_;
  return 1.0 / (1.0 + ratio * ratio * ratio * ratio);
}

double ZeroPhaseFilter::noise_gain() const {
  // Midpoint rule: the gain is a smooth periodic function of the frequency.
  constexpr int steps = 4096;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double here = gain(0.5 * (i + 0.5) / steps);
    sum += here * here;
  }
  return std::sqrt(sum / steps);
}

/// Filters in place, from the steady state for the value of the first sample.
void ZeroPhaseFilter::run(std::vector<double>& signal) const {
  const double level = signal.front();
  double z2 = (b_ - a2_) * level;
  double z1 = (2.0 * b_ - a1_) * level + z2;
  for (double& value : signal) {
    const double in = value;
    value = b_ * in + z1;
    z1 = 2.0 * b_ * in - a1_ * value + z2;
    z2 = b_ * in - a2_ * value;
  }
}

std::vector<double> ZeroPhaseFilter::operator()(std::span<const double> signal) const {
  const std::size_t n = signal.size();
  if (n == 0) return {};
  const std::size_t pad = std::min(edge_, n - 1);
  std::vector<double> all(n + 2 * pad);
  for (std::size_t i = 0; i < pad; ++i) {
    all[i] = 2.0 * signal[0] - signal[pad - i];
    all[pad + n + i] = 2.0 * signal[n - 1] - signal[n - 2 - i];
  }
  std::ranges::copy(signal, all.begin() + static_cast<std::ptrdiff_t>(pad));
  run(all);
  std::ranges::reverse(all);
  run(all);
  std::ranges::reverse(all);
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(pad);
  return {first, first + static_cast<std::ptrdiff_t>(n)};
}

PreparedHistory prepared_history(const History& history, double cutoff) {
  if (std::string fault = history.x.empty() ? std::string(without_displacement) : shape_fault(history);
      !fault.empty())
    throw core::InputError(core::Diagnostic{{}, std::move(fault), {}, {}, {}});
  const std::size_t n = history.x.size();
  const double rate = history.sample_rate;
  std::optional<ZeroPhaseFilter> filter;
  if (cutoff > 0.0) filter.emplace(cutoff, rate);
  const auto filtered = [&](std::span<const double> signal) {
    return filter ? (*filter)(signal) : std::vector<double>(signal.begin(), signal.end());
  };

  PreparedHistory motion;
  motion.x = filtered(history.x);
  motion.v = history.v.empty() ? central_difference(motion.x, rate) : filtered(history.v);
  if (!history.a.empty()) {
    motion.a = filtered(history.a);
  } else {
    motion.a = history.v.empty() ? second_difference(motion.x, rate) : central_difference(motion.v, rate);
  }
  // The acceleration jumps where the friction changes its sign. A filter moves the zero of the velocity there; a
  // higher cut-off moves it less.
  constexpr double sharper = 4.0;
  std::vector<double> turning;
  if (history.v.empty() && filter)
    turning = central_difference(ZeroPhaseFilter(std::min(sharper * cutoff, 0.4 * rate), rate)(history.x), rate);
  const std::vector<double>& speed = !history.v.empty() ? history.v : (filter ? turning : motion.v);
  std::vector<double> sign(n);
  std::vector<double> drag(n);
  for (std::size_t i = 0; i < n; ++i) {
    sign[i] = static_cast<double>((speed[i] > 0.0) - (speed[i] < 0.0));
    drag[i] = speed[i] * std::abs(speed[i]);
  }
  motion.sign = filtered(sign);
  motion.drag = filtered(drag);
  motion.y = history.y.empty() ? std::vector<double>(n, 0.0) : filtered(history.y);
  motion.force = history.force.empty() ? std::vector<double>(n, 0.0) : filtered(history.force);

  const bool differentiated = history.v.empty() || history.a.empty();
  const std::size_t edge = filter ? filter->edge() : (differentiated ? 1 : 0);
  // Four samples per period of the cut-off hold the whole filtered signal.
  const std::size_t step = filter ? std::max<std::size_t>(1, static_cast<std::size_t>(rate / (4.0 * cutoff))) : 1;
  for (std::vector<double>* signal :
       {&motion.y, &motion.x, &motion.v, &motion.a, &motion.force, &motion.sign, &motion.drag}) {
    std::size_t count = 0;
    for (std::size_t i = edge; i + edge < n; i += step) (*signal)[count++] = (*signal)[i];
    signal->resize(count);
  }
  motion.start = history.start + static_cast<double>(edge) / rate;
  motion.sample_rate = rate / static_cast<double>(step);
  return motion;
}

}  // namespace dualdamp::identify
