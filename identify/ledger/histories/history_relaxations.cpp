#include "identify/ledger/histories/history_relaxations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/constants.hpp"

namespace dualdamp::identify {

namespace {

using Kind = FreedPart::Kind;
using By = SampledOscillator::By;

void add(HistoryRelaxations& list, Assumption assumption, std::string test, const FreedPart& part) {
  Relaxation relaxation{assumption, std::move(test)};
  if (part.term != nullptr) {
    relaxation.sign = part.term->sign;
    relaxation.freed = part.term->freed;
    relaxation.is_law = part.term->is_law;
  }
  if (assumption == Assumption::constants) relaxation.freed = part.by == By::mass ? Freed::mass : Freed::stiffness;
  if (part.kind == Kind::gain) relaxation.freed = Freed::gain;
  if (part.kind == Kind::delay) relaxation.freed = Freed::delay;
  list.relaxations.push_back(std::move(relaxation));
  list.parts.push_back(part);
}

void add_constants(HistoryRelaxations& list, const KnownConstants& constants) {
  if (!std::isnan(constants.mass))
    add(list, Assumption::constants, "mass free", {.kind = Kind::constant, .by = By::mass});
  if (!std::isnan(constants.stiffness))
    add(list, Assumption::constants, "stiffness free", {.kind = Kind::constant, .by = By::stiffness});
  // Below its resonance a further mode adds to the mass.
  if (!std::isnan(constants.mass))
    add(list, Assumption::one_mode, "inertia of a further mode", {.kind = Kind::constant, .by = By::mass});
}

/// Free vibrations from about the same amplitude.
bool are_alike_decays(const std::vector<ForwardTest>& tests) {
  constexpr double apart = 1.5;  // of amplitudes: the larger one has swings that the other has not
  double least = core::infinity;
  double most = 0.0;
  for (const ForwardTest& test : tests) {
    const History& history = *test.history;
    if (history.has_drive()) return false;
    const auto [low, high] = std::ranges::minmax(history.x);
    least = std::min(least, high - low);
    most = std::max(most, high - low);
  }
  return most < apart * least;
}

void add_terms(HistoryRelaxations& list, bool are_alike) {
  for (const HistoryTerm& term : history_terms()) {
    add(list, term.assumption, std::string(term.test),
        {.kind = term.is_of_contact ? Kind::contact : Kind::force, .term = &term});
    list.relaxations.back().is_like_speed = are_alike && term.assumption == Assumption::stationarity;
  }
}

void add_contrasts(HistoryRelaxations& list, std::size_t tests) {
  constexpr std::size_t most = 8;
  const std::size_t contrasts = tests < 2 ? 0 : tests == 2 ? 1 : std::min(tests, most);
  for (std::size_t t = 0; t < contrasts; ++t)
    add(list, Assumption::stationarity, "friction force of history " + std::to_string(t + 1) + " free",
        {.kind = Kind::friction_of_history, .history = t});
}

void add_reading(HistoryRelaxations& list, const std::string& signal, MotionSensor sensor) {
  add(list, Assumption::sensors, "gain of " + signal + " free", {.kind = Kind::gain, .sensor = sensor});
  add(list, Assumption::sensors, "delay of " + signal + " free", {.kind = Kind::delay, .sensor = sensor});
}

/// The uncertainty of the gain of this sensor.
double ConstantUncertainties::* gain_of(MotionSensor sensor) {
  if (sensor == MotionSensor::x) return &ConstantUncertainties::gain_x;
  return sensor == MotionSensor::v ? &ConstantUncertainties::gain_v : &ConstantUncertainties::gain_a;
}

/// The uncertainty of the gain of the drive, where one sensor measured that of all histories; else nullptr.
double ConstantUncertainties::* gain_of_drive(const std::vector<ForwardTest>& tests) {
  const auto all = [&](bool has_y, bool has_force) {
    return std::ranges::all_of(tests, [&](const ForwardTest& test) {
      return test.history->y.empty() != has_y && test.history->force.empty() != has_force;
    });
  };
  if (all(true, false)) return &ConstantUncertainties::gain_y;
  return all(false, true) ? &ConstantUncertainties::gain_force : nullptr;
}

/// Names the number that each relaxation sets free, if all that may be stated with an uncertainty has a relaxation.
void name_stated(HistoryRelaxations& list, const std::vector<ForwardTest>& tests, const KnownConstants& constants) {
  double ConstantUncertainties::* const drive = gain_of_drive(tests);
  if (drive == nullptr) return;
  for (std::size_t j = 0; j < list.parts.size(); ++j) {
    const FreedPart& part = list.parts[j];
    Relaxation& relaxation = list.relaxations[j];
    if (relaxation.freed == Freed::mass) {
      relaxation.stated = &ConstantUncertainties::mass;
      relaxation.stated_unit = constants.mass;
    } else if (relaxation.freed == Freed::stiffness) {
      relaxation.stated = &ConstantUncertainties::stiffness;
      relaxation.stated_unit = constants.stiffness;
    } else if (relaxation.freed == Freed::gain) {
      relaxation.stated = part.kind == Kind::gain ? gain_of(part.sensor) : drive;
    }
  }
}

}  // namespace

/// A vibration has a mean speed that x tells, and hardly a mean acceleration.
std::vector<FreeZero> free_zeros(const std::vector<ForwardTest>& tests, const MotionScale& scale) {
  const auto mean = [](const std::vector<double>& signal) {
    return std::reduce(signal.begin(), signal.end()) / static_cast<double>(signal.size());
  };
  const double unit_of_a = scale.speed * scale.speed / scale.length;
  std::vector<FreeZero> list;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const History& history = *tests[t].history;
    const double duration = static_cast<double>(history.x.size() - 1) / history.sample_rate;
    const double speed = (history.x.back() - history.x.front()) / duration;
    if (!history.v.empty())
      list.push_back({t, MotionSensor::v, scale.speed, (mean(history.v) - speed) / scale.speed});
    if (!history.a.empty()) list.push_back({t, MotionSensor::a, unit_of_a, mean(history.a) / unit_of_a});
  }
  return list;
}

double share_of(const FreedPart& part, std::size_t test, std::size_t tests) {
  return part.history == test ? 1.0 : -1.0 / (static_cast<double>(tests) - 1.0);
}

HistoryRelaxations history_relaxations(const std::vector<ForwardTest>& tests, const KnownConstants& constants) {
  const auto has = [&](std::vector<double> History::* signal) {
    return std::ranges::any_of(tests, [&](const ForwardTest& test) { return !(test.history->*signal).empty(); });
  };
  HistoryRelaxations list;
  add_constants(list, constants);
  add_terms(list, are_alike_decays(tests));
  add_contrasts(list, tests.size());
  const bool beside_x = has(&History::v) || has(&History::a) || has(&History::y) || has(&History::force);
  if (beside_x) add_reading(list, "x", MotionSensor::x);
  add(list, Assumption::sensors, "corner frequency of x free", {.kind = Kind::corner});
  list.relaxations.back().sign = 1;
  add(list, Assumption::sensors, "square term of the sensor of x", {.kind = Kind::square});
  // In a decay of x alone a cubic term is friction over speed.
  if (beside_x) add(list, Assumption::sensors, "cubic term of the sensor of x", {.kind = Kind::cube});
  add(list, Assumption::sensors, "zero of x free", {.kind = Kind::zero});
  add(list, Assumption::stationarity, "zero of x that drifts", {.kind = Kind::zero_drift});
  if (has(&History::v)) add_reading(list, "v", MotionSensor::v);
  if (has(&History::a)) add_reading(list, "a", MotionSensor::a);
  name_stated(list, tests, constants);
  return list;
}

Eigen::MatrixXd HistoryReader::operator()(MotionSensor sensor, const std::vector<double>& measured,
                                          const SensorMotion& motion, const Eigen::MatrixXd& columns,
                                          const Eigen::MatrixXd& slopes) const {
  const auto own = [&](auto act) {
    for (std::size_t j = 0; j < wanted.size(); ++j)
      if (const FreedPart& part = parts[wanted[j]]; part.sensor == sensor)
        act(part.kind, at.g[static_cast<Eigen::Index>(wanted[j])], static_cast<Eigen::Index>(j));
  };
  SensorErrors errors;
  own([&](FreedPart::Kind kind, double g, Eigen::Index) {
    if (kind == FreedPart::Kind::gain) errors.gain += g;
    if (kind == FreedPart::Kind::delay) errors.delay = g;
    if (kind == FreedPart::Kind::corner) errors.corner = g;
    if (kind == FreedPart::Kind::square) errors.square = g / length;
    if (kind == FreedPart::Kind::cube) errors.cube = g / (length * length);
    if (kind == FreedPart::Kind::zero) errors.zero += g * length;
    if (kind == FreedPart::Kind::zero_drift) errors.drift = g * length;
  });
  const auto zero = std::ranges::find_if(zeros, [&](const FreeZero& other) { return other.is_of(test, sensor); });
  const Eigen::Index place = zero - zeros.begin();
  if (zero != zeros.end()) errors.zero += zero->unit * at.zeros[place];
  if (sensor == MotionSensor::x) errors.zero += layout.zero(at.p, test);
  Eigen::MatrixXd rows = reading_rows(measured, motion, errors, columns, slopes);
  if (zero != zeros.end()) rows.col(1 + at.p.size() + place).setConstant(zero->unit);
  if (sensor == MotionSensor::x) layout.put_zeros(test, rows.middleCols(1, at.p.size()));
  const Eigen::ArrayXd u = as_read(motion.value, motion.slope, errors, motion.rate).array();
  const Eigen::ArrayXd slope = errors.gain * errors.slope(u);
  own([&](FreedPart::Kind kind, double, Eigen::Index j) {
    auto to = rows.col(1 + at.p.size() + at.zeros.size() + j);
    if (kind == FreedPart::Kind::gain) to = errors.reading(u);
    if (kind == FreedPart::Kind::delay)
      to = -slope * as_read(motion.slope, motion.curvature, errors, motion.rate).array();
    if (kind == FreedPart::Kind::corner) to = slope * by_corner(u.matrix(), motion.rate, errors.corner).array();
    if (kind == FreedPart::Kind::square) to = errors.gain * u.square() / length;
    if (kind == FreedPart::Kind::cube) to = errors.gain * u.cube() / (length * length);
    if (kind == FreedPart::Kind::zero) to.setConstant(length);
    if (kind == FreedPart::Kind::zero_drift) to = length * course_of(rows.rows());
  });
  return rows;
}

}  // namespace dualdamp::identify
