#include "identify/methods/any_law/steady_readings.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "core/angle.hpp"
#include "core/constants.hpp"
#include "identify/methods/amplitudes/den_hartog_fit.hpp"
#include "identify/methods/amplitudes/harmonic_balance.hpp"
#include "identify/methods/amplitudes/steady_states.hpp"
#include "sim/orbits/steady_state_near.hpp"
#include "sim/validate.hpp"

namespace dualdamp::identify {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Tolerance of steps and of the closure of orbits over the relative noise of the readings, and its bounds.
/// Amplitudes and phases of 95 orbits in 100 err by at most 20 tolerances, a fiftieth of the noise.
constexpr double closure_over_noise = 1.0 / 1000.0;
constexpr double finest_closure = 1e-8;
constexpr double coarsest_closure = 1e-5;
/// Forcing periods. A laboratory does not wait longer for a steady state.
constexpr int patience = 300;
/// Step of differences, relative to F0 and c.
constexpr double difference_step = 4e-3;

constexpr const char* no_plain_motion =
    "Coulomb and viscous friction fit these data only with a negative force or damping, from which no law can start";

constexpr double stiffness_deviation = 0.05;
constexpr double hardening_deviation = 0.1;
constexpr Index stiffness_unknown = 2;

/// Newton corrections from a neighbour. More of them cost more than a new monodromy matrix.
constexpr int most_corrections = 4;

/// Most work of the search for one law, and as much again for each state. Searches take up to 550,000 in all for
/// ordinary records of five to fifteen states, and up to 1.3 million where the departure is strong. Where the data
/// contradict the constants, the best fit may lie where friction and damping are next to nothing: each state then
/// takes hundreds of periods, and the search minutes.
constexpr long most_work_of_law = 2'000'000;
constexpr long most_work_of_state = 100'000;

struct SteadyOrbits final : NearbyOrbits {
  double accuracy = finest_closure;
  std::vector<std::optional<sim::KnownOrbit>> orbits;
};

/// Phase lag of x [rad], by the trapezoidal rule with `count` samples a period. Harmonics of order `count` - 1 and
/// `count` + 1 are counted as the fundamental: under Coulomb friction they are below 1e-6 of x.
double phase_of(const sim::Model& model, const sim::SteadyState& state) {
  constexpr int count = 64;
  const std::vector<sim::Sample> samples = sim::one_period(model, state, count * state.period_ratio);
  std::complex<double> sum = 0.0;
  // The sample at the end of the period equals that at its beginning.
  for (std::size_t i = 0; i < std::min(samples.size(), static_cast<std::size_t>(count * state.period_ratio)); ++i)
    sum += samples[i].x * std::polar(1.0, -core::two_pi * static_cast<double>(i) / count);
  return model.excitation.phase - std::arg(sum);
}

class SteadyReadings final : public ReadingModel {
 public:
  SteadyReadings(std::vector<Pair> states, const KnownConstants& constants, const ParameterSet& begin,
                 const KnownDeviations& known)
      : states_(std::move(states)), constants_(constants) {
    const auto [low, high] = std::ranges::minmax_element(states_, {}, &Pair::x);
    const auto fastest =
        std::ranges::max_element(states_, {}, [](const Pair& state) { return state.omega * state.x; });
    reference_ = {.amplitude = 0.5 * (low->x + high->x), .frequency = fastest->omega, .Y = fastest->Y};
    take_states(known);
    begin_with(begin, reference_.speed());
  }

  /// States of a record and others.
  SteadyReadings(const ReadingModel& record, std::vector<Pair> states, const KnownConstants& constants,
                 const KnownDeviations& known, const VectorXd& start)
      : states_(std::move(states)), constants_(constants) {
    reference_ = record.reference();
    F0_unit_ = record.F0_unit();
    c_unit_ = record.c_unit();
    take_states(known);
    start_ = VectorXd::Zero(unknowns());
    start_.head(std::min(start.size(), unknowns())) = start.head(std::min(start.size(), unknowns()));
  }

  /// States that are planned.
  SteadyReadings(const ReadingModel& record, std::vector<Pair> states, const KnownConstants& constants,
                 const std::array<double, 2>& deviations)
      : states_(std::move(states)), constants_(constants) {
    reference_ = record.reference();
    F0_unit_ = record.F0_unit();
    c_unit_ = record.c_unit();
    count_states();
    find_twins();
    nuisances_ = spring_nuisances();
    take_readings({});
    known_deviations_ = {deviations[0], deviations[1]};
  }

  [[nodiscard]] std::unique_ptr<NearbyOrbits> no_orbits(const std::vector<double>& deviations) const override {
    auto none = std::make_unique<SteadyOrbits>();
    none->accuracy = std::clamp(closure_over_noise * relative_noise(deviations), finest_closure, coarsest_closure);
    none->orbits.resize(states_.size());
    return none;
  }

  [[nodiscard]] std::optional<VectorXd> residuals(const LawAt& law, const VectorXd& p,
                                                  NearbyOrbits& near) const override {
    auto& orbits = static_cast<SteadyOrbits&>(near).orbits;
    const double accuracy = static_cast<SteadyOrbits&>(near).accuracy;
    VectorXd result(readings_.size());
    Index phase_row = amplitudes();
    std::vector<double> amplitude(states_.size());
    std::vector<double> phase(states_.size());
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const std::size_t twin = twins_[i];
      if (twin == i) {
        if (near.is_exhausted()) return std::nullopt;
        const sim::Model model = model_of(law, p, states_[i], accuracy);
        if (!sim::validate(model).empty()) return std::nullopt;  // a search may try a negative stiffness
        const sim::SteadyState state = found(model, orbits[i]);
        near.work += state.certificate.work();
        if (!state.outcome.ok()) return std::nullopt;
        remember(model, state, orbits[i]);
        amplitude[i] = state.amplitude;
        if (has_phase(states_[i])) phase[i] = phase_of(model, state);
      }
      result[static_cast<Index>(i)] = states_[i].x - amplitude[twin];
      if (has_phase(states_[i])) result[phase_row++] = core::wrapped(states_[i].phase - phase[twin]);
    }
    return result;
  }

  [[nodiscard]] std::optional<Eigen::MatrixXd> derivatives(const LawAt& law, const VectorXd& p,
                                                           const VectorXd& here,
                                                           NearbyOrbits& near) const override {
    Eigen::MatrixXd jacobian(here.size(), unknowns());
    const double damping = 2.0 * p[1] * c_unit_ / constants_.critical_damping();
    for (Index j = 0; j < std::min<Index>(unknowns(), stiffness_unknown + 1); ++j) {
      constexpr double least = 0.25;  // of the unknown's unit
      const double h =
          difference_step * (j == stiffness_unknown ? std::clamp(damping, 1e-3, 0.5) : std::max(p[j], least));
      VectorXd moved = p;
      moved[j] += h;
      SteadyOrbits neighbours = static_cast<SteadyOrbits&>(near);
      const std::optional<VectorXd> there = residuals(law, moved, neighbours);
      near.work = neighbours.work;
      if (!there) return std::nullopt;
      jacobian.col(j) = (here - *there) / h;
      for (Index i = amplitudes(); i < here.size(); ++i) jacobian(i, j) = core::wrapped(here[i] - (*there)[i]) / h;
    }
    if (unknowns() > stiffness_unknown + 1) {
      Index phase_row = amplitudes();
      for (std::size_t i = 0; i < states_.size(); ++i) {
        const double share = share_of_hardening(states_[twins_[i]]);
        const auto row = static_cast<Index>(i);
        jacobian(row, stiffness_unknown + 1) = share * jacobian(row, stiffness_unknown);
        if (!has_phase(states_[i])) continue;
        jacobian(phase_row, stiffness_unknown + 1) = share * jacobian(phase_row, stiffness_unknown);
        ++phase_row;
      }
    }
    return jacobian;
  }

 private:
  [[nodiscard]] Index amplitudes() const { return static_cast<Index>(states_.size()); }
  [[nodiscard]] bool has_phase(const Pair& state) const { return phases_ > 0 && !std::isnan(state.phase); }

  /// Stiffness by the cubic spring for the fundamental, over k3 X^2.
  [[nodiscard]] double share_of_hardening(const Pair& state) const {
    const double in_phase = std::isnan(state.phase) ? 0.0 : std::cos(state.phase);
    const double square = state.x * state.x + state.Y * state.Y - 2.0 * state.x * state.Y * in_phase;
    return 0.75 * square / (reference_.amplitude * reference_.amplitude);
  }

  static std::vector<Nuisance> spring_nuisances() {
    return {{"stiffness", stiffness_deviation}, {"cubic stiffness", hardening_deviation}};
  }

  /// A state that was measured several times is computed once: `twins_` refers to the first one.
  void find_twins() {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const auto here = states_.begin() + static_cast<std::ptrdiff_t>(i);
      const auto same = std::find_if(states_.begin(), here, [&](const Pair& other) {
        return other.Y == here->Y && other.omega == here->omega && has_phase(other) == has_phase(*here);
      });
      twins_.push_back(static_cast<std::size_t>(same - states_.begin()));
    }
    most_work_ = most_work_of_law;
    for (std::size_t i = 0; i < twins_.size(); ++i) most_work_ += twins_[i] == i ? most_work_of_state : 0;
  }

  void take_states(const KnownDeviations& known) {
    count_states();
    if (phases_ < 2) phases_ = 0;
    find_twins();
    if (phases_ > 0 || several_) nuisances_ = spring_nuisances();
    take_readings(known);
    data_ = std::to_string(states_.size()) + " steady states" + (phases_ > 0 ? " with phases" : "");
  }

  void count_states() {
    unit_ = std::ranges::max_element(states_, {}, &Pair::x)->x;
    for (const Pair& state : states_) {
      numbers_.push_back(state.number);
      phases_ += std::isnan(state.phase) ? 0 : 1;
      several_ = several_ || !is_same_frequency(state.omega, states_.front().omega);
    }
  }

  void take_readings(const KnownDeviations& known) {
    const Index count = amplitudes() + phases_;
    readings_.resize(count);
    channels_.assign(static_cast<std::size_t>(count), 0);
    const Index columns = several_ ? 6 : 3;
    // A contact that yields before it slides turns the phase most where the motion is small: 1/x.
    constexpr Index enough = 6;
    const Index phase_columns = phases_ < enough ? columns : columns + 1;
    smooth_curve_.setZero(count, phases_ > 0 ? columns + phase_columns : columns);
    Index phase_row = amplitudes();
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const Pair& state = states_[i];
      const double x = state.x / unit_;
      const double r = state.omega / reference_.frequency - 1.0;
      Eigen::RowVectorXd curve(columns);
      curve.head(3) << 1.0, x, x * x;
      if (several_) curve.tail(3) << r, r * r, r * r * r;
      const auto row = static_cast<Index>(i);
      readings_[row] = state.x;
      smooth_curve_.row(row).head(columns) = curve;
      if (!has_phase(state)) continue;
      readings_[phase_row] = state.phase;
      channels_[static_cast<std::size_t>(phase_row)] = 1;
      smooth_curve_.row(phase_row).segment(columns, columns) = curve;
      if (phase_columns > columns) smooth_curve_(phase_row, 2 * columns) = 1.0 / x;
      ++phase_row;
    }
    // An error of Y acts as one of x, by the slope of x over Y.
    double slope = 0.0;
    for (const Pair& state : states_) slope += state.x / state.Y / static_cast<double>(states_.size());
    known_deviations_ = {std::hypot(known.sigma_x, slope * known.sigma_Y), 0.0};
    least_deviations_ = {least_relative_deviation * unit_, least_relative_deviation};
  }

  [[nodiscard]] sim::Model model_of(const LawAt& law, const VectorXd& p, const Pair& state, double accuracy) const {
    departures::Truth truth;
    double k = constants_.stiffness;
    if (unknowns() > stiffness_unknown)
      k *= 1.0 + p[stiffness_unknown] + p[stiffness_unknown + 1] * share_of_hardening(state);
    truth.model.oscillator.mass = constants_.mass;
    truth.model.oscillator.stiffness = k;
    truth.model.oscillator.damping = p[1] * c_unit_;
    // The motion of the base is given: another stiffness changes its force on the mass.
    truth.model.excitation = {
        .type = sim::ExcitationType::base_harmonic, .amplitude = state.Y, .frequency = state.omega};
    truth.F0 = p[0] * F0_unit_;
    sim::Model model = law.model(truth, reference_);
    model.solver.tolerance = accuracy;
    return model;
  }

  static void remember(const sim::Model& model, const sim::SteadyState& state,
                       std::optional<sim::KnownOrbit>& near) {
    const bool far = state.transient_periods > 0 || state.newton_steps > most_corrections;
    if (near && !far)
      near->start = state.start;
    else
      near = sim::known_orbit(model, state);
  }

  /// Only amplitudes are needed, so no full account is computed.
  [[nodiscard]] static sim::SteadyState found(const sim::Model& model, const std::optional<sim::KnownOrbit>& near) {
    const sim::SteadyStateOptions options{.tolerance = model.solver.tolerance,
                                          .max_periods = patience,
                                          .detail = sim::OrbitDetail::extremes,
                                          .others = false};
    return near ? sim::steady_state_near(*near, model, options) : sim::steady_state(model, options);
  }

  std::vector<Pair> states_;
  std::vector<std::size_t> twins_;  ///< the first state of the same base and frequency
  KnownConstants constants_;
  double unit_ = 1.0;  ///< the largest amplitude [m]
  Index phases_ = 0;
  bool several_ = false;
};

}  // namespace

std::variant<std::unique_ptr<const ReadingModel>, std::string> steady_readings(const Record& record,
                                                                               const KnownConstants& constants,
                                                                               const KnownDeviations& known) {
  Estimate plain = den_hartog_fit(record, constants, {});
  if (!plain.outcome.ok()) plain = harmonic_balance(record, constants);
  if (!plain.outcome.ok()) return plain.outcome.reason;
  if (!is_friction(plain)) return no_plain_motion;
  Estimate taken;
  const std::optional<std::vector<Pair>> states = take_states(record, constants, false, taken);
  if (!states) return taken.outcome.reason;
  constexpr std::size_t fewest = 4;
  if (states->size() < fewest) return "fewer than four steady states";
  return std::make_unique<const SteadyReadings>(*states, constants, plain.value, known);
}

std::unique_ptr<const ReadingModel> planned_states(const ReadingModel& record, std::vector<Pair> states,
                                                   const KnownConstants& constants,
                                                   const std::array<double, 2>& deviations) {
  return std::make_unique<const SteadyReadings>(record, std::move(states), constants, deviations);
}

std::unique_ptr<const ReadingModel> continued_states(const ReadingModel& record, std::vector<Pair> states,
                                                     const KnownConstants& constants, const KnownDeviations& known,
                                                     const VectorXd& start) {
  return std::make_unique<const SteadyReadings>(record, std::move(states), constants, known, start);
}

}  // namespace dualdamp::identify
