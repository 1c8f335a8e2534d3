#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.hpp"
#include "identify/ledger/histories/lasting_errors.hpp"
#include "identify/ledger/ledger.hpp"
#include "identify/records/derived_records.hpp"
#include "tests/identify/ledger/laboratory.hpp"
#include "tests/identify/ledger/rig.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr Eigen::Index few_rows = 200;

/// Columns that swing with an oscillator, as those of relaxations of a decay do.
Eigen::MatrixXd swinging(int columns) {
  Eigen::MatrixXd rows(few_rows, columns);
  for (Eigen::Index i = 0; i < few_rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double s = static_cast<double>(i) / static_cast<double>(few_rows);
      const double phase = 2.0 * std::numbers::pi * static_cast<double>(i) / 24.0;
      rows(i, j) = std::pow(s, j / 3) * (j % 3 == 0 ? 1.0 : j % 3 == 1 ? std::cos(phase) : std::sin(phase));
    }
  return rows;
}

/// Errors of unit power at the frequency zero, of which each has this correlation with the next.
Eigen::VectorXd errors_that_last(double correlation, Eigen::Index count, std::uint64_t seed) {
  const dualdamp::core::RandomStream stream{seed, 1};
  Eigen::VectorXd errors(count);
  double error = stream.normal(0) / std::sqrt(1.0 - correlation * correlation);
  for (Eigen::Index i = 0; i < count; ++i) {
    errors[i] = (1.0 - correlation) * error;
    error = correlation * error + stream.normal(static_cast<std::uint64_t>(i) + 1);
  }
  return errors;
}

struct Power {
  double mean = 0.0;     ///< of many records, geometric
  double scatter = 0.0;  ///< from record to record, of the logarithm
};

/// Power at the frequency zero that is found beside the columns, the true one being 1.
Power power_found(double correlation, int columns, Eigen::Index at_rest) {
  constexpr int records = 40;
  const Eigen::MatrixXd swings = swinging(columns);
  Eigen::VectorXd logs(records);
  for (int n = 0; n < records; ++n) {
    const Eigen::VectorXd errors =
        errors_that_last(correlation, few_rows + at_rest, static_cast<std::uint64_t>(n) + 1);
    const Eigen::VectorXd target = errors.head(few_rows);
    std::vector<Eigen::VectorXd> rest;
    if (at_rest > 0) rest.emplace_back(errors.tail(at_rest).array() + 0.7);
    const Autoregression found = lasting_errors({swings, target, {}, rest, 4}).autoregression;
    logs[n] = 2.0 * std::log(found.deviation / (1.0 - found.coefficients.sum()));
  }
  return {std::exp(logs.mean()), std::sqrt((logs.array() - logs.mean()).square().mean())};
}

}  // namespace

TEST_CASE("Errors that last have the power that they had before columns took part of it out") {
  CHECK(power_found(0.0, 24, 0).mean == Approx(1.0).margin(0.15));
  CHECK(power_found(0.5, 24, 0).mean == Approx(1.0).margin(0.3));
  CHECK(power_found(0.8, 24, 0).mean == Approx(1.0).margin(0.35));
}

TEST_CASE("Readings of a mass at rest tell how long errors last") {
  const Power with = power_found(0.8, 24, 400);
  CHECK(with.mean == Approx(1.0).margin(0.3));
  CHECK(with.scatter < 0.6 * power_found(0.8, 24, 0).scatter);
}

TEST_CASE("Sensor noise that lasts a twentieth of a period charges nothing in a short decay to rest") {
  const Rig rig{.m = 2.4, .k = 2661.477, .zeta = 0.04, .F0 = 1.916};
  constexpr double samples_a_second = 500.0;
  constexpr double noise = 2e-5;
  constexpr double correlation = 0.8;
  const Motion motion = motion_of(rig, [](double) { return 0.0; }, 1.6, samples_a_second, 0.012);
  int violated = 0;
  int held = 0;
  constexpr int records = 8;
  for (std::uint64_t seed = 1; seed <= records; ++seed) {
    History history{.sample_rate = samples_a_second};
    const Eigen::VectorXd errors =
        errors_that_last(correlation, static_cast<Eigen::Index>(motion.x.size()), 100 + seed);
    const double unit = noise * std::sqrt((1.0 + correlation) / (1.0 - correlation));
    for (std::size_t i = 0; i < motion.x.size(); ++i)
      history.x.push_back(motion.x[i] + unit * errors[static_cast<Eigen::Index>(i)]);
    Record record;
    record.histories = {history};
    CHECK(complete(record, unknown, rig.k).size() == 1);
    const Ledger ledger = ledger_of(record, {rig.m, rig.k, unknown});
    bool is_clean = true;
    for (const LedgerEntry& entry : ledger.entries) is_clean = is_clean && entry.standing != Standing::violated;
    violated += is_clean ? 0 : 1;
    if (!ledger.joint || !ledger.joint->interval95) continue;
    const Interval zeta = ledger.joint->interval95->zeta;
    held += zeta[0] < rig.zeta && rig.zeta < zeta[1] ? 1 : 0;
  }
  CHECK(violated <= 1);
  CHECK(held >= records - 2);
}
