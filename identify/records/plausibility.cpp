#include "identify/records/plausibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/records/faults/drive_gain.hpp"
#include "identify/records/faults/drive_work.hpp"
#include "identify/records/faults/frequency_unit.hpp"
#include "identify/records/faults/phase_checks.hpp"
#include "identify/records/faults/resonance_line.hpp"
#include "identify/records/faults/sensor_agreement.hpp"
#include "identify/records/sine_fit.hpp"
#include "identify/records/turning_points.hpp"
#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

namespace {

constexpr int digits = 3;
/// A factor that no sensor, friction or second mode explains.
constexpr double gross = 5.0;

std::string shown(double value) { return core::format_number(value, digits); }

bool is_gross(double ratio) {
  return std::isfinite(ratio) && ratio > 0.0 && (ratio > gross || ratio < 1.0 / gross);
}

/// Factors of wrong units: of lengths, and of lengths, times, angles and accelerations beside each other.
constexpr std::array<double, 5> of_lengths = {10.0, 25.4, 100.0, 1000.0, 1e6};
constexpr std::array<double, 7> of_motions = {9.80665, 25.4, 57.29578, 60.0, 1000.0, 9806.65, 1e6};

/// "about 1000 times too large": the factor of a wrong unit if one is near.
std::string times_off(double ratio, std::span<const double> factors = of_motions) {
  constexpr double near = 0.25;
  const double size = std::max(ratio, 1.0 / ratio);
  const auto factor =
      std::ranges::find_if(factors, [size](double f) { return std::abs(std::log(size / f)) < near; });
  return "about " + (factor == factors.end() ? shown(size) : core::format_number(*factor, digits + 1)) +
         " times too " + (ratio > 1.0 ? "large" : "small");
}

class Check {
 public:
  Check(const Record& record, const KnownConstants& constants, const std::vector<std::string>& assumed,
        const std::string& file, const core::SettingWords& words)
      : record_(record), constants_(constants), assumed_(assumed), file_(file), words_(words) {}

  std::vector<core::Diagnostic> run() {
    for (const History& history : record_.histories) {
      if (check_frequency(history)) check_signals(history);
      if (!faults_.empty()) return faults_;
    }
    if (record_.decay) check_decay(*record_.decay);
    if (record_.pairs && !record_.pairs->pairs.empty()) check_pairs(record_.pairs->pairs);
    // Last, because what is found before explains more: swapped columns give a motion of another gain, too.
    for (const History& history : record_.histories)
      if (faults_.empty()) check_gain(history);
    return faults_;
  }

 private:
  void refuse(std::string message, std::string allowed) {
    faults_.push_back({{file_, 0, 0, {}}, std::move(message), std::move(allowed), {}, {}});
  }

  [[nodiscard]] std::string in_unit(std::string_view column, std::string_view unit) const {
    return words_(core::Setting::unit, column, unit);
  }
  [[nodiscard]] std::string in_units(std::string_view column, std::string_view other) const {
    return in_unit(column, "UNIT") + ", " + in_unit(other, "UNIT");
  }
  [[nodiscard]] std::string in_millimetres() const { return in_unit("x", "mm") + ", " + in_unit("Y", "mm"); }
  [[nodiscard]] std::string turned(std::string_view column) const {
    return words_(core::Setting::scale, column, "-1");
  }

  [[nodiscard]] bool is_assumed(const char* name) const {
    return std::ranges::find(assumed_, name) != assumed_.end();
  }

  [[nodiscard]] static const std::vector<double>& leading(const History& history) {
    for (const auto* signal : {&history.x, &history.v, &history.a, &history.y})
      if (!signal->empty()) return *signal;
    return history.force;
  }

  static std::string in_hertz(double omega) { return shown(omega / core::two_pi) + " Hz"; }

  /// Refuses a frequency that is off by the factor of a unit of time. `always`: by any gross factor. Otherwise
  /// other factors are allowed, because a beat or noise may change the measured frequency of a motion.
  bool refuse_times(double measured, double expected, const std::string& what, bool always = false) {
    constexpr std::array<std::pair<double, const char*>, 5> units = {
        {{1e-3, "ms"}, {1e-6, "us"}, {60.0, "min"}, {3600.0, "h"}, {86400.0, "day"}}};
    constexpr double near = 0.3;
    // If milliseconds are read as seconds, the motion has a thousandth of its frequency.
    const auto* const unit = std::ranges::find_if(
        units, [&](const auto& row) { return std::abs(std::log(measured / expected / row.first)) < near; });
    if (unit == units.end() && !(always && is_gross(measured / expected))) return false;
    refuse(
        "by its times the motion repeats at " + in_hertz(measured) + ", and " + what + " is " + in_hertz(expected),
        unit == units.end()
            ? "times in seconds, not numbers of samples (" + words_(core::Setting::scale, "t", "0.002") +
                  " converts these to times); mass and stiffness in their units"
            : std::string("times in seconds, or their unit; these may be in ") + unit->second + ": " +
                  in_unit("t", unit->second));
    return true;
  }

  /// Checks the frequency of a motion by its times. False after a fault.
  bool check_frequency(const History& history) {
    const double measured = guess_frequency(leading(history), history.sample_rate);
    if (!(measured > 0.0)) return true;
    const bool is_driven = !history.y.empty() && constants_.frequency > 0.0;
    const double expected = is_driven ? constants_.frequency : constants_.natural_frequency();
    if (!(expected > 0.0)) return true;
    // A slow drive leaves the mass in balance with the spring. What moves further is near its natural frequency.
    if (!is_driven && history.has_drive() && !moves_beyond_drive(history, measured)) return true;
    return !refuse_times(measured, expected, is_driven ? "the stated frequency" : "the natural frequency");
  }

  /// Whether spring and inertia of the motion need a gross multiple of the force of the drive.
  [[nodiscard]] bool moves_beyond_drive(const History& history, double omega) const {
    const auto size = [&](const std::vector<double>& signal) { return amplitude(signal, history, omega); };
    const double force =
        std::fmax(size(history.force), 0.0) + constants_.stiffness * std::fmax(size(history.y), 0.0);
    return std::abs(constants_.stiffness - constants_.mass * omega * omega) * size(history.x) > gross * force;
  }

  void check_decay(const DecayRecord& decay) {
    double omega = constants_.natural_frequency();
    if (decay.times.size() > 2) {
      std::vector<double> half_periods;
      for (std::size_t i = 1; i < decay.times.size(); ++i)
        half_periods.push_back(decay.times[i] - decay.times[i - 1]);
      const double measured = std::numbers::pi / upper_median(std::move(half_periods));
      if (omega > 0.0 && refuse_times(measured, omega, "the natural frequency", true)) return;
    }
    if (decay.extremes.empty()) return;
    const auto [low, high] = std::ranges::minmax(decay.extremes);
    check_size("x", 0.5 * (high - low), omega);
  }

  /// Checks speeds and accelerations of a motion without a stated unit. `omega` [rad/s].
  void check_size(const char* name, double amplitude, double omega) {
    constexpr double fastest = 50.0;
    constexpr double most_acceleration = 1e4;
    if (!faults_.empty() || !is_assumed(name) || !(omega > 0.0)) return;
    const double speed = omega * amplitude;
    if (speed <= fastest && omega * speed <= most_acceleration) return;
    const bool is_angle = constants_.coordinate == core::Coordinate::angle;
    const std::string unit = constants_.unit("m");
    const std::string usual = is_angle ? "deg" : "mm";
    refuse("no unit is stated for " + std::string(name) + "; in " + (is_angle ? "radians" : "metres") +
               " it would reach " + shown(amplitude) + " " + unit + " at " + shown(omega / core::two_pi) + " Hz, " +
               shown(speed) + " " + unit + "/s and " + shown(omega * speed) + " " + unit + "/s^2",
           "the unit in the file, '" + std::string(name) + " [" + usual + "]', or " + in_unit(name, usual));
  }

  /// The amplitude of a signal at one frequency.
  [[nodiscard]] static double amplitude(const std::vector<double>& signal, const History& history, double omega) {
    if (signal.empty()) return unknown;
    const SineFit fit = fit_sine(signal, history.sample_rate, omega);
    return fit.outcome.ok() ? fit.harmonics.front().amplitude : unknown;
  }

  void check_signals(const History& history) {
    const double omega = guess_frequency(leading(history), history.sample_rate);
    if (!(omega > 0.0)) return check_agreement(history);
    const double x = amplitude(history.x, history, omega);
    check_size("x", x, omega);
    check_size("y", amplitude(history.y, history, omega), omega);
    // Converted to displacements, all amplitudes should be equal.
    if (!faults_.empty()) return;
    const std::array<std::pair<const char*, double>, 3> motions = {
        {{"x", x},
         {"v", amplitude(history.v, history, omega) / omega},
         {"a", amplitude(history.a, history, omega) / (omega * omega)}}};
    for (std::size_t i = 0; i < motions.size(); ++i)
      for (std::size_t k = i + 1; k < motions.size(); ++k) {
        const double ratio = motions[k].second / motions[i].second;
        if (!is_gross(ratio)) continue;
        refuse(std::string("at ") + shown(omega / core::two_pi) + " Hz column " + motions[k].first + " is " +
                   times_off(ratio) + " for column " + motions[i].first,
               "both in their units: " + in_units(motions[k].first, motions[i].first));
        return;
      }
    check_force(amplitude(history.force, history, omega), x, omega);
    if (faults_.empty()) check_agreement(history);
    if (faults_.empty()) check_work(history, omega);
  }

  /// Checks that x, v and a are of one motion, by their sizes and signs. A single swing tells.
  void check_agreement(const History& history) {
    struct Both {
      const char* name;
      const std::vector<double>& signal;
      const char* of_derivative;
      const std::vector<double>& derivative;
      int order;
    };
    const std::array<Both, 3> list = {{{"x", history.x, "v", history.v, 1},
                                       {"x", history.x, "a", history.a, 2},
                                       {"v", history.v, "a", history.a, 1}}};
    constexpr double alike = 0.9;  // less: noise, or sensors of different motions
    for (const auto& [name, signal, of_derivative, derivative, order] : list) {
      const SensorAgreement found = sensor_agreement(signal, derivative, order, history.sample_rate);
      if (!(std::abs(found.correlation) > alike)) continue;
      const std::string columns = std::string("column ") + of_derivative + " is ";
      if (is_gross(found.ratio))
        return refuse(columns + times_off(found.ratio) + " for the changes of column " + name,
                      "both in their units, and the times too: " + in_units(of_derivative, name));
      if (found.correlation < 0.0)
        return refuse(columns + "the " + (order == 1 ? "first" : "second") + " derivative of column " + name +
                          " with the wrong sign",
                      "x, v and a positive in one direction: " + turned(of_derivative) + ", or " + turned(name));
    }
  }

  /// Checks that the work of force or base is possible.
  void check_work(const History& history, double omega) {
    const bool is_force = !history.force.empty();
    if (!is_force && record_.pairs) return;  // phases of pairs tell more of a base
    const std::optional<double> work = impossible_work(history, constants_, omega);
    if (!work) return;
    const std::string taken = "the " + std::string(is_force ? "force" : "base") + " takes " + shown(-*work) +
                              unit("J") + " out of the motion x, more than the motion has: ";
    const std::string name = is_force ? "force" : "y";
    const std::string positive = name + " and x positive in one direction: " + turned(name);
    if (is_force) return refuse(taken + "one of them has the wrong sign", positive);
    // Exchanged, the work of a base has the other sign as well. A mass mostly moves further than its base.
    std::array<std::string, 2> causes = {"one of them has the wrong sign", "x and y are swapped"};
    std::array<std::string, 2> remedies = {
        positive, words_(core::Setting::column, "x", "...") + ", " + words_(core::Setting::column, "y", "...")};
    if (range_of(history.y) > range_of(history.x)) {
      std::ranges::reverse(causes);
      std::ranges::reverse(remedies);
    }
    refuse(taken + causes[0] + ", or " + causes[1], remedies[0] + "; or " + remedies[1]);
  }

  [[nodiscard]] std::string unit(const char* name) const { return " " + constants_.unit(name); }

  /// Checks |k - m w^2| x <= F. Friction and damping act at right angles to it. No effect near resonance.
  void check_force(double force, double x, double omega) {
    const double needed = std::abs(constants_.stiffness - constants_.mass * omega * omega) * x;
    constexpr double unit_error = 100.0;
    if (needed > unit_error * force && force > 0.0)
      refuse("column force, " + shown(force) + unit("N") + ", is " + times_off(force / needed) +
                 " for the motion x, which needs " + shown(needed) + unit("N"),
             "both in their units, and the mass and the stiffness stated: " + in_unit("force", "kN") + ", " +
                 in_unit("x", "mm"));
  }

  /// Checks that a motion is not that of a drive of another size.
  void check_gain(const History& history) {
    const std::optional<double> gain = gain_of_drive(history, constants_);
    if (!gain || !is_gross(*gain)) return;
    const std::string name = history.force.empty() ? "y" : "force";
    const auto exactly = [](double value) { return core::format_number(value, digits + 1); };
    refuse(
        "column " + name + " is about " + exactly(std::max(*gain, 1.0 / *gain)) + " times too " +
            (*gain > 1.0 ? "large" : "small") +
            " for the motion x of the stated mass and stiffness: its gain, left free in the balance of forces, is " +
            exactly(*gain),
        "the unit or the range of its amplifier: " + in_unit(name, name == "y" ? "mm" : "mN") + ", or " +
            words_(core::Setting::scale, name, exactly(1.0 / *gain)) + "; mass and stiffness in their units");
  }

  /// Reports that the motion needs more force than the drive gives. Near resonance, a mass needs little force, so a
  /// wrong frequency or constant has the same effect as wrong amplitudes.
  void refuse_balance(const std::vector<Pair>& pairs, const Balance& balance, const std::string& swapped) {
    const double omega = frequency_of(pairs.front(), constants_);
    const std::string where = " at " + in_hertz(omega) + ", where the natural frequency is " +
                              in_hertz(constants_.natural_frequency()) +
                              ": spring and inertia of the motion x need more force than the base gives, k Y";
    if (const std::vector<std::string> units = other_units_of_frequency(pairs, constants_); !units.empty())
      return refuse("x, Y and the frequency do not belong together" + where,
                    "the frequency in its unit: it may be in " + core::joined(units, ", or in "));
    if (balance.swapped_too_much == 0)
      refuse("columns x and Y seem to be swapped, or a constant is wrong: in " + std::to_string(balance.too_much) +
                 " of " + std::to_string(balance.pairs) + " pairs," + where,
             swapped + "; mass, stiffness, frequency and times in their units");
    else
      refuse("column x is " + times_off(upper_median(balance.excess), of_lengths) + " for Y" + where,
             "both in their units, and mass, stiffness and frequency too: " + in_millimetres());
  }

  void check_pairs(const std::vector<Pair>& pairs) {
    check_readings(pairs);
    if (!faults_.empty()) return;
    const Balance balance = balance_of(pairs, constants_);
    const std::string swapped = "x is the amplitude of the mass, Y that of the base; " +
                                words_(core::Setting::column, "x", "...") + ", " +
                                words_(core::Setting::column, "Y", "...");
    const bool are_hertz = record_.histories.empty() && are_in_hertz(pairs, constants_);
    if (are_hertz || (2 * balance.too_much > balance.pairs && balance.pairs > 0))
      return refuse_balance(pairs, balance, swapped);
    check_phases(pairs);
    if (faults_.empty()) check_line(pairs, swapped);
  }

  /// Checks that the columns of a pair agree with each other.
  void check_readings(const std::vector<Pair>& pairs) {
    std::vector<double> fundamentals;
    std::vector<double> speeds;
    double largest = 0.0;
    double base = 0.0;
    double omega = 0.0;
    for (const Pair& pair : pairs) {
      omega = std::max(omega, std::isnan(frequency_of(pair, constants_)) ? constants_.natural_frequency()
                                                                         : frequency_of(pair, constants_));
      largest = std::max(largest, pair.x);
      base = std::max(base, pair.Y);
      if (!(pair.x > 0.0)) continue;
      if (pair.fundamental > 0.0) fundamentals.push_back(pair.fundamental / pair.x);
      const double speed = frequency_of(pair, constants_) * pair.x;
      if (pair.mean_square_speed > 0.0 && speed > 0.0)
        speeds.push_back(std::sqrt(2.0 * pair.mean_square_speed) / speed);
    }
    check_size("x", largest, omega);
    check_size("Y", base, omega);
    if (faults_.empty()) {
      check_exchange(pairs);
      if (!faults_.empty()) return;
    }
    for (const auto& [name, ratios] : {std::pair{"fundamental", &fundamentals}, {"mean_square_speed", &speeds}})
      if (!ratios->empty() && is_gross(upper_median(*ratios)))
        refuse(
            "column " + std::string(name) + " is " + times_off(upper_median(*ratios), of_lengths) + " for column x",
            "both in their units: " + in_units("x", name));
  }

  /// The fundamental of x is nearly as large as x. Where x or fundamental has exchanged its place with Y, it is
  /// not.
  void check_exchange(const std::vector<Pair>& pairs) {
    constexpr std::size_t fewest = 3;
    constexpr double near = 0.15;
    constexpr double apart = 0.25;
    const auto distance = [](double a, double b) { return std::abs(std::log(a / b)); };
    std::vector<double> off;
    bool fundamental_is_of_Y = true;
    bool Y_is_of_x = true;
    for (const Pair& pair : pairs) {
      if (!(pair.fundamental > 0.0 && pair.x > 0.0 && pair.Y > 0.0)) continue;
      off.push_back(distance(pair.fundamental, pair.x));
      fundamental_is_of_Y = fundamental_is_of_Y && distance(pair.fundamental, pair.Y) < near;
      Y_is_of_x = Y_is_of_x && distance(pair.Y, pair.x) < near;
    }
    if (off.size() < fewest || !(upper_median(off) > apart)) return;
    const auto say = [this](const char* one, const char* other, const std::string& reason) {
      refuse("columns " + std::string(one) + " and " + other + " seem to be swapped: " + reason,
             "x, Y and fundamental of one pair in a row; " + words_(core::Setting::column, one, "...") + ", " +
                 words_(core::Setting::column, other, "..."));
    };
    if (fundamental_is_of_Y)
      return say("x", "Y", "fundamental, that of x, is close to Y in every pair, and not to x");
    if (Y_is_of_x) say("Y", "fundamental", "Y is close to x in every pair, and fundamental, that of x, is not");
  }

  void check_phases(const std::vector<Pair>& pairs) {
    if (const auto fault = phase_fault(pairs, constants_, !record_.histories.empty(), words_))
      return refuse(fault->message, fault->allowed);
    if (const std::optional<double> excess = excess_of_Y(pairs, constants_); excess && is_gross(*excess))
      refuse("column Y is " + times_off(*excess, of_lengths) +
                 " for x and the phases on both sides of the natural frequency, k Y cos(phase) = (k - m w^2) x",
             "both in their units: " + in_millimetres());
  }

  void check_line(const std::vector<Pair>& pairs, const std::string& swapped) {
    const std::optional<ResonanceLine> line = resonance_line(pairs, constants_);
    if (!line) return;
    const auto& [zeta, intercept, other_zeta, other_intercept] = *line;
    // As they are, the columns give zeta above 1 and negative friction; exchanged, they give possible values.
    if (zeta > 1.0 && intercept < 0.0 && other_zeta < 1.0 && other_intercept > 0.0)
      refuse("columns x and Y seem to be swapped: as they are, zeta is " + shown(zeta) +
                 " and F0 is negative; exchanged, zeta is " + shown(other_zeta),
             swapped);
    const char* const who = is_assumed("x") ? "x" : is_assumed("Y") ? "Y" : nullptr;
    if (faults_.empty() && who != nullptr && is_odd(zeta))
      refuse("no unit is stated for " + std::string(who) + ", and in SI x and Y give a damping ratio of " +
                 shown(zeta) + ": one of them is wrong by a factor of about 1000",
             "the units of both: " + in_millimetres());
  }

  const Record& record_;
  const KnownConstants& constants_;
  const std::vector<std::string>& assumed_;
  const std::string& file_;
  const core::SettingWords& words_;
  std::vector<core::Diagnostic> faults_;
};

}  // namespace

std::vector<core::Diagnostic> gross_faults(const Record& record, const KnownConstants& constants,
                                           const std::vector<std::string>& assumed, const std::string& file,
                                           const core::SettingWords& words) {
  return Check(record, constants, assumed, file, words).run();
}

std::vector<std::string> odd_readings(const Record& record, const KnownConstants& constants) {
  double largest = 0.0;
  const auto include = [&largest](const std::vector<double>& x) {
    if (!x.empty()) largest = std::max(largest, 0.5 * (std::ranges::max(x) - std::ranges::min(x)));
  };
  for (const History& history : record.histories) include(history.x);
  if (record.decay) include(record.decay->extremes);
  constexpr double two_turns = 2.0 * core::two_pi;
  if (constants.coordinate == core::Coordinate::angle && largest > two_turns)
    return {"x swings by " + shown(largest) + " rad to each side, " + shown(0.5 * largest / std::numbers::pi) +
            " turns: if these are degrees, forces are 57 times too large"};
  const double speed = constants.natural_frequency() * largest;
  constexpr double fastest = 1000.0;
  if (constants.coordinate == core::Coordinate::displacement && speed > fastest)
    return {"x swings by " + shown(largest) + " m to each side, at the natural frequency with " + shown(speed) +
            " m/s: its unit or its scale may be wrong"};
  if (!record.pairs) return {};
  const std::optional<ResonanceLine> line = resonance_line(record.pairs->pairs, constants);
  if (!line || !is_odd(line->zeta)) return {};
  return {"x and Y give a damping ratio of " + shown(line->zeta) +
          ", which few rigs have: if one of their units is wrong by a factor of 1000, so are the results"};
}

}  // namespace dualdamp::identify
