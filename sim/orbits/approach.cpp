#include "sim/orbits/approach.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "sim/engine/closed_form.hpp"
#include "sim/neutral_margin.hpp"
#include "sim/orbits/least_amplitude.hpp"
#include "sim/orbits/orbit_account.hpp"

namespace dualdamp::sim {

namespace {

/// Newton's method is tried if the motion closes this well over one forcing period, or over several.
constexpr double near_orbit = 1e-2;
constexpr double near_longer_orbit = 1e-3;

/// Whatever the closure, Newton's method is tried after this number of periods, or after this part of the work that
/// the motion may take, and again each time that either has grown by four.
constexpr int first_trial = 32;
constexpr long first_trial_of_work = 16;

/// A motion creeps if it closes this well after thousands of periods and still is not periodic.
constexpr double creeping = 1e-3;

/// A deviation from an orbit below this part of the motion counts as zero.
constexpr double arrived = 1e-9;

/// Error of a Floquet multiplier under the exact engine: a double root is known to half the digits.
constexpr double least_multiplier_error = 1.5e-8;

/// A motion that does not close comes nearer to an orbit if its Floquet multiplier is below 1 by more than
/// rounding, and is not there yet if the product with the number of periods is still small. On a continuum a motion
/// that creeps is displaced by 1/n in period n, so that this product is of order 1.
constexpr double multiplier_rounding = 1e-10;
constexpr double not_there = 0.1;
/// Above this product the motion would be there: what keeps it from closing is no slow displacement.
constexpr double long_there = 10.0;

/// A motion still grows if every steady state is larger by this factor.
constexpr double far_larger = 2.0;

/// A motion that closes this well is compared with its rounding.
constexpr double near_rounding = 1e-8;

/// Most and fewest forcing periods over which the growth of a perturbation is measured.
constexpr std::size_t periods_of_divergence = 200;
constexpr std::size_t least_periods_of_divergence = 20;
/// Mean logarithmic growth of a perturbation in one forcing period above which the motion is aperiodic: neither
/// rounding nor a slow transient grows so fast.
constexpr double diverging = 0.03;

/// What the rounding of positions in a forcing period is made of.
class Rounding : public PeriodObserver {
 public:
  void begin(const State& start) override { speed_ = std::abs(start.v); }
  void observe(const Interval& interval, double /*x*/) override {
    for (const double part : {0.0, 0.5, 1.0})
      speed_ = std::max(speed_, std::abs(interval.at(part * interval.duration).v));
    if (const ClosedForm* form = interval.closed_form()) terms_ = std::max(terms_, form->terms(form->x));
  }
  /// The largest |v|, at start, middle and end of the intervals [m/s].
  [[nodiscard]] double speed() const { return speed_; }
  /// The largest sum of the moduli of the terms whose sum is the position [m]: it exceeds the position by far where
  /// a mass hardly moves under a large drive, or against a friction that would stretch the spring by metres.
  [[nodiscard]] double terms() const { return terms_; }

 private:
  double speed_ = 0.0;
  double terms_ = 0.0;
};

constexpr const char* neighbours =
    "not unique: a Floquet multiplier lies on the unit circle, so that neighbouring orbits are steady too; this is "
    "the one that the motion approaches";
constexpr const char* hardly_attracting =
    "hardly attracts: a Floquet multiplier is within 1e-6 of the unit circle, so that the motion approaches this "
    "steady state very slowly; whether neighbouring orbits are steady too, the computation cannot tell";
constexpr const char* repelling =
    "unstable: a Floquet multiplier lies outside the unit circle; the motion stays on this "
    "orbit only while nothing disturbs it";

/// Ok unless every steady state is far larger than the motion has ever been [m].
core::Outcome growth_beyond_friction(const Model& model, double largest) {
  const double least = least_amplitude(model);
  if (least == core::infinity)
    return {core::OutcomeKind::no_steady_state,
            "no steady state: the amplitude grows without bound: at an undamped resonance the drive exceeds 4/pi "
            "times the largest friction force"};
  if (!(least > far_larger * largest)) return {};
  return {core::OutcomeKind::no_steady_state,
          "no steady state found: the amplitude still grows, to at least " + core::format_number(least, 3) + " " +
              model.unit("m") + ": near a resonance the drive exceeds 4/pi times the largest friction force"};
}

}  // namespace

Approach::Approach(const Model& model, const SteadyStateOptions& options, PeriodMap& map, OrbitSolver& solver,
                   Motions motions)
    : model_(model),
      options_(options),
      omega_(model.excitation.frequency),
      map_(map),
      solver_(solver),
      motions_(motions),
      has_past_(map.engine().has_past()),
      recurrence_(omega_),
      growth_(options.max_periods),
      patience_(patience_with(map.engine().accuracy(), options.most_work)),
      begun_at_(map.engine().work()),
      next_trial_(first_trial),
      next_trial_work_(patience_.work / first_trial_of_work) {
  solver_.limit(patience_.work);
  // A single period may exceed the limit by half.
  map_.limit(begun_at_ + patience_.work + patience_.work / 2);
  level_.fill(near_longer_orbit);
  level_[1] = near_orbit;
}

std::optional<Orbit> Approach::find(SteadyState& result) {
  ForcingPeriod period =
      options_.from ? map_.from(*options_.from, Monodromy::without)
                    : map_.from_start(model_.initial.position, model_.initial.velocity, Monodromy::without);
  recurrence_.add(period.begin, period.size);
  std::optional<Orbit> orbit;
  while (map_.outcome().ok()) {
    ++passed_;
    ++result.transient_periods;
    growth_.observe(period.size);
    recurrence_.add(period.end, period.size);
    creep_.observe(recurrence_.closure(1), period.size);
    size_ = period.size;
    orbit = look(period, result);
    if (orbit || growth_.is_endless() || passed_ >= options_.max_periods || divergence_ > diverging) break;
    if (is_followed_enough() || creeps()) break;
    period = map_.next(Monodromy::without);
  }
  if (!orbit && map_.outcome().ok()) orbit = nearly_there(result);
  if (!orbit) result.outcome = failure();
  return orbit;
}

/// Examines the motion after one more period: the orbit, if it has been reached.
std::optional<Orbit> Approach::look(const ForcingPeriod& period, SteadyState& result) {
  std::optional<Orbit> orbit = closed(period.end);
  if (!orbit && has_arrived(period.end)) orbit = at_start(*candidate_);
  if (orbit && !has_past_) orbit = solver_.refined(solver_.with_shortest_period(*std::move(orbit)));
  if (orbit) {
    if (!has_past_ && period.moves) warn_of_multipliers(orbit->period.radius(), result);
    return orbit;
  }
  if (!has_past_) try_candidate(period.end);
  if (needs_divergence()) {
    has_divergence_ = true;
    divergence_ = divergence(period.end);
  }
  return std::nullopt;
}

/// Largest error of a Floquet multiplier on the unit circle.
double Approach::error_of_multiplier() const {
  return std::max(least_multiplier_error, 10.0 * map_.engine().accuracy());
}

void Approach::warn_of_multipliers(double radius, SteadyState& result) const {
  if (radius > 1.0 + neutral_margin) {
    result.warnings.emplace_back(repelling);
  } else if (radius >= 1.0 - error_of_multiplier()) {
    result.warnings.emplace_back(neighbours);
  } else if (radius >= 1.0 - neutral_margin) {
    result.warnings.emplace_back(hardly_attracting);
  }
}

/// Whether the motion has used its share of the work; attempts to find an orbit near it have their own share.
bool Approach::is_followed_enough() const { return map_.engine().work() - begun_at_ >= patience_.work; }

/// Whether the motion becomes periodic within no reasonable time, and no orbit was found near it. Under the exact
/// engine periods are cheap, so that such a motion is followed to its end.
bool Approach::creeps() const {
  return map_.engine().accuracy() > 0.0 && !has_past_ && !candidate_ && creep_.goes_on();
}

bool Approach::needs_divergence() const {
  // Motions that cannot part do not run away from each other, whatever rounding makes of them.
  if (has_divergence_ || has_past_ || motions_ != Motions::may_part) return false;
  return passed_ >= patience_.periods || is_followed_enough();
}

/// The number of periods after which a costly examination is due again, at least `least` from now. Waits grow with
/// the motion, so that even a long one is examined only some tens of times.
long Approach::next_after(long least) const { return passed_ + least + passed_ / 8; }

/// The orbit, if the motion has come back within rounding. After one forcing period it need not attract.
std::optional<Orbit> Approach::closed(const State& state) {
  int periods = recurrence_.shortest((has_past_ ? 1.0 : 10.0) * options_.tolerance);
  if (periods == 0 && is_closed_within_rounding(state)) periods = 1;
  if (periods == 0 || (periods > 1 && (motions_ != Motions::may_part || passed_ < next_closing_)))
    return std::nullopt;
  // The state of a motion that depends on its past cannot be displaced.
  const Monodromy monodromy = has_past_ ? Monodromy::without : Monodromy::with;
  Orbit orbit{solver_.patient_map_over(periods).from(state, monodromy), periods};
  // At a loose tolerance it may come back while it still moves across the border to another mode.
  if (!orbit.period.ends_in_its_mode()) return std::nullopt;
  // An undamped own motion comes back too, if its period fits that of the drive.
  if (periods > 1 && !has_past_ && !(orbit.period.free_radius() < 1.0 - neutral_margin)) {
    // A motion that winds towards its orbit comes back like this in every period: so it is not examined again at
    // once.
    next_closing_ = next_after(1);
    return std::nullopt;
  }
  return orbit;
}

/// Whether the last forcing period closed as well as rounding lets it. The time of an event is rounded as the time
/// since the period began, and meanwhile the mass goes on by its speed: a mass that rests at one place, then at
/// another, and goes over in a thousandth of the period comes back to a thousand times the rounding of its
/// position. The position itself is rounded as the largest of the terms whose sum it is.
bool Approach::is_closed_within_rounding(const State& state) {
  const double closure = recurrence_.closure(1);
  if (has_past_ || !(closure <= near_rounding) || passed_ < next_rounding_) return false;
  next_rounding_ = next_after(1);
  constexpr double errors = 8.0;  // of one event each
  constexpr double eps = std::numeric_limits<double>::epsilon();
  Rounding rounding;
  const ForcingPeriod period = solver_.patient_map_over(1).from(state, Monodromy::without, &rounding);
  const double lengths = core::two_pi / omega_ * rounding.speed() + rounding.terms();
  return closure * period.size <= errors * eps * lengths;
}

/// Gives the motion to the candidate, once in each of its periods; true if the motion approaches the candidate.
bool Approach::has_arrived(const State& state) {
  if (!candidate_ || (passed_ - candidate_->found_at) % candidate_->orbit.period_ratio != 0) return false;
  candidate_->attraction.observe(state);
  if (candidate_->attraction.approaches() && holds_ahead(*candidate_)) return true;
  if (candidate_->attraction.leaves()) {
    others_.push_back(std::move(candidate_->orbit));
    candidate_.reset();
  }
  return false;
}

/// Whether a motion that seems to approach the candidate would do so from where it is led. If motions never part,
/// it does. A test costs some tens of periods of the orbit, so after a failure the next one waits.
bool Approach::holds_ahead(const Candidate& candidate) {
  if (motions_ != Motions::may_part || has_past_) return true;
  const bool is_cheap = map_.engine().accuracy() == 0.0;  // a period of the exact engine
  if (passed_ < next_look_ahead_ || (is_cheap && candidate.attraction.arrives_soon())) return false;
  if (candidate.attraction.holds_ahead(solver_.patient_map_over(candidate.orbit.period_ratio))) return true;
  next_look_ahead_ = next_after(8);
  return false;
}

/// The number of forcing periods after which the motion has come back well enough for Newton's method, for a whole
/// period of its own: a return by chance does not last as long. 0: none.
int Approach::worth_trying() {
  int shortest = 0;
  // If two motions never part, the motion and itself some periods later do not: a longer period would not attract.
  const std::size_t longest = motions_ == Motions::may_part ? longest_period : 1;
  for (std::size_t periods = longest; periods >= 1; --periods) {
    const bool back = recurrence_.closure(static_cast<int>(periods)) <= level_[periods];
    streak_[periods] = back ? streak_[periods] + 1 : 0;
    if (streak_[periods] >= static_cast<int>(periods)) shortest = static_cast<int>(periods);
  }
  return shortest;
}

/// Whether a trial is due by periods or by work: if a period takes more work, there will be fewer periods.
bool Approach::is_due() {
  // If the motion is in another mode than a period ago, Newton's method has no step.
  if (!std::isfinite(recurrence_.closure(1))) return false;
  const long spent = map_.engine().work() - begun_at_;
  const bool by_periods = passed_ >= next_trial_;
  const bool by_work = spent >= next_trial_work_;
  if (by_periods) next_trial_ = 4 * passed_;
  if (by_work) next_trial_work_ = 4 * spent;
  return by_periods || by_work;
}

void Approach::try_candidate(const State& state) {
  int periods = worth_trying();
  if (is_due() && periods == 0 && !candidate_) periods = 1;
  if (periods == 0) return;
  double& level = level_[static_cast<std::size_t>(periods)];
  level = 0.1 * std::min(level, recurrence_.closure(periods));
  streak_[static_cast<std::size_t>(periods)] = 0;
  std::optional<Orbit> orbit = solver_.near(state, periods);
  if (!orbit) return;
  if (periods > 1 && never_moves(*orbit)) {
    PeriodMap& single = solver_.patient_map_over(1);
    orbit = Orbit{single.from(orbit->period.begin, Monodromy::with), 1};
    // Slips within rounding may end it in another mode.
    if (!single.outcome().ok() || !orbit->period.ends_in_its_mode()) return;
  }
  if (candidate_ && solver_.same(candidate_->orbit, *orbit)) return;
  if (candidate_) others_.push_back(std::move(candidate_->orbit));
  const double resolution = std::max(arrived, 100.0 * map_.engine().accuracy());
  Attraction attraction(orbit->period, omega_, resolution, solver_.error(*orbit));
  attraction.observe(state);
  candidate_.emplace(Candidate{std::move(*orbit), std::move(attraction), passed_});
}

/// Whether the mass only makes slips below rounding: these are no subharmonic motion (orbit_account.cpp).
bool Approach::never_moves(const Orbit& orbit) {
  PeriodMap map(model_, orbit.period_ratio);
  return outline_of_orbit(model_, map, orbit.period.begin, orbit.period_ratio).never_moves();
}

/// The orbit of a candidate, moved on so that its period begins as the motion's periods do, at t = 0.
Orbit Approach::at_start(const Candidate& candidate) {
  const int ratio = candidate.orbit.period_ratio;
  return solver_.later(candidate.orbit, (ratio - candidate.found_at % ratio) % ratio);
}

/// The candidate, if the limit of periods is reached and the motion has come nearer to it up to then.
std::optional<Orbit> Approach::nearly_there(SteadyState& result) {
  if (!candidate_ || growth_.is_endless()) return std::nullopt;
  if (!candidate_->attraction.has_come_nearer()) return std::nullopt;
  result.warnings.emplace_back("the motion still approaches this steady state after " + std::to_string(passed_) +
                               " forcing periods");
  return solver_.refined(solver_.with_shortest_period(at_start(*candidate_)));
}

/// Mean logarithmic growth of a perturbation in one forcing period: approximately the largest Lyapunov exponent.
/// The first half is left out, because a position that drifts grows too, but ever more slowly.
double Approach::divergence(const State& state) {
  PeriodMap& map = solver_.patient_map_over(1);
  map.limit(map.engine().work() + patience_.work / 4);
  ForcingPeriod period = map.from(state, Monodromy::with);
  Eigen::VectorXd perturbation = Eigen::VectorXd::Ones(period.monodromy.cols());
  perturbation[1] = omega_;
  std::vector<double> growth;
  while (growth.size() < periods_of_divergence && map.outcome().ok()) {
    if (period.monodromy.cols() != perturbation.size() || !period.monodromy.allFinite()) return 0.0;
    const auto size = [&](const Eigen::VectorXd& d) { return std::hypot(d[0], d[1] / omega_); };
    const Eigen::VectorXd grown = period.monodromy * perturbation;
    if (!(size(grown) > 0.0)) return 0.0;
    growth.push_back(std::log(size(grown) / size(perturbation)));
    perturbation = grown / size(grown);
    period = map.next(Monodromy::with);
  }
  if (growth.size() < least_periods_of_divergence) return 0.0;
  growth.erase(growth.begin(), growth.begin() + static_cast<std::ptrdiff_t>(growth.size() / 2));
  return std::accumulate(growth.begin(), growth.end(), 0.0) / static_cast<double>(growth.size());
}

/// The number of forcing periods after which the motion repeats itself, if it is above `longest_period`; 0: none
/// was found.
long Approach::longer_period() {
  constexpr double share = 0.1;  // of the periods so far
  if (has_past_) return 0;
  const State start = map_.engine().state();
  PeriodMap& map = solver_.patient_map_over(1);
  State state = start;
  for (long n = 1; static_cast<double>(n) <= share * static_cast<double>(passed_); ++n) {
    state = map.from(state, Monodromy::without).end;
    if (!map.outcome().ok()) return 0;
    if (distance(start, state, size_, omega_) < same_orbit) return n > longest_period ? n : 0;
  }
  return 0;
}

/// That a pendulum turns over and over, so that its angle has no period; ok if it does not.
core::Outcome Approach::rotation() {
  const Oscillator& o = model_.oscillator;
  const bool turns_freely =
      o.gravity_stiffness > 0.0 && o.gravity_stiffness == o.stiffness && o.cubic_stiffness == 0.0;
  if (!turns_freely || !map_.outcome().ok() || !(size_ > core::two_pi)) return {};
  const double begin = map_.engine().position();
  PeriodMap& map = solver_.patient_map_over(1);
  State state = map_.engine().state();
  for (std::size_t n = 0; n < longest_period; ++n) state = map.from(state, Monodromy::without).end;
  const double turns = (state.x - begin) / core::two_pi;
  if (!map.outcome().ok() || !(std::abs(turns) >= 1.0)) return {};
  return {core::OutcomeKind::no_steady_state,
          "no steady state: the pendulum rotates, by " + core::format_number(turns, 4) + " turns in " +
              std::to_string(longest_period) + " forcing periods: its angle has no period"};
}

/// Why the integration found no orbit.
core::Outcome Approach::failure() {
  if (core::Outcome rotates = rotation(); !rotates.ok()) return rotates;
  const core::Outcome& followed = map_.outcome();
  // Work grows with the amplitude, so it may end before the growth is certain.
  const bool is_cut_short = is_followed_enough() || followed.kind == core::OutcomeKind::event_limit;
  if ((followed.ok() && growth_.has_grown()) || (is_cut_short && growth_.goes_on_now())) {
    return {core::OutcomeKind::no_steady_state,
            "no steady state: the amplitude still grows; damping limits it at a much larger amplitude, or never"};
  }
  if (!followed.ok()) return followed;
  if (core::Outcome grows = growth_beyond_friction(model_, growth_.largest()); !grows.ok()) return grows;
  if (divergence_ > diverging) {
    return {core::OutcomeKind::no_steady_state,
            "no steady state: the motion is aperiodic: it has not come back within " + std::to_string(passed_) +
                " forcing periods, and neighbouring motions run away from it"};
  }
  if (creeps()) {
    return {
        core::OutcomeKind::no_steady_state,
        "no steady state found: the motion creeps, or its contacts age, so that it approaches a periodic motion only "
        "slowly: after " +
            std::to_string(passed_) + " forcing periods it still differs by " +
            core::percent(recurrence_.closure(1), 2) + " from one period to the next, and the mass stays within " +
            core::format_number(size_, 3) + " " + model_.unit("m") + " of zero"};
  }
  if (is_followed_enough()) {
    const std::string vibration = map_.engine().fast_vibration();
    return {core::OutcomeKind::no_steady_state,
            "no steady state found: the computation was stopped: the motion has not become periodic within " +
                std::to_string(passed_) + " forcing periods, and it has too many events or steps in each" +
                (vibration.empty() ? "" : ": " + vibration)};
  }
  if (motions_ == Motions::meet_sliding) {
    return {core::OutcomeKind::no_steady_state,
            "no steady state found: there is one, but the motion approaches it too slowly, or the mass moves by "
            "hardly more than rounding"};
  }
  const std::string after = " after " + std::to_string(passed_) + " forcing periods";
  if (recurrence_.closure(1) < creeping) {
    const double radius =
        has_past_ ? 1.0 : solver_.patient_map_over(1).from(map_.engine().state(), Monodromy::with).free_radius();
    const double nearer = 1.0 - radius;
    if (nearer > multiplier_rounding && nearer * static_cast<double>(passed_) < not_there)
      return {core::OutcomeKind::no_steady_state,
              "no steady state found: the motion approaches one too slowly: its distance falls by " +
                  core::format_number(nearer, 2) + " of itself in each forcing period, so that it is not there" +
                  after};
    if (nearer * static_cast<double>(passed_) > long_there)
      return {core::OutcomeKind::no_steady_state,
              "no steady state found: neighbouring motions approach each other, but the motion still differs by " +
                  core::percent(recurrence_.closure(1), 2) + " from one forcing period to the next" + after};
    return {core::OutcomeKind::not_unique,
            "not unique: steady states form a continuum, and the motion still creeps along it" + after};
  }
  if (const long period = longer_period(); period > 0)
    return {core::OutcomeKind::no_steady_state, "no steady state of at most " + std::to_string(longest_period) +
                                                    " forcing periods: the motion repeats itself after " +
                                                    std::to_string(period) + " of them"};
  return {core::OutcomeKind::no_steady_state, "no steady state: the motion has not become periodic" + after};
}

}  // namespace dualdamp::sim
