#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>

#include "friction_models/law.hpp"
#include "identify/fit/fit.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;

namespace {

constexpr Eigen::Index group = 20;
constexpr double steepness = 10.0;
constexpr double coefficient = 2.0;  // N.s/m

/// Readings whose sum of squares over t = ln(saturation velocity / (1 m/s)) and the damping c is
///   60 + [10 (t^2 - 1)]^2 + [slope (t - middle)]^2 + (c - 100)^2
/// with a noise of 1: minima near t = -1 and t = 1.
class TwoMinima final : public Experiment {
 public:
  TwoMinima(double slope, double middle, double gap) : slope_(slope), middle_(middle), gap_(gap) {
    label = "two minima";
    Signal signal{.name = "x", .unit = "m", .at_name = "t", .at_unit = "s", .noise = 1.0, .is_stated = true};
    for (Eigen::Index i = 0; i < 3 * group; ++i) {
      signal.measured.push_back(i % 2 == 0 ? 1.0 : -1.0);
      signal.at.push_back(static_cast<double>(i));
    }
    signals.push_back(std::move(signal));
  }

  [[nodiscard]] bool predict(const sim::Model& model, const RecordValues& /*of_record*/,
                             Eigen::VectorXd& outputs) const override {
    // At this speed the law's force is its limit.
    const friction::Instant fast{.v = 1e12};
    const double t = std::log(model.friction.front().force({}, fast, friction::Direction::forward) / coefficient);
    if (std::abs(t) < gap_) return false;
    const std::array parts = {steepness * (t * t - 1.0), slope_ * (t - middle_), model.oscillator.damping - 100.0};
    outputs.resize(3 * group);
    for (Eigen::Index part = 0; part < 3; ++part)
      outputs.segment(part * group, group)
          .setConstant(parts[static_cast<std::size_t>(part)] / std::sqrt(static_cast<double>(group)));
    return true;
  }

 private:
  double slope_;
  double middle_;
  double gap_;  ///< there is no motion for a smaller |t|
};

Fit fit_of_two_minima(double slope, double middle, double begun_at, double gap = 0.0) {
  Rig rig = test::rig_with(test::law_case_of("viscous_saturating"));
  rig.known.oscillator.damping = 100.0;
  rig.laws.front().values = {{"coefficient", coefficient}, {"saturation_velocity", std::exp(begun_at)}};
  Experiments experiments;
  experiments.push_back(std::make_unique<TwoMinima>(slope, middle, gap));
  std::vector<FitParameter> parameters = test::sought_in(rig, {"damping", "saturation_velocity"}, 1.0);
  return fit_rig(rig, std::move(parameters), experiments);
}

}  // namespace

TEST_CASE("rivals: of two minima that the noise does not tell apart, the lower one is the estimate",
          "[identify][fit]") {
  // The other one is 2.4 variances higher.
  const double slope = std::sqrt(3.0);
  for (const double begun_at : {-0.9, 0.9}) {
    CAPTURE(begun_at);
    const Fit fit = fit_of_two_minima(slope, -0.2, begun_at);
    const FittedParameter& speed = test::fitted(fit, "saturation_velocity");
    CHECK(std::log(speed.value) == Approx(-1.0).margin(0.02));
    CHECK(speed.interval95[0] == Approx(std::exp(-1.0 - 1.96 * 0.05)).epsilon(0.02));
    // The deviation of t is 1/(2 steepness) at both minima.
    CHECK(speed.interval95[1] == Approx(std::exp(1.0 + std::sqrt(1.96 * 1.96 - 2.4) * 0.05)).epsilon(0.02));
    const FittedParameter& damping = test::fitted(fit, "damping");
    CHECK(damping.interval95[1] - damping.value == Approx(1.96).epsilon(0.02));
    REQUIRE(fit.warnings.size() == 1);
    CAPTURE(fit.warnings.front());
    CHECK(fit.warnings.front().find("another minimum, only 2.4 variances") != std::string::npos);
    CHECK(fit.warnings.front().find("saturation_velocity = 2.69") != std::string::npos);
  }
}

TEST_CASE("rivals: there may be no motion between them", "[identify][fit]") {
  const Fit fit = fit_of_two_minima(std::sqrt(3.0), -0.2, 0.9, 0.3);
  CHECK(std::log(test::fitted(fit, "saturation_velocity").value) == Approx(-1.0).margin(0.02));
  CHECK(fit.warnings.size() == 1);
}

TEST_CASE("rivals: a minimum beyond the noise is none", "[identify][fit]") {
  // 9.6 variances higher.
  const Fit fit = fit_of_two_minima(std::sqrt(12.0), -0.2, 0.9);
  const FittedParameter& speed = test::fitted(fit, "saturation_velocity");
  CHECK(std::log(speed.value) == Approx(-1.0).margin(0.05));
  CHECK(speed.interval95[1] < std::exp(-0.8));
  CHECK(fit.warnings.empty());
}
