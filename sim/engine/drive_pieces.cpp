#include "sim/engine/drive_pieces.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/random.hpp"

namespace dualdamp::sim {

namespace {

/// A ramp: one piece without end.
class RampPieces final : public DrivePieces {
 public:
  explicit RampPieces(double slope) : slope_(slope) {}

  [[nodiscard]] PolynomialPiece piece(long) const override {
    return {std::numeric_limits<double>::infinity(), {0.0, slope_}};
  }
  [[nodiscard]] double begin(long) const override { return 0.0; }
  [[nodiscard]] int degree() const override { return slope_ == 0.0 ? 0 : 1; }
  [[nodiscard]] double size() const override { return 0.0; }

 private:
  double slope_;
};

class NoisePieces final : public DrivePieces {
 public:
  explicit NoisePieces(const Noise& noise)
      : spacing_(noise.spacing()),
        deviation_(std::sqrt(noise.intensity / spacing_)),
        draws_{.seed = noise.seed, .stream = noise_stream} {}

  [[nodiscard]] PolynomialPiece piece(long n) const override {
    const double value = node(n);
    return {spacing_, {value, (node(n + 1) - value) / spacing_}};
  }
  [[nodiscard]] double begin(long n) const override { return static_cast<double>(n) * spacing_; }
  [[nodiscard]] int degree() const override { return 1; }
  [[nodiscard]] double size() const override { return deviation_; }

 private:
  [[nodiscard]] double node(long n) const { return deviation_ * draws_.normal(static_cast<std::uint64_t>(n)); }

  double spacing_;
  double deviation_;
  core::RandomStream draws_;
};

/// A chirp, with nodes at equal steps of phi + k t. The error of a cubic over a step h is h^4/384 max|y''''|. Let
/// q = |phi''|/phi'^2. For a linear sweep |y''''| is at most A phi'^4 (1 + 6 q + 3 q^2), which is below
/// A (phi' + k)^4 for k^2 = sqrt(3) |phi''|. For an exponential sweep it is at most A phi'^4 (1 + 6 q + 7 q^2 +
/// q^3); k is 0 and the step is shorter instead.
class ChirpPieces final : public DrivePieces {
 public:
  explicit ChirpPieces(const Excitation& excitation)
      : chirp_(excitation.chirp), amplitude_(excitation.amplitude), phase_(excitation.phase) {
    if (chirp_.law == ChirpLaw::exponential) growth_ = std::log(chirp_.to / chirp_.from) / chirp_.duration;
    if (growth_ == 0.0) {
      rate_ = (chirp_.to - chirp_.from) / chirp_.duration;
      extra_ = std::sqrt(std::sqrt(3.0) * std::abs(rate_));
    }
    const double q = std::abs(growth_) / std::min(chirp_.from, chirp_.to);
    const double step = whole_step / std::sqrt(std::sqrt(1.0 + q * (6.0 + q * (7.0 + q))));
    const double total = turned(chirp_.duration) + extra_ * chirp_.duration;
    count_ = std::ceil(total / step);
    step_ = total / count_;
  }

  [[nodiscard]] double count() const { return count_; }

  [[nodiscard]] PolynomialPiece piece(long n) const override {
    if (static_cast<double>(n) >= count_)
      return {std::numeric_limits<double>::infinity(), {value(chirp_.duration)}};
    const double t0 = begin(n);
    const double t1 = begin(n + 1);
    return hermite_piece(t1 - t0, value(t0), slope(t0), value(t1), slope(t1));
  }
  [[nodiscard]] double begin(long n) const override {
    if (static_cast<double>(n) >= count_) return chirp_.duration;
    const double turned = static_cast<double>(n) * step_;
    if (growth_ != 0.0) return std::log1p(turned * growth_ / chirp_.from) / growth_;
    const double first = chirp_.from + extra_;
    return 2.0 * turned / (first + std::sqrt(first * first + 2.0 * rate_ * turned));
  }
  [[nodiscard]] int degree() const override { return 3; }
  [[nodiscard]] double size() const override { return amplitude_; }

 private:
  /// h phi' with (h phi')^4/384 = 1e-9.
  static constexpr double whole_step = 0.02489;

  [[nodiscard]] double turned(double t) const {
    return growth_ != 0.0 ? chirp_.from * std::expm1(growth_ * t) / growth_ : t * (chirp_.from + 0.5 * rate_ * t);
  }
  [[nodiscard]] double frequency(double t) const {
    return growth_ != 0.0 ? chirp_.from * std::exp(growth_ * t) : chirp_.from + rate_ * t;
  }
  [[nodiscard]] double value(double t) const { return amplitude_ * std::cos(phase_ + turned(t)); }
  [[nodiscard]] double slope(double t) const { return -amplitude_ * frequency(t) * std::sin(phase_ + turned(t)); }

  Chirp chirp_;
  double amplitude_;
  double phase_;
  double growth_ = 0.0;  ///< of the frequency [1/s], or 0
  double rate_ = 0.0;    ///< of the frequency [rad/s^2], or 0
  double extra_ = 0.0;   ///< k [rad/s]
  double count_ = 0.0;   ///< pieces
  double step_ = 0.0;    ///< rad
};

class SampledPieces final : public DrivePieces {
 public:
  explicit SampledPieces(std::shared_ptr<const SampledSignal> signal) : signal_(std::move(signal)) {}

  [[nodiscard]] PolynomialPiece piece(long n) const override { return signal_->piece(n); }
  [[nodiscard]] double begin(long n) const override { return signal_->begin(n); }
  [[nodiscard]] int degree() const override {
    switch (signal_->interpolation()) {
      case Interpolation::step:
        return 0;
      case Interpolation::linear:
        return 1;
      case Interpolation::cubic:
        break;
    }
    return 3;
  }
  [[nodiscard]] double size() const override { return signal_->size(); }

 private:
  std::shared_ptr<const SampledSignal> signal_;
};

}  // namespace

std::shared_ptr<const DrivePieces> make_pieces(const Excitation& excitation) {
  if (excitation.is_ramp()) return std::make_shared<RampPieces>(excitation.slope);
  if (excitation.is_noise()) return std::make_shared<NoisePieces>(excitation.noise);
  if (excitation.is_chirp()) return std::make_shared<ChirpPieces>(excitation);
  if (excitation.is_sampled()) return std::make_shared<SampledPieces>(excitation.samples);
  return nullptr;
}

double chirp_pieces(const Chirp& chirp) {
  return ChirpPieces({.type = ExcitationType::base_chirp, .chirp = chirp}).count();
}

}  // namespace dualdamp::sim
