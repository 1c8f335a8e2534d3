#include "identify/experiments/starts.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>

#include "identify/equal_work.hpp"
#include "identify/records/swings.hpp"

namespace dualdamp::identify {

namespace {

double frequency_of(const Experiment& experiment) {
  if (experiment.motion) return experiment.motion->speed / experiment.motion->length;
  for (const Signal& signal : experiment.signals) {
    if (signal.at_name == "omega") return signal.at[signal.at.size() / 2];
    if (signal.name == "t")
      return std::numbers::pi * static_cast<double>(signal.measured.size() - 1) /
             (signal.measured.back() - signal.measured.front());
  }
  const Signal& signal = experiment.signals.front();
  return signal.is_sampled ? crossing_frequency(signal) : unknown;
}

bool is_known(double value) { return value > 0.0 && std::isfinite(value); }

/// The size of a parameter, and the largest factor between a start and this size.
struct Guess {
  double size = 1.0;
  double spread = 10.0;
};

/// Size of a number in this SI unit, a product of powers such as "N.s^2/m" or "1/m": of a law of a plugin, whose
/// unit may be any.
double size_by_unit(std::string_view unit, const DataScale& s) {
  const double time = s.length / s.speed;
  const std::map<std::string_view, double> of_base = {{"N", s.force},
                                                      {"m", s.length},
                                                      {"s", time},
                                                      {"kg", s.force * time * time / s.length},
                                                      {"W", s.force * s.speed},
                                                      {"J", s.force * s.length},
                                                      {"Hz", 1.0 / time}};
  double size = 1.0;
  bool is_below = false;
  while (!unit.empty()) {
    const std::size_t end = std::min(unit.find_first_of("./* "), unit.size());
    const std::string_view factor = unit.substr(0, end);
    const std::size_t letters = std::min(factor.find_first_of("^-0123456789"), factor.size());
    const std::string_view digits = factor.substr(std::min(factor.find_first_of("-0123456789"), factor.size()));
    int power = 1;
    std::from_chars(digits.data(), digits.data() + digits.size(), power);
    if (const auto base = of_base.find(factor.substr(0, letters)); base != of_base.end())
      size *= std::pow(base->second, is_below ? -power : power);
    is_below = end < unit.size() && unit[end] == '/';
    unit.remove_prefix(std::min(end + 1, unit.size()));
  }
  return size;
}

Guess guess_of(const FitParameter& parameter, const DataScale& s) {
  const double time = s.length / s.speed;
  constexpr double about = 3.0;  // spread of what the energy of steady states gives
  if (s.friction > 0.0 && parameter.owner == Owner::law && parameter.unit == "N") return {s.friction, about};
  if (s.damping > 0.0 && parameter.unit == "N.s/m") return {s.damping, about};
  const std::map<std::string, Guess, std::less<>> by_unit = {
      {"N", {0.15 * s.force, 15.0}},
      {"N/m", {10.0 * s.force / s.length, 100.0}},
      {"N.s/m", {0.1 * s.force / s.speed, 30.0}},
      {"N.s^2/m^2", {0.1 * s.force / (s.speed * s.speed), 30.0}},
      {"N/m^3", {0.3 * s.force / (s.length * s.length * s.length), 10.0}},
      {"m", {0.03 * s.length, 30.0}},
      {"m/s", {0.2 * s.speed, 15.0}},
      {"s", {0.05 * time, 30.0}},
      {"1/s", {1.0 / time, 30.0}},
      {"1/m", {0.3 / s.length, 10.0}},
      {"N/s", {3.0 * s.force / time, 30.0}},
      {"W", {s.force * s.speed, 30.0}},
      {"kg", {s.mass, 10.0}},
      {"rad", {1.0, 3.0}},
      {"1", {0.5, 5.0}}};
  switch (parameter.owner) {
    case Owner::mass:
      return {s.mass, 3.0};
    case Owner::stiffness:
      return {s.stiffness, 3.0};
    case Owner::damping:
      return {0.1 * std::sqrt(s.mass * s.stiffness), 10.0};
    case Owner::damping_ratio:
      return {0.05, 10.0};
    case Owner::loss_factor:
      return {0.1, 10.0};
    case Owner::record:
      if (parameter.record_parameter == RecordParameter::travel) return {0.03 * s.length, 1.0};
      return {parameter.unit == "s"       ? time
              : parameter.unit == "m/s"   ? s.speed
              : parameter.unit == "m/s^2" ? s.speed / time
              : parameter.unit == "N"     ? s.force
                                          : s.length,
              1.0};
    default:
      break;
  }
  const auto found = by_unit.find(parameter.unit);
  return found == by_unit.end() ? Guess{size_by_unit(parameter.unit, s), 30.0} : found->second;
}

/// Point `number` of Roberts' sequence in one dimension. The powers of the root of x^(d+1) = x + 1 fill a cube of d
/// dimensions evenly.
double share_of(int number, std::size_t dimension, std::size_t dimensions) {
  double root = 2.0;
  for (int i = 0; i < 40; ++i) root = std::pow(1.0 + root, 1.0 / (static_cast<double>(dimensions) + 1.0));
  const double step = std::pow(1.0 / root, static_cast<double>(dimension) + 1.0);
  return std::fmod(0.5 + step * number, 1.0);
}

/// A number of either sign in units of the size, for -1 < `position` < 1: linear, or logarithmic for a large
/// spread.
double of_either_sign(double position, double spread) {
  constexpr double far = 10.0;
  return spread < far ? position : std::copysign(std::pow(spread, 2.0 * std::abs(position) - 1.0), position);
}

/// Friction and damping from the energy of a period in each steady state, if there are two amplitudes.
void add_energy(const Experiment& experiment, DataScale& scale) {
  const std::vector<std::pair<double, double>> levels = experiment.levels();
  const std::vector<double>& x = experiment.signals.front().measured;
  const bool has_phases = experiment.signals.size() > 1 && experiment.signals[1].measured.size() == x.size();
  double largest = 0.0;
  double ones = 0.0, sum = 0.0, square = 0.0, of_pull = 0.0, product = 0.0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const auto& [Y, omega] = levels[i];
    const double P = experiment.is_force_driven ? Y : scale.stiffness * Y;
    const double in_phase = (scale.stiffness - scale.mass * omega * omega) * x[i];
    const double pull = has_phases               ? P * std::sin(experiment.signals[1].measured[i])
                        : std::abs(in_phase) < P ? std::sqrt(P * P - in_phase * in_phase)
                                                 : 0.0;
    const double speed = omega * x[i];
    largest = std::max(largest, P);
    ones += 1.0;
    sum += speed;
    square += speed * speed;
    of_pull += pull;
    product += pull * speed;
  }
  const double spread = ones * square - sum * sum;
  constexpr double alike = 1e-4;
  if (!(spread > alike * ones * square) || !(largest > 0.0)) return;
  const double damping = (ones * product - sum * of_pull) / spread;
  const double friction = coulomb_per_viscous * (of_pull - damping * sum) / ones;
  // A line that noise or a wrong constant has bent leaves at least sizes below which nothing would show.
  constexpr double least = 0.01;
  scale.friction = std::max(friction, least * largest);
  scale.damping = std::max(damping, least * largest * ones / sum);
}

}  // namespace

double crossing_frequency(const Signal& signal) {
  return crossing_frequency(signal.measured, signal.at.back() - signal.at.front());
}

int power_of_force(std::string_view unit) {
  const DataScale twice{.force = 2.0};
  return static_cast<int>(std::lround(std::log2(size_by_unit(unit, twice))));
}

DataScale scale_of(const Rig& rig, const Experiments& experiments) {
  double length = 0.0;
  double speed = 0.0;
  double acceleration = 0.0;
  double force = 0.0;
  double omega = rig.known.excitation.frequency;
  for (const auto& experiment : experiments) {
    if (!is_known(omega)) omega = frequency_of(*experiment);
    if (experiment->motion) {
      length = std::max(length, experiment->motion->length);
      speed = std::max(speed, experiment->motion->speed);
    }
    for (const Signal& signal : experiment->signals) {
      if (signal.unit == "m")
        length = std::max(length, experiment->kind == ExperimentKind::steady_states
                                      ? *std::ranges::max_element(signal.measured)
                                      : largest_swing(signal.measured));
      if (signal.unit == "m/s") speed = std::max(speed, largest_swing(signal.measured));
      if (signal.unit == "m/s^2") acceleration = std::max(acceleration, largest_swing(signal.measured));
      if (signal.unit == "N") force = std::max(force, largest_swing(signal.measured));
    }
  }
  const sim::Oscillator& o = rig.known.oscillator;
  if (!is_known(omega)) omega = is_known(o.mass) && is_known(o.stiffness) ? sim::natural_frequency(o) : 1.0;
  if (length == 0.0 && speed == 0.0) length = acceleration / (omega * omega);
  if (length == 0.0) length = speed > 0.0 ? speed / omega : 1.0;
  if (speed == 0.0) speed = length * omega;
  // The force of a loop: neither the spring nor the mass takes much more, unless they cancel each other.
  const double slope = force / length;
  const double restoring = slope + (is_known(o.stiffness) ? o.stiffness : 0.0);
  DataScale scale{.force = force, .length = length, .speed = speed};
  scale.mass = is_known(o.mass) ? o.mass : restoring > 0.0 ? restoring / (omega * omega) : 1.0;
  scale.stiffness = is_known(o.stiffness) ? o.stiffness : scale.mass * omega * omega;
  if (is_known(o.mass) && !is_known(o.stiffness)) scale.stiffness += slope;
  if (force == 0.0) scale.force = scale.stiffness * length;
  for (const auto& experiment : experiments)
    if (experiment->kind == ExperimentKind::steady_states) add_energy(*experiment, scale);
  return scale;
}

namespace {

double size_of(const FitParameter& parameter, const DataScale& scale) {
  const double stated = std::abs(parameter.stated);
  const bool is_size = parameter.owner != Owner::record || parameter.record_parameter == RecordParameter::travel;
  double size = is_known(stated) && is_size ? stated : guess_of(parameter, scale).size;
  // The search is around the size: it is moved between the bounds.
  const auto& [low, high, low_open, high_open] = parameter.range;
  if (is_known(high)) size = std::min(size, high);
  return std::max({size, low, -high});
}

}  // namespace

double spread_of(const FitParameter& parameter, const DataScale& scale) {
  return guess_of(parameter, scale).spread;
}

std::vector<double> sizes_of(const std::vector<FitParameter>& parameters, const DataScale& scale) {
  Eigen::VectorXd sizes(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i)
    sizes[static_cast<Eigen::Index>(i)] = size_of(parameters[i], scale);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].at_speed || is_known(std::abs(parameters[i].stated))) continue;
    const friction::Range& range = parameters[i].range;
    double& size = sizes[static_cast<Eigen::Index>(i)];
    size = std::clamp(size * over_force_at(scale.speed, parameters[i], sizes), range.low, range.high);
  }
  return {sizes.begin(), sizes.end()};
}

/// Loads of contacts at the first sample, in units of their size: none, yielded in either direction, in between.
constexpr std::array travels = {0.0, 30.0, -30.0, 1.0, -1.0, 0.1, -0.1};

Eigen::VectorXd start_of(const std::vector<FitParameter>& parameters, const std::vector<double>& sizes, int number,
                         const DataScale& scale) {
  // Stated values are varied only if all values are stated.
  const bool all_stated =
      std::ranges::none_of(parameters, [](const FitParameter& parameter) { return std::isnan(parameter.stated); });
  Eigen::VectorXd start(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const FitParameter& parameter = parameters[i];
    // A stated zero, as of a cubic spring that may not exist, has no size: every other start uses one from the
    // data.
    const bool is_stated = !std::isnan(parameter.stated) && (parameter.stated != 0.0 || number % 2 == 0);
    const double share = number == 0 ? 0.5 : share_of(number, i, parameters.size());
    const double about_stated = all_stated ? 1.5 : 1.0;
    const double spread = is_stated ? about_stated : guess_of(parameter, scale).spread;
    double value = sizes[i] * std::pow(spread, 2.0 * share - 1.0);
    if (parameter.owner == Owner::record && parameter.record_parameter == RecordParameter::travel &&
        parameter.stated == 0.0)
      value = sizes[i] * travels[static_cast<std::size_t>(number) % travels.size()];
    else if (parameter.owner == Owner::record || (is_stated && (number == 0 || !(parameter.stated > 0.0))))
      value = parameter.stated;
    else if (parameter.range.low < 0.0 && !is_stated)
      value = sizes[i] * of_either_sign(2.0 * share - 1.0, guess_of(parameter, scale).spread);
    if (parameter.above && !(is_stated && number == 0))
      value = start[static_cast<Eigen::Index>(*parameter.above)] * (1.0 + share);
    start[static_cast<Eigen::Index>(i)] = value;
  }
  const Eigen::VectorXd middle =
      Eigen::Map<const Eigen::VectorXd>(sizes.data(), static_cast<Eigen::Index>(sizes.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].at_speed && std::isnan(parameters[i].stated))
      start[static_cast<Eigen::Index>(i)] *=
          over_force_at(scale.speed, parameters[i], start) / over_force_at(scale.speed, parameters[i], middle);
  return start;
}

}  // namespace dualdamp::identify
