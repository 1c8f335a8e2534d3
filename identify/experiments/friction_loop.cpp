#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "identify/experiments/experiment.hpp"
#include "identify/experiments/velocity_parabola.hpp"
#include "identify/records/held_path.hpp"
#include "identify/records/rest_samples.hpp"
#include "identify/records/swings.hpp"
#include "identify/records/usable_histories.hpp"
#include "identify/statistics/median.hpp"
#include "identify/statistics/noise_between_jumps.hpp"
#include "identify/statistics/noise_level.hpp"
#include "sim/law_host/law_host.hpp"
#include "sim/law_host/loaded_contacts.hpp"
#include "sim/work_limit.hpp"

namespace dualdamp::identify {

namespace {

using friction::Direction;
using friction::direction_of;
using friction::Instant;

double noise_of(const std::vector<double>& samples) {
  RobustNoiseLevel level;
  level.add(samples);
  return level.deviation();
}

class FrictionLoop final : public Experiment {
 public:
  FrictionLoop(const History& history, const ExperimentOptions& options)
      : start_(history.start), rate_(history.sample_rate), x_(history.x), v_(history.v), a_(history.a) {
    kind = ExperimentKind::loop;
    force_noise_ = options.sigma_force > 0.0 ? options.sigma_force : noise_between_jumps(history.force);
    complete(history, options.has_mass);
    path_x_ = law_x_;
    path_v_ = law_v_;
    hold(still_stretches(stuck_, {history.x, noise_of(history.x)}, {history.v, noise_of(history.v)}), path_x_,
         path_v_);
    agrees_ = !history.x.empty() && !history.v.empty();
    if (!history.x.empty()) agreed_x_ = agreed_path();
    if (agrees_) path_x_ = agreed_x_;
    const double speed = largest_swing(law_v_);
    // The zero of the sensor of a velocity drives its integral away.
    const auto duration = static_cast<double>(law_v_.size() - 1) / rate_;
    motion = {history.x.empty() ? speed / crossing_frequency(law_v_, duration) : largest_swing(law_x_), speed};
    std::vector<double> force = history.force;
    bridge(force);
    force_ = force;
    if (filter_) force = (*filter_)(force);
    const bool is_stated = options.sigma_force > 0.0;
    Signal signal{.name = "force",
                  .unit = "N",
                  .measured = std::vector<double>(force.begin() + static_cast<std::ptrdiff_t>(edge_),
                                                  force.end() - static_cast<std::ptrdiff_t>(edge_)),
                  .at_name = "t",
                  .at_unit = "s",
                  .noise = force_noise_ * (filter_ ? filter_->noise_gain() : 1.0),
                  .is_stated = is_stated,
                  .is_sampled = true,
                  .filter = filter_};
    for (std::size_t i = edge_; i + edge_ < force.size(); ++i) {
      signal.at.push_back(start_ + static_cast<double>(i) / rate_);
      if (stuck_[i]) signal.stuck.push_back(i - edge_);
      if (!history.x.empty()) signal.companion.values.push_back(history.x[i]);
    }
    if (!history.x.empty()) signal.companion = {"x", "m", std::move(signal.companion.values)};
    signals.push_back(std::move(signal));
    record_others = {RecordParameter::offset, RecordParameter::travel, RecordParameter::offset_force};
    if (history.x.empty()) record_of_place = {RecordParameter::offset};
  }

  [[nodiscard]] bool predict(const sim::Model& model, const RecordValues& of_record,
                             Eigen::VectorXd& outputs) const override {
    const sim::Oscillator& o = model.oscillator;
    const double offset = of_record[RecordParameter::offset];
    std::vector<double> force(x_.size(), of_record[RecordParameter::offset_force]);
    const bool holds = std::ranges::any_of(model.friction, &friction::Law::holds_mass);
    constexpr long samples_of_unit = 8;
    *work += static_cast<long>(x_.size()) / samples_of_unit;
    for (const friction::Law& law : model.friction)
      if (!add(law, offset, of_record[RecordParameter::travel], model.solver.tolerance, force)) return false;
    bridge(force);
    for (std::size_t i = 0; i < force.size(); ++i) {
      if (o.mass > 0.0) force[i] += o.mass * a_[i];
      if (o.stiffness > 0.0) force[i] -= sim::spring_force(o, offset - x_[i]);
      if (!std::isnan(o.damping)) force[i] += o.damping * v_[i];
      // What holds the mass at rest is known from the measured force alone.
      if (holds && stuck_[i]) force[i] = force_[i];
    }
    if (filter_) force = (*filter_)(force);
    outputs = Eigen::Map<const Eigen::VectorXd>(force.data() + edge_,
                                                static_cast<Eigen::Index>(signals.front().measured.size()));
    return outputs.allFinite();
  }

  [[nodiscard]] std::vector<std::string> objections(const sim::Model& model,
                                                    const RecordValues& of_record) const override {
    std::vector<std::string> all = objections_of_sticks(model, of_record);
    const std::size_t samples = samples_of_reversal(model, of_record);
    const std::string missing = core::joined(derived, " and ");
    if (samples > 0 && samples <= reach_of_difference)
      all.push_back(
          "the contact reverses within " + std::to_string(samples) + " sample" + (samples == 1 ? "" : "s") +
          ", where " + missing +
          " by differences of seven points is not exact: a contact stiffness may lie outside its interval; "
          "measure " +
          missing + ", or sample faster");
    return all;
  }

 private:
  /// Samples to one side that a difference of seven points needs, and one for the place of the reversal between
  /// two.
  static constexpr std::size_t reach_of_difference = 4;

  /// After how many samples most of the friction has changed its sign at a reversal: the median over reversals. 0
  /// if all signals were measured, or if no law has a memory: `bridge` allows for the jump of a rigid friction.
  [[nodiscard]] std::size_t samples_of_reversal(const sim::Model& model, const RecordValues& of_record) const {
    std::vector<double> force(x_.size(), 0.0);
    bool has_any = false;
    for (const friction::Law& law : model.friction) {
      if (!filter_ || turns_.empty() || !law.has_memory()) continue;
      has_any = true;
      if (!add(law, of_record[RecordParameter::offset], of_record[RecordParameter::travel], model.solver.tolerance,
               force))
        return 0;
    }
    const auto [low, high] = std::ranges::minmax(force);
    if (!has_any || !(high > low)) return 0;
    constexpr double most = 0.8;
    std::vector<std::size_t> counts;
    for (const std::size_t i : turns_) {
      std::size_t end = i;
      while (end + 1 < force.size() && std::abs(force[end] - force[i - 1]) < most * (high - low)) ++end;
      counts.push_back(std::max<std::size_t>(end - i, 1));
    }
    const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
    std::ranges::nth_element(counts, middle);
    return *middle;
  }

  /// Says if the mass sticks under forces that the friction does not hold.
  [[nodiscard]] std::vector<std::string> objections_of_sticks(const sim::Model& model,
                                                              const RecordValues& of_record) const {
    if (!std::ranges::any_of(model.friction, &friction::Law::holds_mass) ||
        std::ranges::any_of(model.friction, depends_on_past))
      return {};
    const double offset = of_record[RecordParameter::offset];
    constexpr double rare = 4.0;
    double most = 0.0;
    double bound = 0.0;
    std::size_t held_count = 0;
    std::size_t count = 0;
    for (const auto& [begin, end] : deep_rests()) {
      const double inertia =
          std::isnan(model.oscillator.mass) ? 0.0 : model.oscillator.mass * mean_rate(begin, end);
      for (std::size_t i = begin; i < end; ++i) {
        Instant now = instant(i, offset);
        now.v = 0.0;
        double held = force_[i] - of_record[RecordParameter::offset_force] - inertia;
        double limit = 0.0;
        if (model.oscillator.stiffness > 0.0) held += sim::spring_force(model.oscillator, offset - x_[i]);
        for (const friction::Law& law : model.friction) {
          held -= law.force({}, now, Direction::none);
          limit += law.static_limit({}, now);
        }
        ++held_count;
        if (!(std::abs(held) > limit + rare * force_noise_)) continue;
        ++count;
        if (std::abs(held) - limit > most - bound) most = std::abs(held), bound = limit;
      }
    }
    constexpr double share = 0.02;
    if (static_cast<double>(count) <= share * static_cast<double>(held_count)) return {};
    return {"the mass sticks under a force of " + core::format_number(most, 3) +
            " N, and the friction of the fit holds at most " + core::format_number(bound, 3) +
            " N: its static level is higher, or the mass did not rest"};
  }

  [[nodiscard]] static bool depends_on_past(const friction::Law& law) {
    return law.has_memory() || law.has_rates() || law.delay() > 0.0 || law.advances();
  }

  /// Completes the signals. If one is a derivative, all forces are filtered. The acceleration is not counted as a
  /// derivative if no mass needs it.
  void complete(const History& history, bool has_mass) {
    const bool lacks_speed = history.v.empty();
    derive_missing(has_mass);
    law_x_ = x_;
    law_v_ = v_;
    std::optional<ZeroPhaseFilter> of_path;
    if (!derived.empty()) of_path = choose_filters(history, lacks_speed);
    find_rests(lacks_speed, of_path);
    if (!filter_) return;
    find_turns();
    bridge_signals();
  }

  /// Differentiates or integrates the signals that were not measured.
  void derive_missing(bool has_mass) {
    const bool lacks_speed = v_.empty();
    if (lacks_speed) derived.emplace_back("v");
    if (has_mass && a_.empty()) derived.emplace_back("a");
    if (x_.empty()) x_ = sharp_integral(v_, rate_);
    if (lacks_speed) v_ = sharp_difference(x_, rate_);
    if (a_.empty()) a_ = lacks_speed ? sharp_second_difference(x_, rate_) : sharp_difference(v_, rate_);
  }

  /// Sets the filter of the forces, unless the record allows none, and filters a position that the laws need
  /// differentiated. Returns the filter of the position.
  std::optional<ZeroPhaseFilter> choose_filters(const History& history, bool lacks_speed) {
    History whole = history;
    whole.x = x_;
    const double cutoff = cutoffs_for(whole, {}).front();
    if (!(cutoff > 0.0) || !fault_of_cutoff(whole, cutoff).empty()) return std::nullopt;
    filter_.emplace(cutoff, rate_);
    edge_ = filter_->edge();
    // The smear of the filter is as long as the period of its cut-off over pi.
    smear_ = static_cast<std::size_t>(std::ceil(rate_ / (std::numbers::pi * cutoff)));
    if (!lacks_speed) return filter_;
    std::optional<ZeroPhaseFilter> of_path = filter_of_path(cutoff);
    law_x_ = (*of_path)(x_);
    law_v_ = sharp_difference(law_x_, rate_);
    return of_path;
  }

  void find_rests(bool lacks_speed, const std::optional<ZeroPhaseFilter>& of_path) {
    stuck_ = rest_samples(law_v_, lacks_speed ? noise_of_speed(x_, rate_, of_path) : noise_of_speed(v_), smear_);
    if (!lacks_speed || !filter_) return;
    // Equal readings of the position, which the filter mixes with others.
    const std::vector<bool> equal = rest_samples(v_, 0.0, smear_);
    for (std::size_t i = 0; i < stuck_.size(); ++i) stuck_[i] = stuck_[i] || equal[i];
  }

  void find_turns() {
    for (std::size_t i = 1; i + 2 < law_v_.size(); ++i) {
      if (stuck_[i] && stuck_[i + 1]) continue;
      if (law_v_[i] != 0.0 && law_v_[i] * law_v_[i + 1] >= 0.0) continue;
      const std::size_t nearest = std::abs(law_v_[i]) <= std::abs(law_v_[i + 1]) ? i : i + 1;
      if (turns_.empty() || turns_.back() != nearest) turns_.push_back(nearest);
    }
  }

  /// As `bridge`, but by the filtered signals: the mean of two derivatives has noise of all frequencies.
  void bridge_signals() {
    for (std::vector<double>* signal : {&x_, &v_, &a_}) {
      const std::vector<double> smooth = (*filter_)(*signal);
      for (const std::size_t i : turns_) (*signal)[i] += 0.5 * (smooth[i - 1] + smooth[i + 1]) - smooth[i];
    }
  }

  /// The filter of the measured position on the way to the laws. A contact that reverses bends the velocity, and a
  /// low cut-off rounds this bend: the contact would seem stiffer. So the cut-off is raised by factors of two as
  /// far as the velocity still passes through zero at once: until its noise is a small share of its change from
  /// sample to sample there. Beyond a fifth of the sample rate, differences of seven points do not follow the
  /// position.
  [[nodiscard]] ZeroPhaseFilter filter_of_path(double cutoff) const {
    ZeroPhaseFilter best = *filter_;
    const std::vector<double> v = sharp_difference(best(x_), rate_);
    std::vector<double> changes;
    for (std::size_t i = 0; i + 1 < v.size(); ++i)
      if (v[i] * v[i + 1] < 0.0) changes.push_back(std::abs(v[i + 1] - v[i]));
    if (changes.empty()) return best;
    constexpr double small = 0.05;
    constexpr double highest = 0.2;
    const double most = small * upper_median(std::move(changes));
    for (double next = 2.0 * cutoff; next <= highest * rate_; next *= 2.0) {
      const ZeroPhaseFilter filter(next, rate_);
      if (noise_of_speed(x_, rate_, filter) > most) break;
      best = filter;
    }
    return best;
  }

  /// The force may jump at a reversal, and a filter would spread the jump of a sample on the wrong side of it. The
  /// sample next to a reversal is replaced by the mean of its neighbours, in the measured force and in all that is
  /// predicted.
  void bridge(std::vector<double>& force) const {
    const std::vector<double> before = turns_.empty() ? std::vector<double>() : force;
    for (const std::size_t i : turns_) force[i] = 0.5 * (before[i - 1] + before[i + 1]);
  }

  /// Stretches of samples at rest, without the samples at their ends.
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> deep_rests() const {
    constexpr std::size_t beside = 3;  // a difference of seven points feels the motion
    constexpr std::size_t least = 5;
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (std::size_t begin = 0; begin < stuck_.size();) {
      std::size_t end = begin;
      while (end < stuck_.size() && stuck_[end]) ++end;
      const std::size_t cut = smear_ + beside;
      if (end - begin >= 2 * cut + least) found.emplace_back(begin + cut, end - cut);
      begin = std::max(end, begin + 1);
    }
    return found;
  }

  /// Mean acceleration between two samples, from the means of the velocity in both halves: a slow reversal is no
  /// rest.
  [[nodiscard]] double mean_rate(std::size_t begin, std::size_t end) const {
    const auto half = static_cast<std::ptrdiff_t>((end - begin) / 2);
    const auto first = law_v_.begin() + static_cast<std::ptrdiff_t>(begin);
    const double early = std::accumulate(first, first + half, 0.0);
    const double late = std::accumulate(first + half, first + 2 * half, 0.0);
    return (late - early) * rate_ / static_cast<double>(half * half);
  }

  /// The zero of the sensor of x does not act on a law.
  [[nodiscard]] Instant instant(std::size_t i, double offset) const {
    return {static_cast<double>(i) / rate_, law_x_[i] - offset, law_v_[i]};
  }

  /// Positions at the samples. `agrees`: see agreed_path().
  struct Way {
    const std::vector<double>& x;
    bool agrees = false;
  };

  /// On the path that moves a law with a memory.
  [[nodiscard]] Instant on_path(const Way& way, std::size_t i, double offset) const {
    return {static_cast<double>(i) / rate_, way.x[i] - offset, path_v_[i]};
  }

  /// Adds the force of a law. A law without memory needs no path between the samples. Positions that were
  /// differentiated may still go against the velocity beside a rest, which stops a contact: it then moves as the
  /// velocity says.
  [[nodiscard]] bool add(const friction::Law& law, double offset, double travel, double tolerance,
                         std::vector<double>& force) const {
    if (!depends_on_past(law)) {
      for (std::size_t i = 0; i < force.size(); ++i)
        force[i] += law.force({}, instant(i, offset), direction_of(law_v_[i]));
      return true;
    }
    return add_along({path_x_, agrees_}, law, offset, travel, tolerance, force) ||
           (!agrees_ && !agreed_x_.empty() && add_along({agreed_x_, true}, law, offset, travel, tolerance, force));
  }

  /// Adds the force of a law with a memory along a path; leaves `force` as it was if the law cannot follow it.
  [[nodiscard]] bool add_along(const Way& way, const friction::Law& law, double offset, double travel,
                               double tolerance, std::vector<double>& force) const {
    std::vector<double> own(force.size(), 0.0);
    sim::LawHost host = sim::loaded_host(law, on_path(way, 0, offset), travel);
    host.leave_out_energy();
    host.set_tolerance(tolerance);
    host.limit_steps(std::min(most_steps(), sim::WorkLimit::most()));
    if (const Direction first = direction_of(path_v_[0]); travel == 0.0 || first != host.direction())
      host.change_direction(first);
    own[0] = host.force();
    for (std::size_t i = 1; i < own.size() && !host.broken(); ++i) {
      move(host, way, i, offset);
      own[i] = host.force();
    }
    *work += host.steps();
    if (!sim::WorkLimit::allows(host.steps()) || host.broken()) return false;
    std::ranges::transform(force, own, force.begin(), std::plus<>());
    return true;
  }

  /// As for a history: a loop that needs ten times the usual number has parameters far off.
  [[nodiscard]] long most_steps() const {
    constexpr long least = 100'000;
    constexpr long of_sample = 50;
    return least + of_sample * static_cast<long>(law_v_.size());
  }

  /// Lets the position go on as the velocity says. Measured positions would go against it by their noise, and a
  /// contact would slip backwards without end. The path follows the measured position by a tenth of the difference
  /// in each sample, as far as half of what the velocity says allows.
  [[nodiscard]] std::vector<double> agreed_path() const {
    constexpr double share = 0.1;
    constexpr double most = 0.5;
    std::vector<double> x = path_x_;
    for (std::size_t i = 1; i < x.size(); ++i) {
      const double step = velocity_before(path_v_, rate_, i).path(1.0 / rate_);
      const double allowed = path_v_[i - 1] * path_v_[i] < 0.0 ? 0.0 : most * std::abs(step);
      const double before = x[i - 1] + step;
      x[i] = before + std::clamp(share * (x[i] - before), -allowed, allowed);
    }
    return x;
  }

  /// Moves the law from sample i - 1 to sample i. The velocity is a parabola, which may cross zero once.
  void move(sim::LawHost& host, const Way& way, std::size_t i, double offset) const {
    const Instant from = on_path(way, i - 1, offset);
    const Instant to = on_path(way, i, offset);
    const double h = to.t - from.t;
    const VelocityParabola along = velocity_before(path_v_, rate_, i);
    const double step = along.path(h);
    // The step of the position is that of the velocity, but for a factor if both agree, or for a constant speed.
    const bool has_factor = way.agrees && from.v * to.v >= 0.0 && step != 0.0;
    const double factor = has_factor ? (to.x - from.x) / step : 1.0;
    const double left = way.agrees ? 0.0 : (to.x - from.x - step) / h;
    const sim::Path path = [from, along, factor, left](double t) {
      const double s = t - from.t;
      return Instant{t, from.x + factor * along.path(s) + left * s, from.v + s * (along.slope + s * along.curve)};
    };
    if (from.v * to.v < 0.0) {
      // The root of the parabola between the samples, without cancellation.
      const double root = std::sqrt(std::max(0.0, along.slope * along.slope - 4.0 * along.curve * from.v));
      const double turn = 2.0 * from.v / (-along.slope + std::copysign(root, from.v));
      host.move_along(from.t + std::clamp(turn, 0.0, h), path);
      host.change_direction(direction_of(to.v));
    } else if (from.v == 0.0 && to.v != 0.0) {
      host.change_direction(direction_of(to.v));
    }
    host.move_along(to.t, path);
  }

  double start_;
  double rate_;
  std::vector<double> x_, v_, a_;        ///< measured, or derivatives or integrals of what was measured
  std::vector<double> law_x_, law_v_;    ///< for the laws: filtered before they are differentiated
  std::vector<double> path_x_, path_v_;  ///< for laws with a memory: see hold(), agreed_path()
  std::vector<double> agreed_x_;         ///< of agreed_path(); empty without a measured position
  bool agrees_ = false;                  ///< the path is this one: both x and v were measured
  std::optional<ZeroPhaseFilter> filter_;
  std::vector<double> force_;  ///< measured, before the filter
  double force_noise_ = 0.0;
  std::vector<bool> stuck_;         ///< samples at which the mass sticks
  std::vector<std::size_t> turns_;  ///< samples next to a reversal, if there is a filter
  std::size_t edge_ = 0;
  std::size_t smear_ = 0;  ///< of the filter, to each side
};

}  // namespace

std::unique_ptr<Experiment> friction_loop(const History& history, const ExperimentOptions& options,
                                          std::string& fault) {
  constexpr std::size_t least = 8;
  if (history.force.size() >= least && (!history.x.empty() || !history.v.empty()))
    return std::make_unique<FrictionLoop>(history, options);
  fault = "a loop needs the columns t, force, and x or v, and eight samples";
  return nullptr;
}

}  // namespace dualdamp::identify
