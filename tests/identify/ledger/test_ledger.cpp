#include "identify/ledger/ledger.hpp"

#include <catch2/catch.hpp>

#include "tests/identify/ledger/laboratory.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr std::uint64_t first_seed = 100;

struct Found {
  int any = 0;
  int named = 0;
};

/// Ledgers of some records: how many violate anything, and how many this assumption.
Found ledgers(Kind kind, int records, Assumption assumption, void (*alter)(Rig&) = nullptr, const Off& off = {}) {
  Found found;
  for (int i = 0; i < records; ++i) {
    const Measured m = measured(kind, first_seed + static_cast<std::uint64_t>(i), alter, off);
    const Ledger ledger = ledger_of(m.record, m.constants);
    REQUIRE_FALSE(ledger.data.empty());
    REQUIRE(ledger.entries.size() == assumption_count);
    found.any += ledger.departures.empty() ? 0 : 1;
    found.named += ledger.is_violated(assumption) ? 1 : 0;
  }
  return found;
}

}  // namespace

TEST_CASE("True Coulomb and viscous friction violates nothing but by chance") {
  // At a level of 5 % three of ten happen in 1 of 100 sets.
  for (const Kind kind : {Kind::xy, Kind::xy_phase, Kind::response, Kind::extremes, Kind::forced, Kind::beat}) {
    CAPTURE(name_of(kind));
    CHECK(ledgers(kind, 10, Assumption::friction_velocity).any <= 2);
  }
}

TEST_CASE("A wrong stiffness is charged to the constants") {
  for (const Kind kind : {Kind::response, Kind::forced}) {
    CAPTURE(name_of(kind));
    CHECK(ledgers(kind, 6, Assumption::constants, nullptr, {.stiffness = 0.03}).named >= 5);
  }
}

TEST_CASE("Quadratic drag is charged to friction over speed") {
  const auto alter = [](Rig& rig) { rig.drag = 1.0; };
  for (const Kind kind : {Kind::xy, Kind::forced}) {
    CAPTURE(name_of(kind));
    CHECK(ledgers(kind, 6, Assumption::friction_velocity, alter).named >= 5);
  }
}

TEST_CASE("What a record cannot tell is untested, with what would tell") {
  const Measured m = measured(Kind::xy, first_seed);
  const Ledger ledger = ledger_of(m.record, m.constants);
  const LedgerEntry& symmetry = ledger.entry(Assumption::symmetry);
  CHECK(symmetry.standing == Standing::untested);
  CHECK(symmetry.reason.find("a history or signed extremes would") != std::string::npos);
  CHECK_FALSE(symmetry.p_value);
  CHECK(ledger_of({}, m.constants).entry(Assumption::spring).standing == Standing::untested);
}
