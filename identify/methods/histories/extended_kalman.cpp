#include "identify/methods/histories/extended_kalman.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/cancellation.hpp"
#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/records/usable_histories.hpp"
#include "identify/statistics/noise_level.hpp"
#include "identify/statistics/statistics.hpp"
#include "identify/uncertainty/parametric_bootstrap.hpp"

namespace dualdamp::identify {

namespace {

/// State (x, v, F0, c) and its covariance.
struct Belief {
  Eigen::Vector4d state = Eigen::Vector4d::Zero();
  Eigen::Matrix4d P = Eigen::Matrix4d::Zero();
};

/// Constants of the filter.
struct Setting {
  double mass = 1.0;
  double stiffness = 1.0;
  double width = 1.0;  ///< of the smoothed sign [m/s]
  double noise = 1.0;  ///< of x [m]
  int steps = 1;       ///< of integration in a sample, near a change of the sign
  int few_steps = 1;   ///< where the sign is saturated
};

/// Rates of state and covariance under the drive k y + f.
Belief rates(const Belief& at, double drive, const Setting& setting) {
  const double x = at.state[0], v = at.state[1], F0 = at.state[2], c = at.state[3];
  const double sign = std::tanh(v / setting.width);
  const double slope = (1.0 - sign * sign) / setting.width;
  Belief rate;
  rate.state << v, (drive - setting.stiffness * x - c * v - F0 * sign) / setting.mass, 0.0, 0.0;
  // Only the first two rows of A P are not zero.
  Eigen::Matrix4d AP = Eigen::Matrix4d::Zero();
  AP.row(0) = at.P.row(1);
  AP.row(1) = Eigen::RowVector4d(-setting.stiffness, -c - F0 * slope, -sign, -v) * at.P / setting.mass;
  rate.P = AP + AP.transpose();
  return rate;
}

Belief moved(const Belief& from, const Belief& rate, double by) {
  return {from.state + by * rate.state, from.P + by * rate.P};
}

/// Steps over a sample interval: many only if the velocity may come near zero.
int steps_over(const Belief& at, double from, double to, double interval, const Setting& setting) {
  constexpr double saturated = 8.0;  // widths: 1 - tanh^2 is 5e-7 there
  constexpr double margin = 1.5;
  const double x = at.state[0], v = at.state[1], F0 = at.state[2], c = at.state[3];
  const double pull = std::max(std::abs(from - setting.stiffness * x), std::abs(to - setting.stiffness * x));
  const double change = (pull + std::abs(c * v) + std::abs(F0)) / setting.mass * interval;
  return std::abs(v) > saturated * setting.width + margin * change ? setting.few_steps : setting.steps;
}

/// Runge and Kutta's method over one sample interval; the drive is linear in between.
Belief predict(Belief belief, double from, double to, double interval, const Setting& setting) {
  const int steps = steps_over(belief, from, to, interval, setting);
  const double h = interval / steps;
  for (int step = 0; step < steps; ++step) {
    const auto drive = [&](double part) { return from + (to - from) * (step + part) / steps; };
    const Belief k1 = rates(belief, drive(0.0), setting);
    const Belief k2 = rates(moved(belief, k1, 0.5 * h), drive(0.5), setting);
    const Belief k3 = rates(moved(belief, k2, 0.5 * h), drive(0.5), setting);
    const Belief k4 = rates(moved(belief, k3, h), drive(1.0), setting);
    belief.state += h / 6.0 * (k1.state + 2.0 * k2.state + 2.0 * k3.state + k4.state);
    belief.P += h / 6.0 * (k1.P + 2.0 * k2.P + 2.0 * k3.P + k4.P);
  }
  return belief;
}

/// Results of the filter after all samples of a record.
struct FilterRun {
  Belief end;
  double surprise = 0.0;  ///< mean square of the innovations over that expected from P, in the second half
  double miss = 0.0;      ///< rms innovation there [m]
  bool finite = true;
  EstimateCurve curve{"friction_over_time", {{"t", "s", {}}, {"c", "N.s/m", {}}, {"F0", "N", {}}}};
};

FilterRun run_filter(const History& history, const Belief& start, const Setting& setting) {
  const std::size_t n = history.x.size();
  const auto drive = [&](std::size_t i) { return setting.stiffness * history.y_at(i) + history.force_at(i); };
  constexpr std::size_t most_points = 2000;
  const std::size_t every = std::max<std::size_t>(1, n / most_points);
  FilterRun run;
  Belief belief = start;
  double count = 0.0;
  for (std::size_t i = 1; i < n && run.finite; ++i) {
    core::stop_if_cancelled();
    belief = predict(belief, drive(i - 1), drive(i), 1.0 / history.sample_rate, setting);
    const double variance = belief.P(0, 0) + setting.noise * setting.noise;
    const double innovation = history.x[i] - belief.state[0];
    const Eigen::Vector4d gain = belief.P.col(0) / variance;
    belief.state += gain * innovation;
    belief.P -= (gain * belief.P.row(0)).eval();
    belief.P = (0.5 * (belief.P + belief.P.transpose())).eval();
    run.finite = belief.state.allFinite() && belief.P.allFinite() && variance > 0.0;
    if (2 * i > n) {
      run.surprise += innovation * innovation / variance;
      run.miss += innovation * innovation;
      count += 1.0;
    }
    if (i % every != 0) continue;
    run.curve.columns[0].values.push_back(history.start + static_cast<double>(i) / history.sample_rate);
    run.curve.columns[1].values.push_back(belief.state[3]);
    run.curve.columns[2].values.push_back(belief.state[2]);
  }
  run.surprise /= std::max(1.0, count);
  run.miss = std::sqrt(run.miss / std::max(1.0, count));
  run.end = belief;
  return run;
}

/// Scales of the motion, from which the wide initial covariance follows.
struct Scales {
  double length = 0.0;  ///< half of peak to trough [m]
  double speed = 0.0;   ///< m/s
  double noise = 0.0;   ///< m
  double v0 = 0.0;      ///< m/s
};

Scales scales_of(const History& history, const KalmanOptions& options) {
  const auto [low, high] = std::ranges::minmax_element(history.x);
  Scales scales;
  scales.length = 0.5 * (*high - *low);
  const std::vector<double> v =
      history.v.empty() ? five_point_average(central_difference(history.x, history.sample_rate)) : history.v;
  for (const double speed : v) scales.speed = std::max(scales.speed, std::abs(speed));
  scales.v0 = v[2];
  // The smoothed sign is less accurate than good samples. With their true noise the filter would diverge, so it
  // assumes more.
  constexpr double least = 1e-3;
  scales.noise = std::max(options.sigma_x > 0.0 ? options.sigma_x : noise_level(history.x), least * scales.length);
  return scales;
}

Setting setting_for(const Scales& scales, double width, const History& history, const KnownConstants& constants) {
  Setting setting{constants.mass, constants.stiffness, width, scales.noise};
  const double slowest = constants.natural_frequency();
  // The largest rate is that of the smoothed sign, for a friction of a quarter of the spring's force.
  const double steepest = 0.25 * constants.stiffness * scales.length / (constants.mass * width) + slowest;
  const auto steps_for = [&](double rate) {
    constexpr double of_a_step = 0.25;
    return std::clamp(static_cast<int>(std::ceil(rate / history.sample_rate / of_a_step)), 1, 100);
  };
  setting.steps = steps_for(steepest);
  setting.few_steps = steps_for(slowest);
  return setting;
}

Belief ignorance(const History& history, const Scales& scales, const KnownConstants& constants) {
  Belief belief;
  belief.state << history.x[0], scales.v0, 0.0, 0.0;
  const double force = 0.25 * constants.stiffness * scales.length;
  const double damping = 0.5 * std::sqrt(constants.mass * constants.stiffness);
  const Eigen::Vector4d deviation(scales.noise, 0.1 * scales.speed, force, damping);
  belief.P = deviation.cwiseAbs2().asDiagonal();
  return belief;
}

std::string fault_of_run(const FilterRun& run, const Scales& scales) {
  if (!run.finite) return "the filter diverged: give a smaller width of the sign of the velocity";
  constexpr double lost = 0.1;  // of the motion
  if (run.miss > lost * scales.length) return "the filter diverged: it does not follow the motion any more";
  return {};
}

/// (m, c, k, F0), where mass and stiffness are constants; the errors are those of P, scaled by the size of the
/// innovations.
ParameterReading reading_of(const FilterRun& run, const KnownConstants& constants) {
  const Eigen::Vector4d& end = run.end.state;
  const auto error = [&](Eigen::Index i) { return std::sqrt(run.surprise * run.end.P(i, i)); };
  return {Eigen::Vector4d(constants.mass, end[3], constants.stiffness, end[2]),
          Eigen::Vector4d(0.0, error(3), 0.0, error(2))};
}

/// `of_law`: the largest surprise by a synthetic motion of the estimated law.
void judge(const FilterRun& run, double of_law, const std::optional<FilterRun>& wider, Estimate& estimate,
           std::vector<std::string>& faults) {
  constexpr double surprising = 2.0;
  if (run.surprise > surprising) {
    estimate.misreads_its_law = run.surprise <= of_law;
    estimate.findings.push_back("the filter misses the motion by " +
                                core::format_number(std::sqrt(run.surprise), 2) + " times what it expects: " +
                                (estimate.misreads_its_law
                                     ? "it misses motions of its own law by as much, so it does not converge here"
                                     : "the law, a constant or the noise is wrong"));
  }
  const double F0 = estimate.value.F0;
  const double c = estimate.value.c;
  const double change =
      wider ? std::max(std::abs(wider->end.state[2] / F0 - 1.0), std::abs(wider->end.state[3] / c - 1.0))
            : core::infinity;
  constexpr double too_much = 0.1;
  if (change > too_much)
    faults.push_back(wider ? "twice the width of the sign changes the friction by " + core::percent(change, 3)
                           : "with twice the width of the sign the filter diverges");
}

}  // namespace

Estimate extended_kalman(const Record& record, const KnownConstants& constants, const KalmanOptions& options) {
  Estimate estimate;
  estimate.method = extended_kalman_method.name;
  const std::optional<NumberedHistory> longest = longest_history(record, constants, estimate);
  if (!longest) return estimate;
  const auto& [number, history] = *longest;
  const Scales scales = scales_of(*history, options);
  if (!(scales.length > 0.0)) {
    refuse(estimate, "the mass does not move");
    return estimate;
  }
  const auto width_for = [&](const Scales& of) {
    return options.sign_width > 0.0 ? options.sign_width : 0.003 * of.speed;
  };
  const double width = width_for(scales);
  const auto with_width = [&](double w) {
    return run_filter(*history, ignorance(*history, scales, constants),
                      setting_for(scales, w, *history, constants));
  };
  FilterRun run = with_width(width);
  if (std::string fault = fault_of_run(run, scales); !fault.empty()) {
    refuse(estimate, std::move(fault));
    return estimate;
  }
  double of_law = 0.0;
  const auto again = [&](const Record& drawn) -> std::optional<ParameterReading> {
    const History& noisy = drawn.histories.front();
    const Scales its = scales_of(noisy, options);
    const FilterRun other =
        run_filter(noisy, ignorance(noisy, its, constants), setting_for(its, width_for(its), noisy, constants));
    if (!fault_of_run(other, its).empty()) return std::nullopt;
    of_law = std::max(of_law, other.surprise);
    return reading_of(other, constants);
  };
  const Eigen::Vector4d& end = run.end.state;
  set_estimate(estimate, {constants.mass, end[3], constants.stiffness, end[2]},
               parametric_bootstrap({{number, history}}, reading_of(run, constants), 0.0, again));
  estimate.used = {number};
  estimate.curves.push_back(std::move(run.curve));
  std::optional<FilterRun> wider = with_width(2.0 * width);
  if (!fault_of_run(*wider, scales).empty()) wider.reset();
  if (wider)
    estimate.subsets.push_back(
        {"sign width " + core::format_number(2.0 * width, 3) + " " + constants.unit("m/s"),
         static_cast<int>(history->x.size()),
         parameters(ForceParameters{constants.mass, wider->end.state[3], constants.stiffness, wider->end.state[2]}),
         {}});
  std::vector<std::string> faults;
  judge_force_signs(estimate, 0.0, 0.0, faults);
  judge(run, of_law, wider, estimate, faults);
  conclude(estimate, faults,
           "the state after " + std::to_string(history->x.size()) +
               " samples, sign of the velocity smoothed over " + core::format_number(width, 3) + " " +
               constants.unit("m/s"));
  return estimate;
}

constinit const MethodEntry extended_kalman_method{
    .name = "extended_kalman",
    .summary = "viscous and Coulomb friction as states of an extended Kalman filter on the displacement",
    .assumes =
        "mass and stiffness known, y and force without error, a smooth sign of the velocity; checked: twice the width "
        "of that sign, the innovations",
    .equation = "v' = [k (y - x) + f - c v - F0 tanh(v/e)]/m, F0' = c' = 0, extended Kalman filter on x",
    .sources = "liang2004identifying, detchmendy1966",
    .needs = RecordKind::history,
    .lacks = lacks_histories,
    .call = call_of<extended_kalman>,
    .rests_on = AssumptionSet::all_but(Assumption::drive),
};

}  // namespace dualdamp::identify
