#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "identify/experiments/starts.hpp"
#include "identify/fit/problem.hpp"
#include "identify/fit/search/far_starts.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;

namespace {

/// A history under lugre and what a fit of it seeks.
struct LugreFit {
  Rig rig = test::rig_with(test::law_case_of("lugre"));
  Experiments experiments;
  std::vector<FitParameter> parameters;
  std::vector<double> sizes;
  std::unique_ptr<FitProblem> problem;

  LugreFit() {
    std::string fault;
    experiments = experiments_of(test::history_of(rig, {.duration = 1.0}, 1), {.name = "measured"}, fault);
    REQUIRE(fault.empty());
    Rig unstated = rig;
    unstated.laws.front().values = {};
    std::vector<std::string> faults;
    parameters = unstated_parameters(unstated, faults);
    REQUIRE(faults.empty());
    sizes = sizes_of(parameters, scale());
    problem = std::make_unique<FitProblem>(rig, parameters, experiments, sizes);
  }

  [[nodiscard]] Eigen::VectorXd truth() const {
    Eigen::VectorXd values(static_cast<Eigen::Index>(parameters.size()));
    for (std::size_t i = 0; i < parameters.size(); ++i)
      values[static_cast<Eigen::Index>(i)] = rig.laws.front().values.number(parameters[i].name);
    return problem->space().point(values);
  }
  [[nodiscard]] DataScale scale() const { return scale_of(rig, experiments); }
  [[nodiscard]] std::size_t number_of(const std::string& name) const {
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (parameters[i].name == name) return i;
    FAIL(name);
    return 0;
  }
};

}  // namespace

TEST_CASE("far starts: each begins where the last one ended, if that is better", "[identify][fit]") {
  const LugreFit fit;
  const std::size_t number = fit.number_of("stribeck_velocity");
  const auto at = static_cast<Eigen::Index>(number);
  const Eigen::VectorXd from = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(fit.parameters.size()));
  // A valley along which another parameter follows the held one.
  const Eigen::Index other = at == 0 ? 1 : 0;
  std::vector<double> held_at;
  const auto fit_held = [&](const FitProblem&, const std::vector<Eigen::VectorXd>& points) -> SearchPlace {
    for (const Eigen::VectorXd& q : points) CHECK(q[at] == points.front()[at]);
    CHECK(points.front()[other] == 0.0);
    const double before = points.size() > 1 ? points.back()[other] : 0.0;
    if (points.size() > 1) CHECK(before == 0.5 * held_at.back());
    held_at.push_back(points.front()[at]);
    Eigen::VectorXd there = points.front();
    there[other] = 0.5 * there[at];
    return {there, std::abs(there[at] - 2.0)};
  };
  const std::vector<SearchPlace> starts =
      far_starts(*fit.problem, fit.parameters, number, from, fit.scale(), fit_held);
  REQUIRE(held_at.size() > 4);
  // From the estimate up, then from it down.
  std::size_t turns = 0;
  for (std::size_t i = 1; i < held_at.size(); ++i)
    if (std::abs(held_at[i]) < std::abs(held_at[i - 1])) ++turns;
  CHECK(turns == 1);
  CHECK(held_at.front() >= 0.0);
  CHECK(held_at.back() < 0.0);
  REQUIRE(starts.size() == 2);
  CHECK(starts.front().squares <= starts.back().squares);
}

TEST_CASE("fit: one-sided differences take half the motions and point the same way", "[identify][fit]") {
  const LugreFit fit;
  const Eigen::VectorXd q = fit.truth();
  const auto derivatives = [&](bool is_one_sided, long& work) {
    const FitProblem rough = fit.problem->roughly({.tolerance = 1e-8, .step = 1e-3, .is_one_sided = is_one_sided});
    rough.limit(1'000'000'000);
    Eigen::VectorXd outputs;
    Eigen::MatrixXd jacobian;
    REQUIRE(rough.derivatives(q, outputs, jacobian));
    work = rough.spent();
    return jacobian;
  };
  long two_sided = 0;
  long one_sided = 0;
  const Eigen::MatrixXd central = derivatives(false, two_sided);
  const Eigen::MatrixXd forward = derivatives(true, one_sided);
  CHECK(static_cast<double>(one_sided) < 0.65 * static_cast<double>(two_sided));
  for (Eigen::Index i = 0; i < central.cols(); ++i) {
    CAPTURE(fit.parameters[static_cast<std::size_t>(i)].name);
    REQUIRE(central.col(i).norm() > 0.0);
    CHECK((forward.col(i) - central.col(i)).norm() < 0.01 * central.col(i).norm());
  }
}
