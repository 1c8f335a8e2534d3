#include "identify/fit/intervals/profile.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/constants.hpp"
#include "identify/statistics/decompositions.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

/// Beyond this multiple of the limit, the growth may come from steps that led nowhere.
constexpr double doubtful = 2.0;

/// Relative accuracy of an end: of the width of its bracket, and of the growth to its limit.
constexpr double close = 0.02;

/// A value is first only glanced at if its distance from the inner end of the bracket is more than this part of its
/// distance from the estimate.
constexpr double nearby = 0.3;

/// Damping with which a search starts if undamped steps led nowhere.
constexpr double least_damping = 0.01;

/// One side of a profile: distances from the estimate, in the unit of the parameter. Those of a parameter that is
/// sought by its logarithm are of the logarithm, times the estimate.
struct Side {
  double sign = 1.0;
  double estimate = 0.0;
  bool is_logarithmic = false;
  friction::Range range;

  [[nodiscard]] double last_value() const { return sign < 0.0 ? range.low : range.high; }
  [[nodiscard]] double distance_of(double value) const {
    return sign * (is_logarithmic ? estimate * std::log(value / estimate) : value - estimate);
  }
  [[nodiscard]] double value_at(double distance) const {
    if (distance >= distance_of(last_value())) return last_value();
    const double value =
        is_logarithmic ? estimate * std::exp(sign * distance / estimate) : estimate + sign * distance;
    return std::clamp(value, range.low, range.high);
  }
};

/// Where the growth of a profile reaches its limit: between two distances from the estimate, with the growths there
/// over the limit.
struct Bracket {
  double inner = 0.0;
  double inner_growth = 0.0;
  double outer = core::infinity;
  double outer_growth = 0.0;
  bool is_glance = false;  ///< the growth at the outer distance was not searched to its end

  /// The root by a new point. The growth is nearly linear, except at a jump, which is halved.
  [[nodiscard]] double guess(double distance, double growth) const {
    constexpr double half = 0.5;
    if (growth > doubtful) return inner + half * (distance - inner);
    constexpr double least = 1e-3;
    return inner + (distance - inner) * (1.0 - inner_growth) / std::max(growth - inner_growth, least);
  }

  void take(double distance, double growth, bool by_glance = false) {
    if (growth < 1.0)
      inner = distance, inner_growth = growth;
    else
      outer = distance, outer_growth = growth, is_glance = by_glance;
  }

  /// Whether the ends are so close that the root is known, or that a glance is to be followed by a search.
  [[nodiscard]] bool is_closed() const { return outer - inner < (is_glance ? nearby : close) * outer; }

  /// A guess, at least a tenth inside of both ends.
  [[nodiscard]] double within(double next) const {
    constexpr double farthest = 4.0;
    if (std::isinf(outer)) return std::clamp(next, 1.1 * inner, farthest * inner);
    const double margin = 0.1 * (outer - inner);
    return std::clamp(next, std::max(inner + margin, outer / farthest), outer - margin);
  }
};

}  // namespace

bool bends(const FittedParameter& fitted, double quantile) {
  constexpr double much = 0.25;
  const double width = quantile * fitted.std;
  return std::abs(fitted.profile95[0] - fitted.interval95[0]) > much * width ||
         std::abs(fitted.profile95[1] - fitted.interval95[1]) > much * width;
}

Profiler::Profiler(const FitProblem& problem, const Eigen::VectorXd& weights, const Eigen::VectorXd& q,
                   const Eigen::MatrixXd& rows, const Eigen::VectorXd& residuals, const LastMotions& motions)
    : problem_(problem),
      weights_(weights),
      q_(q),
      rows_(rows),
      residuals_(residuals),
      motions_(motions),
      squares_(residuals.squaredNorm()),
      lower_(static_cast<std::size_t>(q.size())),
      first_in_vain_(std::numeric_limits<Eigen::Index>::max() - 1) {}

void Profiler::for_each(Eigen::Index count, const std::function<void(Eigen::Index)>& work) {
  sim::in_parts(static_cast<std::size_t>(count), 1, 0,
                [&](std::size_t i, std::size_t) { work(static_cast<Eigen::Index>(i)); });
}

Profiler::ProfilePath Profiler::at(const Eigen::VectorXd& q, const Eigen::VectorXd& residuals,
                                   const Eigen::MatrixXd& rows, LastMotions motions) const {
  ProfilePath path{q, residuals, rows, gram(rows), Eigen::VectorXd::Ones(q.size()), std::move(motions)};
  for (Eigen::Index j = 0; j < q.size(); ++j)
    if (path.normal(j, j) > 0.0) path.unit[j] = 1.0 / std::sqrt(path.normal(j, j));
  return path;
}

Eigen::VectorXd Profiler::step(Eigen::Index i, double value, const ProfilePath& path, double damping) const {
  // Lagrange's multiplier, in units of `path.unit`. A parameter that would leave its range is held at the end of
  // the range, and the step of the others is computed again.
  const Eigen::Index size = q_.size();
  // A value that one coordinate sets is held exactly, however far it is: a factor of it is no slope.
  const bool is_alone = other_of(i, path.q) < 0;
  const Eigen::VectorXd slope = is_alone ? Eigen::VectorXd(Eigen::VectorXd::Unit(size, i))
                                         : problem_.space().slope(path.q).row(i).transpose();
  const double change =
      is_alone ? placed(i, value, path.q)[i] - path.q[i] : value - problem_.space().values(path.q)[i];
  const Eigen::VectorXd row = path.unit.cwiseProduct(slope);
  const double scale = row.norm();
  Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(size + 1, size + 1);
  bordered.topLeftCorner(size, size) = in_units(path.normal, path.unit);
  constexpr double least = 0.1;  // of the size of a coordinate
  for (Eigen::Index j = 0; damping > 0.0 && j < size; ++j) {
    const bool is_logarithm = problem_.space()[j].logarithmic;
    const double whole = is_logarithm ? 1.0 : std::max(std::abs(path.q[j]), least);
    bordered(j, j) += std::pow(damping * growth_of(path.residuals) * path.unit[j] / whole, 2);
  }
  bordered.block(0, size, size, 1) = row / scale;
  bordered.block(size, 0, 1, size) = row.transpose() / scale;
  Eigen::VectorXd right(size + 1);
  right.head(size) = -path.unit.cwiseProduct(path.rows.transpose() * path.residuals);
  right[size] = change / scale;
  for (Eigen::Index held = 0;; ++held) {
    const Eigen::VectorXd found = shortest_solution(bordered, right);
    Eigen::VectorXd q = path.q + path.unit.cwiseProduct(found.head(size));
    Eigen::Index leaving = -1;
    for (Eigen::Index j = 0; j < size; ++j) {
      const SearchCoordinate& c = problem_.space()[j];
      const double inside = std::clamp(q[j], c.low, c.high);
      constexpr double rounding = 1e-12;
      const bool may_be_held = j != i || other_of(i, path.q) >= 0;
      if (std::abs(inside - q[j]) > rounding * (1.0 + std::abs(inside)) && may_be_held && leaving < 0) leaving = j;
      q[j] = inside;
    }
    // Where directions without effect are left out of the solution, it may miss the value.
    if (leaving < 0 || held == size) return placed(i, value, q);
    const double shift = (q[leaving] - path.q[leaving]) / path.unit[leaving];
    right -= shift * bordered.col(leaving);
    bordered.row(leaving).setZero();
    bordered.col(leaving).setZero();
    bordered(leaving, leaving) = 1.0;
    right[leaving] = shift;
  }
}

Eigen::Index Profiler::other_of(Eigen::Index i, const Eigen::VectorXd& q) const {
  const Eigen::MatrixXd slope = problem_.space().slope(q);
  for (Eigen::Index j = 0; j < q.size(); ++j)
    if (j != i && slope(i, j) != 0.0) return j;
  return -1;
}

Eigen::VectorXd Profiler::placed(Eigen::Index i, double value, const Eigen::VectorXd& q) const {
  Eigen::VectorXd values = problem_.space().values(q);
  values[i] = value;
  if (const std::optional<std::size_t>& least = problem_.space().above(i)) {
    double& other = values[static_cast<Eigen::Index>(*least)];
    other = std::min(other, value);
  }
  return problem_.space().point(values);
}

double Profiler::growth_of(const Eigen::VectorXd& residuals) const {
  return std::sqrt(std::max(residuals.squaredNorm() - squares_, 0.0));
}

std::optional<double> Profiler::growth_with_others_fixed(Eigen::Index i, double value, ProfilePath& path) const {
  Eigen::VectorXd q = placed(i, value, path.q);
  Eigen::VectorXd outputs;
  if (!problem_.outputs(q, outputs, &path.motions)) return std::nullopt;
  path.q = std::move(q);
  path.residuals = problem_.readings().misses(outputs).cwiseProduct(weights_);
  return growth_of(path.residuals);
}

std::optional<double> Profiler::growth(Eigen::Index i, double value, double limit, bool glances,
                                       ProfilePath& path) const {
  const ProfilePath before = path;
  const double astray = glances ? doubtful * limit : core::infinity;
  std::optional<double> best = growth_by_steps(i, value, core::infinity, 0.0, astray, path);
  if (best && *best <= limit) return best;
  if (glances && !(best && *best <= astray)) return best;
  // The others may have moved across a jump of the sum of squares, such as that of one stick more.
  ProfilePath beside = before;
  const std::optional<double> unfollowed = growth_with_others_fixed(i, value, beside);
  const bool led_nowhere = unfollowed && (!best || *unfollowed < *best);
  if (led_nowhere) path = beside, best = unfollowed;
  if (!unfollowed || *best <= limit || (!led_nowhere && *best <= doubtful * limit)) return best;
  // One of the others may have nearly no effect: a small error of its derivative moves it to the end of its range.
  const std::optional<double> damped =
      growth_by_steps(i, value, *unfollowed, least_damping, core::infinity, beside);
  if (damped && *damped < *best) path = std::move(beside), best = damped;
  return best;
}

bool Profiler::take(Eigen::Index i, const Eigen::VectorXd& q, ProfilePath& path, double& best) const {
  Eigen::VectorXd outputs;
  if (!problem_.outputs(q, outputs, &path.motions)) return false;
  Eigen::VectorXd residuals = problem_.readings().misses(outputs).cwiseProduct(weights_);
  const double found = growth_of(residuals);
  if (!(found < best)) return true;
  best = found;
  path.q = q;
  path.residuals = std::move(residuals);
  note(i, path, best);
  return true;
}

void Profiler::note(Eigen::Index i, const ProfilePath& path, double growth) const {
  // In variances of a reading. A smaller gain only means that the search ended near enough to the minimum.
  constexpr double margin = 0.05;
  constexpr double much = 1.0;
  constexpr double beyond_any_limit = 10.0;
  const double gain = (1.0 - path.residuals.squaredNorm() / squares_) * static_cast<double>(residuals_.size());
  const std::lock_guard lock(mutex_);
  if (growth < beyond_any_limit) places_.emplace_back(problem_.space().values(path.q), growth);
  std::optional<Lower>& lower = lower_[static_cast<std::size_t>(i)];
  if (gain > (lower ? lower->gain : margin)) lower = {path.q, gain};
  if (gain > much) first_in_vain_ = std::min(first_in_vain_, i);
}

bool Profiler::is_in_vain(Eigen::Index i) const {
  const std::lock_guard lock(mutex_);
  return first_in_vain_ <= i;
}

std::optional<Eigen::VectorXd> Profiler::lower() const {
  const Lower* best = nullptr;
  for (Eigen::Index i = 0; i < std::min(first_in_vain_ + 1, q_.size()); ++i)
    if (const auto& lower = lower_[static_cast<std::size_t>(i)];
        lower && (best == nullptr || lower->gain > best->gain))
      best = &*lower;
  return best != nullptr ? std::optional(best->q) : std::nullopt;
}

std::optional<double> Profiler::growth_by_steps(Eigen::Index i, double value, double best, double damping,
                                                double astray, ProfilePath& path) const {
  const auto result = [&] { return std::isfinite(best) ? std::optional<double>(best) : std::nullopt; };
  // A bent valley needs many sets of derivatives; elsewhere, the first set suffices.
  constexpr int most_derivatives = 12;
  constexpr int most_steps = 4;
  constexpr double settled = 0.01;
  constexpr double stronger = 10.0;
  constexpr double most_damping = 1e4;
  for (int derivative = 0;; ++derivative) {
    const double begun = best;
    bool is_settled = false;
    for (int round = 0; round < most_steps && !is_settled; ++round) {
      const double before = best;
      const Eigen::VectorXd q = step(i, value, path, damping);
      const Eigen::VectorXd from = path.q;
      if (!take(i, q, path, best)) return result();
      // A step out of the range of the derivatives is tried again with a shorter length.
      constexpr double shorter = 0.3;
      if (!(best < before) && std::isfinite(before) && !take(i, from + shorter * (q - from), path, best))
        return result();
      if (!(best < before) && damping > 0.0 && damping < most_damping) {
        damping *= stronger;
        continue;
      }
      if (!(best < before)) break;
      damping = damping > 0.0 ? std::max(damping / stronger, least_damping) : 0.0;
      is_settled = before - best <= settled * best;
    }
    if (is_settled || derivative == most_derivatives || best > astray) return result();
    if (derivative > 1 && !(begun - best > settled * best)) return result();
    Eigen::VectorXd outputs;
    Eigen::MatrixXd jacobian;
    if (!problem_.derivatives(path.q, outputs, jacobian, false, &path.motions)) return result();
    path = at(path.q, path.residuals, weights_.asDiagonal() * jacobian, std::move(path.motions));
  }
}

bool Profiler::acts_faintly(Eigen::Index i, const FittedParameter& fitted, double limit) const {
  const double norm = rows_.col(i).norm();
  return std::isnan(fitted.std) && problem_.space()[i].logarithmic && norm > 0.0 && norm < limit;
}

double Profiler::first_distance(Eigen::Index i, const FittedParameter& fitted, double limit) const {
  if (!std::isnan(fitted.std)) return limit * fitted.std;
  if (acts_faintly(i, fitted, limit)) return std::abs(problem_.space().slope(q_)(i, i));
  // A parameter without an effect near the estimate may have one further off.
  const double norm = rows_.col(i).norm();
  constexpr double near = 1e-3;
  return norm > 0.0 ? limit * problem_.space().slope(q_)(i, i) / norm
                    : near * std::abs(problem_.space().slope(q_)(i, i));
}

std::optional<double> Profiler::best_growth(Eigen::Index i, double value, double limit, const ProfilePath* within,
                                            bool glances, ProfilePath& others) const {
  std::optional<double> best = growth(i, value, limit, glances, others);
  if (within == nullptr || (best && *best <= limit)) return best;
  ProfilePath again = *within;
  const std::optional<double> grown = growth(i, value, limit, glances, again);
  if (!grown || (best && *best <= *grown)) return best;
  others = std::move(again);
  return grown;
}

double Profiler::end(Eigen::Index i, const FittedParameter& fitted, double limit, double sign,
                     const ProfileStart& start) const {
  const SearchCoordinate& c = problem_.space()[i];
  const Side side{sign, fitted.value, c.logarithmic, fitted.parameter.range};
  const double whole_way = side.distance_of(side.last_value());
  Eigen::VectorXd at_end = q_;
  at_end[i] = sign < 0.0 ? c.low : c.high;
  const double farthest = problem_.space().values(at_end)[i];
  const double begun = side.distance_of(start.value);
  Bracket bracket;
  if (begun > 0.0) bracket.take(begun, start.growth / limit);
  double distance = bracket.inner + first_distance(i, fitted, limit);
  ProfilePath others = start.path;
  ProfilePath within = others;
  double last = 0.0;
  // A step of the sum of squares may be some thousand times shorter than the first distance.
  const int most_rounds = problem_.is_stepped(i) ? 40 : 24;
  int glances_left = problem_.is_stepped(i) ? 0 : 8;
  for (int round = 0; round < most_rounds && !is_in_vain(i); ++round) {
    distance = std::min(distance, whole_way);  // beyond it all distances are one place
    const double value = side.value_at(distance);
    // Far off, the derivatives may lead out of a bent valley. Such a value is searched from nearer ones only.
    const bool glances = glances_left > 0 && distance - bracket.inner > nearby * distance;
    const bool has_two = last > 1.0 && !bracket.is_glance;
    const std::optional<double> grown = best_growth(i, value, limit, has_two ? &within : nullptr, glances, others);
    const bool is_astray = glances && (!grown || *grown > doubtful * limit);
    if (!grown && !is_astray) return unknown;
    last = grown ? *grown / limit : core::infinity;
    if (is_astray) others = within, --glances_left;
    if (std::abs(last - 1.0) < close) return value;
    if (last < 1.0 && value == side.last_value()) return value;
    if (last < 1.0 && acts_faintly(i, fitted, limit) && sign * (value - farthest) >= 0.0) return side.last_value();
    const double next = bracket.guess(distance, last);
    bracket.take(distance, last, is_astray);
    if (last < 1.0) within = others;
    if (bracket.is_closed()) {
      // The others may reach from here what they did not reach from further off.
      if (!(bracket.outer_growth > doubtful)) return side.value_at(bracket.outer);
      others = within;
      const std::optional<double> again = growth(i, side.value_at(bracket.outer), limit, false, others);
      const bool is_outer = !again || *again >= limit;
      if (is_outer && !bracket.is_glance) return side.value_at(bracket.outer);
      if (is_outer)
        bracket.take(bracket.outer, again ? *again / limit : core::infinity);
      else
        within = others, bracket = {bracket.outer, *again / limit};
    }
    distance = bracket.within(next);
  }
  constexpr double near = 0.1;
  return std::abs(last - 1.0) < near && !is_in_vain(i) ? side.value_at(distance) : unknown;
}

std::optional<Profiler::ProfileStart> Profiler::away_from(Eigen::Index weak, Eigen::Index i, double limit,
                                                          double sign) const {
  constexpr double far = 2.0;
  const double weak_value = problem_.space().values(q_)[weak];
  const std::pair<Eigen::VectorXd, double>* best = nullptr;
  for (const auto& place : places_) {
    const double factor = place.first[weak] / weak_value;
    if (place.second > limit || (factor < far && factor > 1.0 / far)) continue;
    if (best == nullptr || sign * (place.first[i] - best->first[i]) > 0.0) best = &place;
  }
  if (best == nullptr) return std::nullopt;
  const Eigen::VectorXd q = problem_.space().point(best->first);
  Eigen::VectorXd outputs;
  Eigen::MatrixXd jacobian;
  LastMotions motions = motions_;
  if (!problem_.derivatives(q, outputs, jacobian, false, &motions)) return std::nullopt;
  return ProfileStart{at(q, problem_.readings().misses(outputs).cwiseProduct(weights_),
                         weights_.asDiagonal() * jacobian, std::move(motions)),
                      best->first[i], best->second};
}

void Profiler::search_on(Eigen::Index weak, Eigen::Index i, double limit, FittedParameter& fitted) const {
  for (const double sign : {-1.0, 1.0}) {
    const std::optional<ProfileStart> start = away_from(weak, i, limit, sign);
    const double found = start ? end(i, fitted, limit, sign, *start) : unknown;
    double& side = fitted.profile95[sign < 0.0 ? 0 : 1];
    if (sign * (found - side) > 0.0) side = found;
  }
}

void Profiler::widen(std::vector<FittedParameter>& parameters, const Eigen::VectorXd& limits) const {
  if (are_in_vain()) return;
  const auto is_weak = [&](Eigen::Index i) {
    const FittedParameter& fitted = parameters[static_cast<std::size_t>(i)];
    return limits[i] > 0.0 && problem_.space()[i].logarithmic && !(fitted.std < fitted.value);
  };
  for (Eigen::Index weak = 0; weak < limits.size(); ++weak)
    for (Eigen::Index i = 0; is_weak(weak) && i < limits.size(); ++i)
      if (i != weak && limits[i] > 0.0) search_on(weak, i, limits[i], parameters[static_cast<std::size_t>(i)]);
  for (Eigen::Index i = 0; i < limits.size(); ++i) {
    Interval& interval = parameters[static_cast<std::size_t>(i)].profile95;
    for (const auto& [values, growth] : places_) {
      if (growth > limits[i]) continue;
      if (values[i] < interval[0]) interval[0] = values[i];
      if (values[i] > interval[1]) interval[1] = values[i];
    }
  }
}

Interval Profiler::interval(Eigen::Index i, const FittedParameter& fitted, double limit) const {
  const ProfileStart start{at(q_, residuals_, rows_, motions_), fitted.value, 0.0};
  Interval found = {end(i, fitted, limit, -1.0, start), end(i, fitted, limit, 1.0, start)};
  if (const std::optional<std::size_t>& least = problem_.space().above(i)) {
    const double lowest = problem_.space().values(q_)[static_cast<Eigen::Index>(*least)];
    ProfilePath others = at(q_, residuals_, rows_, motions_);
    const bool is_lower = found[0] > lowest;
    if (const auto grown = is_lower ? growth(i, lowest, limit, false, others) : std::nullopt;
        grown && *grown <= limit)
      found[0] = lowest;
  }
  return found;
}

}  // namespace dualdamp::identify
