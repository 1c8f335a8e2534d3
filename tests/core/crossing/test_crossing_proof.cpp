/// The proof test of the event search: guards drawn at random, every finding compared with the oracle's account.

#include <fmt/format.h>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/crossing/first_crossing.hpp"
#include "tests/support/random_guards.hpp"

namespace {

using namespace dualdamp;
using oracle::ExponentialSum;
using oracle::Knot;
using oracle::Real;
using test::GuardCase;

/// Levels count roundings as the header of the search defines them: 16 eps of the amplitudes' sum there and what
/// the phases lose. A minimum within one rounding of zero is a grazing, a deeper one a crossing. The search itself
/// knows a value to half a rounding, and joins contacts between which the guard hardly rises: between `sure_level`
/// and `clear_level` it may decide either way, though not in contradiction to itself.
constexpr Real sure_level = 0.5L;
constexpr Real clear_level = 3;

/// A stretch where the guard is within `clear_level` of zero, or crosses.
struct Contact {
  std::size_t before = 0;      ///< the last knot above it
  std::size_t after = 0;       ///< the first knot beyond it
  bool crosses = false;        ///< ends below
  bool open = false;           ///< reaches the horizon
  std::vector<Knot> minima{};  ///< within `clear_level` of zero
};

std::vector<Contact> contacts(const std::vector<Knot>& knots) {
  std::vector<Contact> found;
  std::size_t above = 0;
  std::optional<Contact> contact;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const Real level = knots[i].level;
    if (std::abs(level) <= clear_level) {
      if (!contact) contact = Contact{.before = above};
      const bool last = i + 1 == knots.size();
      if (!last && level <= knots[i - 1].level && level <= knots[i + 1].level) contact->minima.push_back(knots[i]);
      contact->open = last;
      contact->after = i;
      if (last) found.push_back(*contact);
      continue;
    }
    if (level < 0 && !contact) contact = Contact{.before = above};
    if (contact) {
      contact->after = i;
      contact->crosses = level < 0;
      found.push_back(*contact);
      if (level < 0) break;
      contact.reset();
    }
    above = i;
  }
  return found;
}

core::ExponentialBasis basis_of(const GuardCase& c, double expected) {
  core::ExponentialBasis basis;
  for (const GuardCase::Element& e : c.elements) basis.add(e.exponent, e.parent);
  basis.finish(expected);
  return basis;
}

struct Findings {
  core::SearchEnd end = core::SearchEnd::horizon;
  core::Crossing crossing;
  std::vector<core::Grazing> grazings;
  core::SearchCount count;
};

Findings find(const GuardCase& c, double expected) {
  const core::ExponentialBasis basis = basis_of(c, expected);
  std::vector<core::Guard> guards;
  for (const GuardCase::Row& row : c.guards) {
    core::Guard& guard = guards.emplace_back();
    core::clear(basis, guard.value);
    for (std::size_t k = 0; k < row.coefficients.size(); ++k) {
      guard.value.re[k] = row.coefficients[k].real();
      guard.value.im[k] = row.coefficients[k].imag();
    }
    guard.known_zeros = row.zeros;
    core::prepare(basis, guard);
  }
  Findings findings;
  findings.end =
      core::first_crossing(basis, guards, c.horizon, findings.crossing, findings.grazings, findings.count);
  return findings;
}

/// Where the basis of a case is told to expect a crossing: nowhere, where there is one, beside it, anywhere.
double drawn_expectation(const GuardCase& c, test::Random& random) {
  const double end = find(c, 0.0).crossing.s;
  switch (random.pick(6)) {
    case 0:
      return 0.0;
    case 1:
      return end;
    case 2:
      return c.horizon * random.uniform(0.0, 2.0);
    case 3:
      return c.horizon * random.logarithmic(1e-20, 1e20);
    default:
      break;
  }
  const double apart = random.logarithmic(1e-16, 0.3);
  return end * (1.0 + random.sign() * apart);
}

struct Tally {
  long searches = 0;
  long crossings = 0;
  long as_expected =
      0;  ///< crossings that an expectation mattered to, within a thousandth of where the basis expected one
  long grazings = 0;
  long contacts_decided = 0;  ///< pairs of roots, tangencies and narrow misses within a millionth of the period
  long missed = 0;
  long invented = 0;
  long undecided = 0;
  long cells = 0;
  double smallest_gap = 1.0;  ///< of a root pair that was told apart, in periods
  double worst_value = 0.0;   ///< |guard| at a crossing, in roundings
  double worst_error = 0.0;   ///< relative, of simple crossings
};

/// Compares what was found on one guard with the oracle's account.
class Comparison {
 public:
  Comparison(const GuardCase& c, std::size_t index, const Findings& findings, Tally& tally)
      : c_(c),
        f_(reference(c, c.guards[index])),
        account_(f_.account(static_cast<Real>(c.horizon))),
        own_(findings.crossing.found && findings.crossing.guard == static_cast<int>(index)),
        end_(static_cast<Real>(findings.crossing.s)),
        tally_(tally) {
    for (const core::Grazing& grazing : findings.grazings) {
      if (grazing.guard == static_cast<int>(index)) grazings_.push_back(static_cast<Real>(grazing.s));
    }
  }

  /// Empty when all agrees.
  std::string run();

 private:
  [[nodiscard]] Real s_of(std::size_t knot) const { return account_.knots[knot].s; }
  /// Whether the search has passed this place: not stopped before it by a crossing, rounding of times allowed for.
  [[nodiscard]] bool passed(Real s) const { return s < end_ * (1 - 1e-13L); }
  std::string inspect(const Contact& contact);
  std::string inspect_crossing(const Contact& contact, bool uncertain);
  void note_gap(Real root, std::size_t from);
  std::string missed(std::string_view what, Real s) {
    ++tally_.missed;
    return fmt::format("missed: {} at {:.17g}", what, static_cast<double>(s));
  }
  std::string invented(std::string_view what, Real s) {
    ++tally_.invented;
    return fmt::format("invented: {} at {:.17g}, level {:.3g}", what, static_cast<double>(s),
                       static_cast<double>(f_.level(s)));
  }

  const GuardCase& c_;
  ExponentialSum f_;
  ExponentialSum::Account account_;
  bool own_;
  Real end_;
  std::vector<Real> grazings_;
  Tally& tally_;
  bool explained_ = false;  ///< the crossing found belongs to a contact
};

std::string Comparison::run() {
  tally_.cells += account_.cells;
  if (!account_.complete || account_.knots.front().level < clear_level) {
    ++tally_.undecided;
    return "the oracle cannot decide";
  }
  std::size_t claimed = 0;
  for (const Contact& contact : contacts(account_.knots)) {
    const auto inside = std::count_if(grazings_.begin(), grazings_.end(),
                                      [&](Real s) { return s > s_of(contact.before) && s <= s_of(contact.after); });
    if (inside > static_cast<std::ptrdiff_t>(std::max<std::size_t>(contact.minima.size(), contact.open ? 1 : 0)))
      return invented("a second grazing of one contact", grazings_.back());
    claimed += static_cast<std::size_t>(inside);
    if (std::string why = inspect(contact); !why.empty()) return why;
    if (explained_) break;
  }
  for (const Real s : grazings_) {
    if (std::abs(f_.level(s)) > clear_level) return invented("a grazing", s);
  }
  if (claimed < grazings_.size()) return invented("a grazing", grazings_.back());
  if (own_ && !explained_) return invented("a crossing", end_);
  return {};
}

/// Touches first; then the crossing, when there is one.
std::string Comparison::inspect(const Contact& contact) {
  Real deepest = clear_level;
  for (const Knot& minimum : contact.minima) {
    deepest = std::min(deepest, minimum.level);
    const bool certain = std::abs(minimum.level) < sure_level && !contact.open && !contact.crosses;
    const bool here = own_ && end_ > s_of(contact.before) && end_ <= s_of(contact.after);
    if (!certain || !passed(s_of(contact.after)) || here) continue;
    ++tally_.contacts_decided;
    const bool reported = std::any_of(grazings_.begin(), grazings_.end(),
                                      [&](Real s) { return s > s_of(contact.before) && s < s_of(contact.after); });
    if (!reported) return missed("a tangency", minimum.s);
  }
  if (contact.open) deepest = std::min(deepest, account_.knots.back().level);
  if (contact.crosses || deepest < -sure_level) return inspect_crossing(contact, !contact.crosses);
  return {};
}

/// `uncertain`: so shallow that a grazing would do as well.
std::string Comparison::inspect_crossing(const Contact& contact, bool uncertain) {
  std::size_t first = contact.before;
  while (account_.knots[first + 1].level > 0) ++first;
  const Real root = f_.root(account_.knots[first], account_.knots[first + 1]);
  if (!own_ || end_ <= s_of(contact.before) || (uncertain && end_ > s_of(contact.after))) {
    const bool behind = passed(s_of(contact.after)) || (passed(root) && f_.level(end_) < -clear_level);
    if (!uncertain) return behind ? missed("a crossing", root) : "";
    const bool grazed = std::any_of(grazings_.begin(), grazings_.end(),
                                    [&](Real s) { return s > s_of(contact.before) && s < s_of(contact.after); });
    const bool nothing = !grazed && !contact.open && passed(s_of(contact.after));
    return nothing ? missed("a shallow pair of roots", root) : "";
  }
  if (end_ > s_of(contact.after)) return missed("a crossing", root);
  // The value at the place found is rounding, or what a rounding of the place does.
  const Real slope = std::abs(f_.jet(end_)[1]);
  const Real left = std::max(Real(0), std::abs(f_.at(end_)) - slope * 4 * 0x1p-53L * end_) / f_.rounding(end_);
  if (left > 1.25L) return invented("a crossing beside the root", end_);
  explained_ = true;
  tally_.worst_value = std::max(tally_.worst_value, static_cast<double>(left));
  // Simple: the rounding of the value moves it by less than 1e-12 of the time.
  if (f_.rounding(root) < 1e-12L * root * std::abs(f_.jet(root)[1])) {
    tally_.worst_error = std::max(tally_.worst_error, static_cast<double>(std::abs(end_ - root) / root));
  }
  if (contact.minima.empty()) note_gap(root, first + 1);
  return {};
}

/// The gap to the next root after a crossing that is certain.
void Comparison::note_gap(Real root, std::size_t from) {
  for (std::size_t i = from; i + 1 < account_.knots.size(); ++i) {
    if (account_.knots[i + 1].level <= 0) continue;
    const Real gap = f_.root(account_.knots[i], account_.knots[i + 1]) - root;
    tally_.smallest_gap = std::min(
        tally_.smallest_gap, static_cast<double>(gap * static_cast<Real>(c_.rate / (2.0 * std::numbers::pi))));
    return;
  }
}

}  // namespace

TEST_CASE("Random guards: nothing missed, nothing invented, every tangency reported") {
  // DUALDAMP_CROSSING_CASES=1000000 for the long run; DUALDAMP_CROSSING_SEED for another one.
  const long cases = test::case_count("DUALDAMP_CROSSING_CASES", 10000);
  const long seed = test::case_count("DUALDAMP_CROSSING_SEED", 2026);
  test::Random random(static_cast<std::uint64_t>(seed));
  test::Random expectations(static_cast<std::uint64_t>(seed + 1));
  Tally tally;
  long wrong = 0;
  for (long i = 0; i < cases; ++i) {
    const GuardCase c = test::random_guards(random);
    // An expectation matters to a lone guard alone that starts at zero on an even basis: few cases, so they are
    // searched more often.
    const bool matters = c.guards.size() == 1 && c.guards[0].zeros > 0 && basis_of(c, c.horizon).expected() > 0.0;
    for (int search = matters ? 20 : 1; search > 0; --search) {
      const double expected = drawn_expectation(c, expectations);
      const Findings findings = find(c, expected);
      ++tally.searches;
      CHECK(findings.end != core::SearchEnd::left_range);  // no guard grows beyond e^300
      tally.crossings += findings.crossing.found ? 1 : 0;
      tally.grazings += static_cast<long>(findings.grazings.size());
      tally.as_expected += matters && findings.crossing.found &&
                           std::abs(findings.crossing.s - expected) < 1e-3 * findings.crossing.s;
      for (std::size_t guard = 0; guard < c.guards.size(); ++guard) {
        const std::string why = Comparison(c, guard, findings, tally).run();
        if (why.empty()) continue;
        if (++wrong > 5) continue;
        UNSCOPED_INFO("case " << i << ", guard " << guard << ", expected at " << expected << ": " << why << "\n"
                              << describe(c));
      }
    }
  }
  CHECK(wrong == 0);
  CHECK(tally.as_expected > cases / 100);
  WARN(fmt::format(
      "{} searches: {} crossings, {} of them as expected, {} grazings, {} missed, {} invented, {} undecided by the "
      "oracle\n"
      "smallest gap of a root pair told apart: {:.2g} periods; tangencies sure to be reported: {}\n"
      "largest error of a simple root: {:.2g} of the time; largest value at a root: {:.2f} roundings\n"
      "{} cells of the oracle",
      tally.searches, tally.crossings, tally.as_expected, tally.grazings, tally.missed, tally.invented,
      tally.undecided, tally.smallest_gap, tally.contacts_decided, tally.worst_error, tally.worst_value,
      tally.cells));
}
