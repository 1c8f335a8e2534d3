#include "sim/batch/batch.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>

#include "friction_models/coulomb.hpp"
#include "sim/batch/kernels.hpp"
#include "sim/drive.hpp"
#include "sim/exact_engine.hpp"
#include "sim/linear_mode.hpp"
#include "sim/parallel.hpp"
#include "sim/steady_state.hpp"

namespace dualdamp::sim {

namespace {

using batch::Kernels;

/// Oscillators of one task. A multiple of every width, so that only the last task is filled up.
constexpr std::size_t chunk = 512;
static_assert(chunk % batch::widest == 0);
static_assert(sliding_closure == batch::closure);

/// Those the processor has, ascending.
const std::vector<const Kernels*>& kernels_here() {
  static const std::vector<const Kernels*> kernels = [] {
    std::vector<const Kernels*> list{&batch::scalar_kernels};
#ifdef __x86_64__
    list.push_back(&batch::sse2_kernels);
    if (__builtin_cpu_supports("avx2")) list.push_back(&batch::avx2_kernels);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
      list.push_back(&batch::avx512_kernels);
#endif
    return list;
  }();
  return kernels;
}

const Kernels& kernels_of(int width) {
  const std::vector<const Kernels*>& list = kernels_here();
  const auto fits = std::find_if(list.begin(), list.end(), [=](const Kernels* k) { return k->width == width; });
  assert(width == 0 || fits != list.end());
  return fits == list.end() ? *list.back() : **fits;
}

batch::DriveOn drive_on(const OscillatorBatch& batch) {
  assert(batch.type == ExcitationType::base_harmonic || batch.type == ExcitationType::force_harmonic);
  if (batch.type == ExcitationType::force_harmonic) return batch::DriveOn::mass;
  return batch.damper_to == DamperTo::base ? batch::DriveOn::base_and_damper : batch::DriveOn::base;
}

/// One column of a task's oscillators: the caller's own, or a copy whose last entry is repeated up to a whole pack.
class Column {
 public:
  Column(const std::vector<double>& all, std::size_t first, std::size_t count, std::size_t padded) {
    data_ = all.data() + first;
    if (count == padded) return;
    std::copy_n(data_, count, copy_.begin());
    std::fill(copy_.begin() + static_cast<std::ptrdiff_t>(count),
              copy_.begin() + static_cast<std::ptrdiff_t>(padded), data_[count - 1]);
    data_ = copy_.data();
  }
  Column(const Column&) = delete;
  Column& operator=(const Column&) = delete;
  ~Column() = default;

  [[nodiscard]] const double* data() const { return data_; }

 private:
  const double* data_;
  std::array<double, chunk> copy_;
};

/// The oscillators [first, first + count) filled up to whole packs.
class Task {
 public:
  Task(const OscillatorBatch& batch, std::size_t first, std::size_t count)
      : padded_((count + batch::widest - 1) / batch::widest * batch::widest),
        mass_(batch.mass, first, count, padded_),
        damping_(batch.damping, first, count, padded_),
        stiffness_(batch.stiffness, first, count, padded_),
        kinetic_(batch.kinetic, first, count, padded_),
        static_level_(batch.static_level, first, count, padded_),
        amplitude_(batch.amplitude, first, count, padded_),
        frequency_(batch.frequency, first, count, padded_),
        drive_(drive_on(batch)) {}

  [[nodiscard]] std::size_t padded() const { return padded_; }
  [[nodiscard]] batch::Oscillators oscillators() const {
    return {.drive = drive_,
            .count = padded_,
            .mass = mass_.data(),
            .damping = damping_.data(),
            .stiffness = stiffness_.data(),
            .kinetic = kinetic_.data(),
            .static_level = static_level_.data(),
            .amplitude = amplitude_.data(),
            .frequency = frequency_.data()};
  }

 private:
  std::size_t padded_;
  Column mass_, damping_, stiffness_, kinetic_, static_level_, amplitude_, frequency_;
  batch::DriveOn drive_;
};

Model model_of(const OscillatorBatch& batch, std::size_t i) {
  Model model;
  model.oscillator = {.mass = batch.mass[i],
                      .stiffness = batch.stiffness[i],
                      .damping = batch.damping[i],
                      .damper_to = batch.damper_to};
  model.excitation = {.type = batch.type, .amplitude = batch.amplitude[i], .frequency = batch.frequency[i]};
  model.friction.emplace_back(friction::Coulomb(batch.kinetic[i], batch.static_level[i]));
  return model;
}

void steady_state_by_engine(const OscillatorBatch& batch, std::size_t i, BatchSteadyStates& result) {
  const SteadyState state = steady_state(model_of(batch, i));
  result.engine[i] = 1;
  result.outcome[i] = state.outcome.kind;
  result.peak[i] = state.peak;
  result.trough[i] = state.trough;
  result.lag[i] = state.phase;
  result.stops[i] = state.stops_per_cycle;
  for (const std::complex<double>& value : state.multipliers)
    result.radius[i] = std::max(result.radius[i], std::abs(value));
}

/// What the kernel writes, a column for each member of batch::Orbits.
class OrbitColumns {
 public:
  [[nodiscard]] batch::Orbits all() {
    return {.peak = peak_.data(),
            .lag = lag_.data(),
            .turned_re = turned_re_.data(),
            .turned_im = turned_im_.data(),
            .radius = radius_.data(),
            .searches = searches_.data(),
            .panels = panels_.data(),
            .splits = splits_.data(),
            .certified = certified_.data()};
  }
  [[nodiscard]] std::optional<SlidingOrbit> orbit(std::size_t i) const {
    if (certified_[i] == 0.0 || !(radius_[i] < 1.0 - neutral_margin)) return std::nullopt;
    return SlidingOrbit{.peak = peak_[i],
                        .lag = lag_[i],
                        .radius = radius_[i],
                        .drive_at_peak = {turned_re_[i], turned_im_[i]},
                        .certificate = {.searches = std::lround(searches_[i]),
                                        .panels = std::lround(panels_[i]),
                                        .splits = std::lround(splits_[i])}};
  }

 private:
  std::array<double, chunk> peak_, lag_, turned_re_, turned_im_, radius_, searches_, panels_, splits_, certified_;
};

/// Of the oscillators from `first` on, at most a chunk of them.
void find_orbits(const OscillatorBatch& batch, const Kernels& kernels, std::size_t first,
                 std::span<std::optional<SlidingOrbit>> orbits) {
  const Task task(batch, first, orbits.size());
  OrbitColumns columns;
  kernels.find_orbits(task.oscillators(), columns.all());
  for (std::size_t lane = 0; lane < orbits.size(); ++lane) orbits[lane] = columns.orbit(lane);
}

void steady_states_of(const OscillatorBatch& batch, const Kernels& kernels, std::size_t first, std::size_t count,
                      BatchSteadyStates& result) {
  std::array<std::optional<SlidingOrbit>, chunk> orbits;
  find_orbits(batch, kernels, first, std::span(orbits).first(count));
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::size_t i = first + lane;
    if (!orbits[lane]) {
      steady_state_by_engine(batch, i, result);
      continue;
    }
    const SlidingOrbit& orbit = *orbits[lane];
    result.peak[i] = orbit.peak;
    result.trough[i] = -orbit.peak;
    result.lag[i] = orbit.lag;
    result.radius[i] = orbit.radius;
  }
}

void follow_by_engine(const OscillatorBatch& batch, int periods, std::size_t i, BatchMotions& motions) {
  ExactEngine engine(model_of(batch, i));
  engine.start(motions.position[i], motions.velocity[i]);
  double turning = 0.0;
  while (engine.cycle() < periods) {
    const Interval* interval = engine.next_in_period();
    if (interval == nullptr) break;
    if (interval->ending != EventKind::reversal) continue;
    motions.amplitude[i] = 0.5 * std::abs(engine.position() - turning);
    turning = engine.position();
    ++motions.reversals[i];
  }
  motions.engine[i] = 1;
  motions.position[i] = engine.position();
  motions.velocity[i] = engine.velocity();
}

void follow_some(const OscillatorBatch& batch, const Kernels& kernels, int periods, std::size_t first,
                 std::size_t count, BatchMotions& motions) {
  const Task task(batch, first, count);
  std::array<double, chunk> x{};
  std::array<double, chunk> v{};
  std::array<double, chunk> amplitude;
  std::array<double, chunk> reversals;
  std::array<double, chunk> certified;
  std::copy_n(motions.position.begin() + static_cast<std::ptrdiff_t>(first), count, x.begin());
  std::copy_n(motions.velocity.begin() + static_cast<std::ptrdiff_t>(first), count, v.begin());
  kernels.follow(task.oscillators(),
                 {periods, x.data(), v.data(), amplitude.data(), reversals.data(), certified.data()});
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::size_t i = first + lane;
    if (certified[lane] == 0.0) {
      follow_by_engine(batch, periods, i, motions);
      continue;
    }
    motions.position[i] = x[lane];
    motions.velocity[i] = v[lane];
    motions.amplitude[i] = amplitude[lane];
    motions.reversals[i] = std::lround(reversals[lane]);
  }
}

struct Levels {
  double kinetic = 0.0;  ///< N
  double static_level = 0.0;

  Levels& operator+=(const Levels& other) {
    kinetic += other.kinetic;
    static_level += other.static_level;
    return *this;
  }
};

/// The same whatever the motion does.
bool is_constant(const friction::Affine& form) {
  return form.rate == 0.0 && form.position == 0.0 && form.velocity == 0.0 && form.transient == 0.0;
}

/// Of a law that is Coulomb friction, by what it does: nothing remembered, a force that depends on the direction of
/// slip alone, a constant limit not below it.
std::optional<Levels> coulomb_levels(const friction::Law& law) {
  if (!law.is_affine() || law.is_modal() || !law.aperiodic().empty()) return std::nullopt;
  const friction::Affine forward = law.affine_force({}, {}, friction::Direction::forward);
  const friction::Affine backward = law.affine_force({}, {}, friction::Direction::backward);
  const friction::Affine limit = law.affine_limit({}, {});
  if (!is_constant(forward) || !is_constant(backward) || !is_constant(limit)) return std::nullopt;
  const bool levels = backward.constant == -forward.constant && 0.0 <= forward.constant;
  if (!levels || limit.constant < forward.constant) return std::nullopt;
  return Levels{forward.constant, limit.constant};
}

}  // namespace

std::optional<OscillatorBatch> batch_of(const Model& model, std::size_t size) {
  const Excitation& drive = model.excitation;
  if (!is_exact(model)) return std::nullopt;
  if (!drive.is_harmonic() || !drive.harmonics.empty() || drive.offset != 0.0) return std::nullopt;
  Levels sum;
  for (const friction::Law& law : model.friction) {
    const std::optional<Levels> levels = coulomb_levels(law);
    if (!levels) return std::nullopt;
    sum += *levels;
  }
  const auto column = [size](double value) { return std::vector<double>(size, value); };
  return OscillatorBatch{.type = drive.type,
                         .damper_to = model.oscillator.damper_to,
                         .mass = column(model.oscillator.mass),
                         .damping = column(model.oscillator.damping),
                         .stiffness = column(model.oscillator.stiffness),
                         .kinetic = column(sum.kinetic),
                         .static_level = column(sum.static_level),
                         .amplitude = column(drive.amplitude),
                         .frequency = column(drive.frequency)};
}

std::optional<State> start_of(const SlidingOrbit& orbit, const Model& model) {
  Excitation from_peak = model.excitation;
  from_peak.phase = std::arg(orbit.drive_at_peak);
  const double turn = 2.0 * std::numbers::pi;
  const double angle = model.excitation.phase - from_peak.phase;
  // The half cycle from the trough on is the mirror image of that from the peak on.
  const double after_peak = angle - turn * std::floor(angle / turn);
  const double mirror = after_peak < std::numbers::pi ? 1.0 : -1.0;
  const double s = (after_peak - (mirror > 0.0 ? 0.0 : std::numbers::pi)) / model.excitation.frequency;

  const Oscillator& o = model.oscillator;
  const Drive drive(o, from_peak);
  const LinearMode mode(o.mass, o.damping, o.stiffness, drive.frequencies(), false);
  ModeForcing forcing{.phasors = {drive.force_phasor(0)}};
  for (const friction::Law& law : model.friction)
    forcing.constant -= law.affine_force({}, {}, friction::Direction::backward).constant;
  core::ModeFunction x;
  core::ModeFunction v;
  mode.solve(forcing, orbit.peak, 0.0, x);
  core::differentiate(mode.basis(), x, v);
  core::ExponentialBasis::Values values;
  mode.basis().evaluate(s, values);
  const double speed = -core::evaluate(mode.basis(), v, values);
  if (!(speed > 0.0)) return std::nullopt;
  return State{.x = mirror * core::evaluate(mode.basis(), x, values),
               .v = -mirror * speed,
               .direction = mirror > 0.0 ? friction::Direction::backward : friction::Direction::forward,
               .memories = std::vector<friction::Memory>(model.friction.size())};
}

std::vector<int> batch_widths() {
  std::vector<int> widths;
  for (const Kernels* kernels : kernels_here()) widths.push_back(kernels->width);
  return widths;
}

std::vector<std::optional<SlidingOrbit>> sliding_orbits(const OscillatorBatch& batch, int width) {
  std::vector<std::optional<SlidingOrbit>> orbits(batch.size());
  const Kernels& kernels = kernels_of(width);
  for (std::size_t first = 0; first < orbits.size(); first += chunk)
    find_orbits(batch, kernels, first, std::span(orbits).subspan(first, std::min(chunk, orbits.size() - first)));
  return orbits;
}

BatchSteadyStates steady_states(const OscillatorBatch& batch, const BatchOptions& options) {
  BatchSteadyStates result;
  result.outcome.resize(batch.size(), core::OutcomeKind::done);
  for (std::vector<double>* column : {&result.peak, &result.trough, &result.lag, &result.radius})
    column->resize(batch.size(), 0.0);
  result.stops.resize(batch.size(), 0);
  result.engine.resize(batch.size(), 0);
  const Kernels& kernels = kernels_of(options.width);
  in_parts(batch.size(), chunk, options.threads,
           [&](std::size_t first, std::size_t count) { steady_states_of(batch, kernels, first, count, result); });
  return result;
}

void follow(const OscillatorBatch& batch, int periods, BatchMotions& motions, const BatchOptions& options) {
  assert(motions.position.size() == batch.size() && motions.velocity.size() == batch.size());
  motions.amplitude.assign(batch.size(), 0.0);
  motions.reversals.assign(batch.size(), 0);
  motions.engine.assign(batch.size(), 0);
  const Kernels& kernels = kernels_of(options.width);
  in_parts(batch.size(), chunk, options.threads, [&](std::size_t first, std::size_t count) {
    follow_some(batch, kernels, periods, first, count, motions);
  });
}

}  // namespace dualdamp::sim
