#include "sim/batch/batch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>

#include "core/constants.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "sim/batch/chunk.hpp"
#include "sim/batch/kernels.hpp"
#include "sim/engine/exact_engine.hpp"
#include "sim/neutral_margin.hpp"
#include "sim/parallel.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

namespace {

using batch::chunk;
using batch::Kernels;
using core::Complex;

static_assert(chunk % batch::widest == 0);
static_assert(sliding_closure == batch::closure);

/// The kernels that the processor can run, in ascending order of width.
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

batch::DriveOn drive_on(ExcitationType type, DamperTo damper_to) {
  if (type == ExcitationType::force_harmonic) return batch::DriveOn::mass;
  return damper_to == DamperTo::base ? batch::DriveOn::base_and_damper : batch::DriveOn::base;
}

/// One column of a task's oscillators: the caller's data, or a copy that repeats the last entry up to a whole pack.
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

/// The oscillators [first, first + count), padded to whole packs.
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
        drive_(drive_on(batch.type, batch.damper_to)) {}

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

/// The output of the kernel: a column for each member of batch::Orbits.
template <std::size_t length>
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
  std::array<double, length> peak_, lag_, turned_re_, turned_im_, radius_, searches_, panels_, splits_, certified_;
};

void pass_periods_by_engine(const OscillatorBatch& batch, int periods, std::size_t i, BatchMotions& motions) {
  ExactEngine engine(batch::model_of(batch, i));
  engine.start(motions.position[i], motions.velocity[i]);
  double turning = 0.0;
  while (engine.periods_passed() < periods) {
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

void pass_periods_of_some(const OscillatorBatch& batch, const Kernels& kernels, int periods, std::size_t first,
                          std::size_t count, BatchMotions& motions) {
  const Task task(batch, first, count);
  std::array<double, chunk> x{};
  std::array<double, chunk> v{};
  std::array<double, chunk> amplitude;
  std::array<double, chunk> reversals;
  std::array<double, chunk> certified;
  std::copy_n(motions.position.begin() + static_cast<std::ptrdiff_t>(first), count, x.begin());
  std::copy_n(motions.velocity.begin() + static_cast<std::ptrdiff_t>(first), count, v.begin());
  kernels.pass_periods(task.oscillators(),
                       {periods, x.data(), v.data(), amplitude.data(), reversals.data(), certified.data()});
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::size_t i = first + lane;
    if (certified[lane] == 0.0) {
      pass_periods_by_engine(batch, periods, i, motions);
      continue;
    }
    motions.position[i] = x[lane];
    motions.velocity[i] = v[lane];
    motions.amplitude[i] = amplitude[lane];
    motions.reversals[i] = std::lround(reversals[lane]);
  }
}

struct CoulombLimits {
  double kinetic = 0.0;  ///< N
  double static_level = 0.0;

  CoulombLimits& operator+=(const CoulombLimits& other) {
    kinetic += other.kinetic;
    static_level += other.static_level;
    return *this;
  }
};

/// Whether the form does not depend on the motion.
bool is_constant(const friction::Affine& form) {
  return form.rate == 0.0 && form.position == 0.0 && form.velocity == 0.0 && form.transient == 0.0;
}

/// The limits of a law if it acts as Coulomb friction: no memory, a force that depends only on the direction of
/// slip, and a constant limit not below the force.
std::optional<CoulombLimits> coulomb_limits(const friction::Law& law) {
  if (!law.is_affine() || law.has_memory() || !law.aperiodic().empty()) return std::nullopt;
  const friction::Affine forward = law.affine_force({}, {}, friction::Direction::forward);
  const friction::Affine backward = law.affine_force({}, {}, friction::Direction::backward);
  const friction::Affine resting = law.affine_force({}, {}, friction::Direction::none);
  const friction::Affine limit = law.affine_limit({}, {});
  if (!is_constant(forward) || !is_constant(backward) || !is_constant(limit)) return std::nullopt;
  const bool levels = backward.constant == -forward.constant && resting.constant == 0.0 && 0.0 <= forward.constant;
  if (!levels || limit.constant < forward.constant) return std::nullopt;
  return CoulombLimits{forward.constant, limit.constant};
}

/// The limits of all laws together, if packs can compute the model.
std::optional<CoulombLimits> coulomb_limits(const Model& model) {
  const Excitation& drive = model.excitation;
  if (!is_exact(model) || model.oscillator.loss_factor != 0.0) return std::nullopt;
  if (!drive.is_harmonic() || !drive.harmonics.empty() || drive.offset != 0.0) return std::nullopt;
  CoulombLimits sum;
  for (const friction::Law& law : model.friction) {
    const std::optional<CoulombLimits> levels = coulomb_limits(law);
    if (!levels) return std::nullopt;
    sum += *levels;
  }
  return sum;
}

}  // namespace

namespace batch {

const Kernels& kernels_of(int width) {
  const std::vector<const Kernels*>& list = kernels_here();
  const auto fits = std::find_if(list.begin(), list.end(), [=](const Kernels* k) { return k->width == width; });
  require(width == 0 || fits != list.end(), "this processor has no packs of that width",
          "one of batch_widths(), or 0");
  return fits == list.end() ? *list.back() : **fits;
}

void require_valid(const OscillatorBatch& batch) {
  require(batch.type == ExcitationType::base_harmonic || batch.type == ExcitationType::force_harmonic,
          "a batch works with a harmonic excitation only", "base_harmonic, force_harmonic");
  for (const std::vector<double>* column :
       {&batch.damping, &batch.stiffness, &batch.kinetic, &batch.static_level, &batch.amplitude, &batch.frequency})
    require(column->size() == batch.size(), "the columns of a batch differ in length", "one value for each mass");
  require_in(friction::positive, "system.mass", batch.mass, "kg");
  require_in(friction::positive, "system.stiffness", batch.stiffness, "N/m");
  require_in({}, "system.damping", batch.damping, "N.s/m");
  require_in(friction::not_negative, "system.friction.kinetic", batch.kinetic, "N");
  for (std::size_t i = 0; i < batch.size(); ++i)
    require_in({.low = batch.kinetic[i]}, "system.friction.static", batch.static_level[i], "N");
  require_in(friction::not_negative, "excitation.amplitude", batch.amplitude,
             batch.type == ExcitationType::base_harmonic ? "m" : "N");
  require_in(friction::positive, "excitation.frequency", batch.frequency, "rad/s");
}

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

void find_orbits(const OscillatorBatch& batch, const Kernels& kernels, std::size_t first,
                 std::span<std::optional<SlidingOrbit>> orbits) {
  const Task task(batch, first, orbits.size());
  OrbitColumns<chunk> columns;
  kernels.find_orbits(task.oscillators(), columns.all());
  for (std::size_t lane = 0; lane < orbits.size(); ++lane) orbits[lane] = columns.orbit(lane);
}

}  // namespace batch

std::optional<OscillatorBatch> batch_of(const Model& model, std::size_t size) {
  const std::optional<CoulombLimits> levels = coulomb_limits(model);
  if (!levels) return std::nullopt;
  const Excitation& drive = model.excitation;
  const auto column = [size](double value) { return std::vector<double>(size, value); };
  return OscillatorBatch{.type = drive.type,
                         .damper_to = model.oscillator.damper_to,
                         .mass = column(model.oscillator.mass),
                         .damping = column(model.oscillator.damping),
                         .stiffness = column(model.oscillator.stiffness),
                         .kinetic = column(levels->kinetic),
                         .static_level = column(levels->static_level),
                         .amplitude = column(drive.amplitude),
                         .frequency = column(drive.frequency)};
}

std::optional<State> start_of(const SlidingOrbit& orbit, const Model& model) {
  const Oscillator& o = model.oscillator;
  const Excitation& drive = model.excitation;
  const double omega = drive.frequency;
  const double angle = drive.phase - std::arg(orbit.drive_at_peak);
  // The half period after the trough is the mirror image of the half period after the peak.
  const double after_peak = angle - core::two_pi * std::floor(angle / core::two_pi);
  const double mirror = after_peak < std::numbers::pi ? 1.0 : -1.0;
  const double s = (after_peak - (mirror > 0.0 ? 0.0 : std::numbers::pi)) / omega;

  // The motion back from rest at the peak: the offset by friction, the response to the drive, and the own motion
  // that makes x = peak, v = 0 at the start.
  double offset = 0.0;
  for (const friction::Law& law : model.friction)
    offset -= law.affine_force({}, {}, friction::Direction::backward).constant / o.stiffness;
  const bool base = drive.type == ExcitationType::base_harmonic;
  const double through_damper = base && o.damper_to == DamperTo::base ? o.damping : 0.0;
  const Complex force =
      drive.amplitude * orbit.drive_at_peak * (base ? Complex(o.stiffness, through_damper * omega) : Complex(1.0));
  const Complex forced = force / Complex(o.stiffness - o.mass * omega * omega, o.damping * omega);
  const double decay = o.damping / (2.0 * o.mass);
  const Complex z(-decay, std::sqrt(o.stiffness / o.mass - decay * decay));
  const double own_x = orbit.peak - offset - forced.real();
  const double own_v = omega * forced.imag();
  const Complex own(own_x, (z.real() * own_x - own_v) / z.imag());

  const Complex forced_now = forced * std::polar(1.0, omega * s);
  const Complex own_now = own * std::polar(std::exp(z.real() * s), z.imag() * s);
  const double speed = omega * forced_now.imag() - (z * own_now).real();
  if (!(speed > 0.0)) return std::nullopt;
  return State{.x = mirror * (offset + forced_now.real() + own_now.real()),
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
  batch::require_valid(batch);
  std::vector<std::optional<SlidingOrbit>> orbits(batch.size());
  const Kernels& kernels = batch::kernels_of(width);
  for (std::size_t first = 0; first < orbits.size(); first += chunk)
    batch::find_orbits(batch, kernels, first,
                       std::span(orbits).subspan(first, std::min(chunk, orbits.size() - first)));
  return orbits;
}

std::optional<SlidingOrbit> sliding_orbit(const Model& model) {
  const std::optional<CoulombLimits> levels = coulomb_limits(model);
  if (!levels) return std::nullopt;
  const Oscillator& o = model.oscillator;
  OrbitColumns<1> column;
  batch::scalar_kernels.find_orbits({.drive = drive_on(model.excitation.type, o.damper_to),
                                     .count = 1,
                                     .mass = &o.mass,
                                     .damping = &o.damping,
                                     .stiffness = &o.stiffness,
                                     .kinetic = &levels->kinetic,
                                     .static_level = &levels->static_level,
                                     .amplitude = &model.excitation.amplitude,
                                     .frequency = &model.excitation.frequency},
                                    column.all());
  return column.orbit(0);
}

void pass_periods(const OscillatorBatch& batch, int periods, BatchMotions& motions, const BatchOptions& options) {
  batch::require_valid(batch);
  require(motions.position.size() == batch.size() && motions.velocity.size() == batch.size(),
          "a motion of a batch needs a position and a velocity for each oscillator",
          std::to_string(batch.size()) + " of each");
  require_in({}, "initial.position", motions.position, "m");
  require_in({}, "initial.velocity", motions.velocity, "m/s");
  motions.amplitude.assign(batch.size(), 0.0);
  motions.reversals.assign(batch.size(), 0);
  motions.engine.assign(batch.size(), 0);
  const Kernels& kernels = batch::kernels_of(options.width);
  in_parts(batch.size(), chunk, options.threads, [&](std::size_t first, std::size_t count) {
    pass_periods_of_some(batch, kernels, periods, first, count, motions);
  });
}

}  // namespace dualdamp::sim
