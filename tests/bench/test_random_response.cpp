// The response to a random drive in addition to the curves of a stress test: which cases get which draws, and that
// other data do not change.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/bench/campaign.hpp"

using namespace dualdamp;
using bench::testing::Campaign;

namespace {

const std::string text =
    "schema: dualdamp/1\nsystem: {mass: 1, stiffness: 1600, damping: 4, friction: {law: coulomb, kinetic: 1}}\n"
    "excitation: {type: base_harmonic, frequency: natural}\n"
    "analysis:\n"
    "  type: stress_test\n"
    "  laws: [detuning, late_displacement]\n"
    "  severities: [0.1, 0.2]\n"
    "  ranges: [{name: one, amplitudes: [4 mm, 5 mm]}]\n"
    "  sensors: [{name: noisy, x: {noise: 10 um}, force: {noise: 1 mN}}]\n"
    "  seeds: 2\n"
    "  methods: [resonance_two_point]\n";
const std::string force =
    "  random_response: {type: force_noise, intensity: 0.5 N^2/Hz, bandwidth: 50 Hz, duration: 20 s, sample_rate: "
    "200 Hz}\n";
const std::string base =
    "  random_response: {type: base_noise, intensity: 0.3 mm^2/Hz, bandwidth: 50 Hz, duration: 20 s, settle: 3 s, "
    "sample_rate: 200 Hz}\n";

/// Root of the mean square of the difference of two signals, the second `shift` samples later.
double difference(const std::vector<double>& a, const std::vector<double>& b, std::size_t shift = 0) {
  double sum = 0.0;
  for (std::size_t i = 0; i + shift < a.size(); ++i) sum += std::pow(a[i] - b[i + shift], 2);
  return std::sqrt(sum / static_cast<double>(a.size() - shift));
}

}  // namespace

TEST_CASE("random_response: a record holds the pairs of the curve and one history") {
  const identify::Record record = Campaign(text + force).records(0).front();
  CHECK(record.pairs->pairs.size() == 2);
  REQUIRE(record.histories.size() == 1);
  const identify::History& history = record.histories.front();
  CHECK(history.x.size() == 4001);
  CHECK(history.v.size() == 4001);
  CHECK(history.a.size() == 4001);
  CHECK(history.force.size() == 4001);
  CHECK(history.y.empty());
  CHECK(history.start == 0.0);
  const identify::Record shaken = Campaign(text + base).records(0).front();
  CHECK(shaken.histories.front().y.size() == 4001);
  CHECK(shaken.histories.front().force.empty());
  CHECK(shaken.histories.front().start == 3.0);
  CHECK(Campaign(text).records(0).front().histories.empty());
}

TEST_CASE("random_response: each motion has a drive of its own, which its readings share") {
  const Campaign campaign(text + force);
  std::set<std::uint64_t> seeds;
  for (std::size_t motion = 0; motion < campaign.grid.motions(); ++motion)
    seeds.insert(campaign.grid.drive_seed(motion));
  for (std::size_t number = 0; number < campaign.grid.cases(); ++number) seeds.insert(campaign.grid.seed(number));
  CHECK(seeds.size() == campaign.grid.motions() + campaign.grid.cases());
  CHECK(Campaign(text + force + "  seed: 1\n").grid.drive_seed(0) != campaign.grid.drive_seed(0));

  // Two readings differ by the noise of each, sqrt(2) times 10 um; 4001 samples determine it within 1.1 %.
  const std::vector<identify::Record> truth = campaign.records(0);
  const std::vector<double>& x = truth[0].histories[0].x;
  CHECK(difference(x, truth[1].histories[0].x) == Approx(std::sqrt(2.0) * 1e-5).epsilon(0.05));
  CHECK(difference(truth[0].histories[0].force, truth[1].histories[0].force) ==
        Approx(std::sqrt(2.0) * 1e-3).epsilon(0.05));
  // Different motions differ by at least 0.4 of their size.
  const std::vector<double> other = campaign.records(1)[0].histories[0].x;
  CHECK(difference(x, other) > 0.4 * difference(x, std::vector<double>(x.size())));
  // The same campaign has the same histories.
  CHECK(Campaign(text + force).records(0)[1].histories[0].x == truth[1].histories[0].x);
}

TEST_CASE("random_response: a phase lag is the time that it is at the frequency of the curve's drive") {
  // At 40 rad/s, 0.2 rad are 5 ms: a sample. The readings are those of the same drive, later by this time, except
  // for noise.
  const std::string lag = text + force + "  seed: 3\n";
  std::string late = lag;
  late.replace(late.find("x: {noise: 10 um}"), 17, "x: {noise: 10 um, phase_lag: 0.2 rad}");
  const std::vector<double> x = Campaign(lag).records(0)[0].histories[0].x;
  CHECK(difference(x, Campaign(late).records(0)[0].histories[0].x, 1) < 2e-5);
  CHECK(difference(x, Campaign(late).records(0)[0].histories[0].x) > 2e-4);
  // The departure whose severity is this lag has another drive, which is recorded too.
  CHECK(Campaign(lag).records(4)[0].histories.size() == 1);
}

TEST_CASE("random_response: distances, harms and bounds are those of the curve") {
  for (const std::size_t motion : {0U, 2U}) {
    const bench::Consequence with = Campaign(text + force).consequence(motion);
    const bench::Consequence without = Campaign(text).consequence(motion);
    CHECK(with.distance == without.distance);
    CHECK(with.harm() == without.harm());
    CHECK(with.cramer_rao_F0 == without.cramer_rao_F0);
  }
}
