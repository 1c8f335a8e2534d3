#include "tests/identify/ledger/laboratory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

namespace dualdamp::identify::testing {

using std::numbers::pi;

std::string_view name_of(Kind kind) {
  constexpr std::array<std::string_view, 9> names = {"x-Y",    "x-Y with phase", "response", "extremes", "decay",
                                                     "forced", "beat",           "ramp",     "random"};
  return names[static_cast<std::size_t>(kind)];
}

namespace {

class Laboratory {
 public:
  Laboratory(Kind kind, std::uint64_t seed, void (*alter)(Rig&), const Off& off)
      : kind_(kind), random_(1'000'003 * seed + static_cast<std::uint64_t>(kind)), off_(off) {
    Rig& rig = result_.rig;
    rig.on_base = kind == Kind::xy || kind == Kind::xy_phase || kind == Kind::response;
    rig.m = uniform(0.5, 5.0);
    rig.k = rig.m * std::pow(2.0 * pi * uniform(2.0, 10.0), 2);
    rig.zeta = 0.02 * std::pow(5.0, uniform(0.0, 1.0));
    if (kind == Kind::decay || kind == Kind::extremes) rig.zeta *= 0.25;
    rig.F0 = rig.m * uniform(0.5, 3.0);
    choose_level();
    if (alter != nullptr) alter(rig);
    result_.constants = {rig.m, rig.k * (1.0 + off.stiffness), unknown};
  }

  Measured measure() {
    switch (kind_) {
      case Kind::xy:
      case Kind::xy_phase:
        levels();
        break;
      case Kind::response:
        response();
        break;
      case Kind::extremes:
        extremes();
        break;
      default:
        history();
    }
    return result_;
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  double normal() { return off_.noise * std::normal_distribution()(random_); }

  /// Rounds a signal as an analog-to-digital converter does, and times as a clock does.
  void convert(std::vector<double>& signal) const {
    if (off_.bits == 0 || signal.empty()) return;
    const auto [low, high] = std::ranges::minmax_element(signal);
    const double step = 1.25 * (*high - *low) / std::pow(2.0, off_.bits);
    for (double& value : signal) value = step * std::round(value / step);
  }
  [[nodiscard]] double on_clock(double time) const {
    return off_.clock > 0.0 ? off_.clock * std::round(time / off_.clock) : time;
  }

  /// Error of the zero of x at one of `count` readings.
  [[nodiscard]] double drift_of_zero(std::size_t i, std::size_t count) const {
    return off_.zero_drift * result_.rig.x_f() * static_cast<double>(i) / static_cast<double>(count - 1);
  }

  /// Drive amplitudes from two to six times the largest that dry friction alone withstands; L and V of the largest.
  void choose_level() {
    Rig& rig = result_.rig;
    least_ = uniform(1.8, 2.5) * rig.x_f();
    most_ = least_ * uniform(2.0, 3.0);
    rig.L = (most_ - 4.0 / pi * rig.x_f()) / (2.0 * rig.zeta);
    if (kind_ == Kind::decay || kind_ == Kind::extremes) rig.L = uniform(40.0, 100.0) * rig.x_f();
    rig.V = rig.omega() * rig.L;
  }

  void levels() {
    const Rig& rig = result_.rig;
    const double omega = rig.omega();
    constexpr int count = 8;
    constexpr int sweeps = 3;
    PairRecord record;
    const double sx = 0.005 * rig.L;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      Rig now = rig;
      now.F0 *= 1.0 + off_.sweep_drift * (sweep / (sweeps - 1.0) - 0.5);
      for (int i = 0; i < count; ++i) {
        const double Y = least_ + (most_ - least_) * i / (count - 1.0);
        if (sweep == 0 || off_.sweep_drift != 0.0) states_.push_back(steady_state(now, Y, omega));
        const Steady& state = states_[off_.sweep_drift != 0.0 ? states_.size() - 1 : static_cast<std::size_t>(i)];
        Pair pair;
        pair.Y = Y * (1.0 + off_.drive_gain);
        pair.x = state.x * (1.0 + off_.gain) + sx * normal();
        pair.sweep = std::string(1, static_cast<char>('a' + sweep));
        pair.number = static_cast<int>(record.pairs.size()) + 1;
        if (kind_ == Kind::xy_phase) pair.phase = lag(state.phase) + 0.005 * normal();
        record.pairs.push_back(pair);
      }
    }
    result_.constants.frequency = omega * (1.0 + off_.frequency);
    result_.record.pairs = std::move(record);
  }

  [[nodiscard]] double lag(double phase) const { return std::remainder(phase + 2.0 * pi * off_.delay, 2.0 * pi); }

  void response() {
    const Rig& rig = result_.rig;
    const int count = off_.states;
    PairRecord record;
    const double width = 4.0 * rig.zeta;
    const double Y = 1.3 * least_ + 0.3 * (most_ - least_);
    const double sx = 0.005 * (Y - 4.0 / pi * rig.x_f()) / (2.0 * rig.zeta);
    for (int i = 0; i < count; ++i) {
      const double omega = rig.omega() * (1.0 + width * (i / (count - 1.0) - 0.5 + off_.shift));
      const Steady state = steady_state(rig, Y, omega);
      Pair pair;
      pair.Y = Y * (1.0 + off_.drive_gain) * (1.0 + 0.005 * off_.drive_noise * normal());
      pair.x = state.x * (1.0 + off_.gain) + sx * normal();
      pair.omega = omega * (1.0 + off_.frequency);
      pair.phase =
          std::remainder(state.phase + omega / rig.omega() * 2.0 * pi * off_.delay, 2.0 * pi) + 0.005 * normal();
      pair.number = i + 1;
      record.pairs.push_back(pair);
    }
    result_.record.pairs = std::move(record);
  }

  void extremes() {
    const Rig& rig = result_.rig;
    const double rate = 400.0 * rig.omega() / (2.0 * pi);
    const Motion motion = motion_of(rig, [](double) { return 0.0; }, 60.0 * 2.0 * pi / rig.omega(), rate, rig.L);
    DecayRecord record;
    const double sx = 0.1 * rig.x_f();
    const double st = 0.002 * 2.0 * pi / rig.omega();
    record.extremes.push_back(rig.L * (1.0 + off_.gain) + sx * normal());
    record.times.push_back(0.0);
    for (std::size_t i = 1; i + 1 < motion.v.size() && record.extremes.size() < 40; ++i) {
      const bool turns = motion.v[i] * motion.v[i + 1] < 0.0 || (motion.v[i + 1] == 0.0 && motion.v[i] != 0.0);
      if (!turns) continue;
      const double share = motion.v[i] / (motion.v[i] - motion.v[i + 1]);
      const double x = std::abs(motion.x[i]) > std::abs(motion.x[i + 1]) ? motion.x[i] : motion.x[i + 1];
      if (std::abs(x) < 3.0 * rig.x_f()) break;
      record.extremes.push_back(x * (1.0 + off_.gain) + sx * normal());
      record.times.push_back(on_clock((static_cast<double>(i) + share) / rate + st * normal()));
    }
    for (std::size_t i = 0; i < record.extremes.size(); ++i)
      record.extremes[i] += drift_of_zero(i, record.extremes.size());
    convert(record.extremes);
    result_.record.decay = std::move(record);
  }

  [[nodiscard]] Drive drive() {
    const Rig& rig = result_.rig;
    const double w = rig.omega();
    const double force = rig.k * least_ * 1.5;
    switch (kind_) {
      case Kind::forced:
        return [=, r = uniform(0.95, 1.05)](double t) { return force * std::sin(r * w * t); };
      case Kind::beat:
        return [=](double t) { return 0.5 * force * (std::sin(1.01 * w * t) - std::sin(0.95 * w * t)) * 1.5; };
      case Kind::ramp:
        return [=](double t) { return force * std::sin(w * t * (0.75 + 0.25 * t * w / (40.0 * 2.0 * pi))); };
      case Kind::random: {
        std::array<std::array<double, 3>, 60> waves{};
        for (auto& [frequency, sine, cosine] : waves) {
          frequency = w * uniform(0.3, 2.0);
          sine = 2.0 * force * std::normal_distribution()(random_) / std::sqrt(60.0);
          cosine = 2.0 * force * std::normal_distribution()(random_) / std::sqrt(60.0);
        }
        return [=](double t) {
          double sum = 0.0;
          for (const auto& [frequency, sine, cosine] : waves)
            sum += sine * std::sin(frequency * t) + cosine * std::cos(frequency * t);
          return sum * std::min(1.0, t * w / 10.0);
        };
      }
      default:
        return [](double) { return 0.0; };
    }
  }

  void history() {
    const Rig& rig = result_.rig;
    const double period = 2.0 * pi / rig.omega();
    const double rate = std::round(off_.samples / period);
    const bool free = kind_ == Kind::decay;
    const Motion motion = motion_of(rig, drive(), (free ? 60.0 : 40.0) * period, rate, free ? rig.L : 0.0);
    const auto [low, high] = std::ranges::minmax_element(motion.x);
    const double size = 0.5 * (*high - *low);
    History history;
    history.sample_rate = rate;
    result_.deviations.sigma_x = off_.stated_noise * 0.002 * size * off_.noise;
    const double largest_force = *std::ranges::max_element(motion.drive);
    const auto late = static_cast<std::ptrdiff_t>(std::lround(off_.delay * period * rate));
    for (std::size_t i = 0; i < motion.x.size(); ++i) {
      const auto from =
          static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(i) - late));
      history.x.push_back(motion.x[from] * (1.0 + off_.gain) + drift_of_zero(i, motion.x.size()) +
                          0.002 * size * normal());
      if (!free)
        history.force.push_back(motion.drive[i] * (1.0 + off_.drive_gain) + 0.005 * largest_force * normal());
      const double speed = size * rig.omega();
      if (off_.v_noise > 0.0) history.v.push_back(motion.v[i] + off_.v_noise * speed * (normal() + off_.zero));
      if (off_.a_noise > 0.0)
        history.a.push_back(motion.a[i] + off_.a_noise * speed * rig.omega() * (normal() + off_.zero));
    }
    for (std::vector<double>* signal : {&history.x, &history.v, &history.a, &history.force}) convert(*signal);
    result_.record.histories.push_back(std::move(history));
  }

  Kind kind_;
  std::mt19937_64 random_;
  Off off_;
  Measured result_;
  double least_ = 0.0;
  double most_ = 0.0;
  std::vector<Steady> states_;
};

}  // namespace

Measured measured(Kind kind, std::uint64_t seed, void (*alter)(Rig&), const Off& off) {
  return Laboratory(kind, seed, alter, off).measure();
}

}  // namespace dualdamp::identify::testing
