#include "identify/ledger/estimate/one_frequency.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "tests/identify/ledger/findings.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("At one frequency constants and the inertia of a further mode are one departure") {
  Estimate joint = estimate("joint_fit", 0.106, 3.2, 0.02);  // c = 10.6
  Ledger charged = ledger({Assumption::one_mode});
  charged.recorded.states = true;
  charged.entry(Assumption::constants).standing = Standing::violated;
  charged.entry(Assumption::constants).wanted = "a mass of 0.64 kg, not the stated 1 kg";
  charged.departures.push_back({Assumption::constants});
  charged.joint = joint;
  const KnownConstants stated{1.0, 3844.0};  // critical damping 124
  Ledger several = charged;
  several.recorded.frequencies = true;
  join_at_one_frequency(stated, several);
  CHECK(several.departures.size() == 2);
  join_at_one_frequency(stated, charged);
  REQUIRE(charged.departures.size() == 1);
  CHECK(charged.departures.front() == std::vector<Assumption>{Assumption::one_mode, Assumption::constants});
  CHECK(mentions(charged.entry(Assumption::constants).reason, "explained as well by: one_mode"));
  CHECK(mentions(charged.entry(Assumption::constants).reason, "a mass of 0.64 kg"));
  CHECK(mentions(charged.entry(Assumption::one_mode).reason, "explained as well by: constants"));
  // zeta with the constants as stated is 10.6/124.
  CHECK(charged.joint->interval95->zeta[0] == Approx(10.6 * 0.98 / 124.0));
  CHECK(charged.joint->interval95->zeta[1] == Approx(joint.interval95->zeta[1]));
}
