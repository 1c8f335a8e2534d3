#include "core/crossing/first_crossing.hpp"

#include "tests/core/crossing/guard_problems.hpp"

using namespace dualdamp::core;
using namespace dualdamp::core::guard_problems;

// ---------------------------------------------------------------------------------------------------------------
// The checklist. Tolerance of a simple root: g is known to a few eps of its amplitudes A, so s is known to a few
// eps A/|g'(s)|; where |g'| is of the order A times the frequency that is a few eps of a period.

TEST_CASE("A simple crossing is found to rounding") {
  check_crossing(search({cosine(1.0, 2.0)}, 10.0), 0, pi / 4.0, 4 * epsilon);
  check_crossing(search(polynomial({1.0, -1.0}), 10.0), 0, 1.0, 4 * epsilon);
  check_crossing(search({{-1.0, 1.0}, constant(-0.25)}, 10.0), 0, std::log(4.0), 8 * epsilon);
}

TEST_CASE("Values of the elements at the crossing and at the horizon come with the result") {
  const Problem problem({{cosine(1.0, 2.0), {Complex(-0.1, 3.0), 0.01}}});
  for (const double horizon : {0.3, 5.0}) {
    const Result result = search(problem, horizon);
    CHECK(result.crossing.found == (horizon > 1.0));
    if (!result.crossing.found) CHECK(result.crossing.s == horizon);
    ExponentialBasis::Values expected;
    problem.basis().evaluate(result.crossing.s, expected);
    for (std::size_t k = 0; k < 2; ++k) {
      CHECK(std::abs(result.crossing.values.re[k] - expected.re[k]) <= 8 * epsilon);
      CHECK(std::abs(result.crossing.values.im[k] - expected.im[k]) <= 8 * epsilon);
    }
  }
}

TEST_CASE("A horizon of zero finds nothing") {
  const Result result = search({cosine(1.0, 2.0)}, 0.0);
  CHECK_FALSE(result.crossing.found);
  CHECK(result.crossing.s == 0.0);
}

TEST_CASE("Identical guards cross together and one of them is reported") {
  const Terms terms = {cosine(1.0, 2.0), constant(0.3)};
  const Result result = search(Problem({terms, terms}), 10.0);
  REQUIRE(result.crossing.found);
  CHECK(std::abs(result.crossing.s - std::acos(-0.3) / 2.0) <= 8 * epsilon);
}

TEST_CASE("Of two guards that cross close to each other the first is reported, in either order") {
  for (const double distance : {1e-1, 1e-4, 1e-8, 1e-12}) {
    const Terms early = polynomial({1.0, -1.0});
    const Terms late = polynomial({1.0 + distance, -1.0});
    check_crossing(search(Problem({early, late}), 10.0), 0, 1.0, 8 * epsilon);
    check_crossing(search(Problem({late, early}), 10.0), 1, 1.0, 8 * epsilon);
  }
}

TEST_CASE("After an event the search starts anew from the crossing with its zero factored out") {
  // sin s from every one of its zeros: the next one, half a period on, is found and the old one is not found again.
  double s = 0.0;
  double side = 1.0;
  for (int i = 1; i <= 100; ++i) {
    // side sin(s0 + s), s0 = s: its value at the start is rounding and is declared a zero.
    const Result result = search({cosine(side, 1.0, s - pi / 2.0)}, 10.0, 1);
    REQUIRE(result.crossing.found);
    s += result.crossing.s;
    side = -side;
    CHECK(std::abs(s - i * pi) <= 4 * epsilon * s);
  }
}

TEST_CASE("Zeros at the start, of order one to three, are not crossings; the next crossing is") {
  // s^n (1 - s) without and with a fast partner that pushes the panels below 1.
  for (const int order : {1, 2, 3}) {
    std::vector<double> c(static_cast<std::size_t>(order) + 2, 0.0);
    c[static_cast<std::size_t>(order)] = 1.0;
    c[static_cast<std::size_t>(order) + 1] = -1.0;
    CAPTURE(order);
    check_crossing(search(polynomial(c), 10.0, order), 0, 1.0, 64 * epsilon);
    CHECK(search(polynomial(c), 0.9, order).crossing.found == false);
  }
  // sin s, 1 - cos s = 2 sin^2(s/2) touches zero again at 2 pi; s - sin s never does.
  check_crossing(search({cosine(1.0, 1.0, -pi / 2.0)}, 10.0, 1), 0, pi, 8 * epsilon);
  CHECK_FALSE(search({constant(1.0), cosine(-1.0, 1.0)}, 6.0, 2).crossing.found);
  const Terms cubic = {{0.0, 0.0}, {0.0, 1.0, 0}, cosine(-1.0, 1.0, -pi / 2.0)};
  CHECK_FALSE(search(cubic, 100.0, 3).crossing.found);
}

TEST_CASE("Rounding at a known zero is not a crossing") {
  // v(0) = 0 and v'(0) = 0 up to one part in 1e16, of either sign, as a release with static = kinetic leaves them:
  // 1 - cos s + delta s + delta, positive for s > 0 but for the rounding.
  for (const double delta : {-3e-16, -1e-17, 1e-17, 3e-16}) {
    const Terms terms = {constant(1.0 + delta), {0.0, delta, 0}, cosine(-1.0, 1.0)};
    CAPTURE(delta);
    const Result result = search(terms, 6.0, 2);
    CHECK_FALSE(result.crossing.found);
    CHECK(result.grazings.empty());
  }
}

TEST_CASE("A crossing very near a factored zero is found") {
  // s^n (d - s) e^(-s)-like: on the scale d everything else is constant. The factored form knows g to a few eps of
  // s^n A, so d is known to a few eps of d.
  for (const int order : {1, 2, 3}) {
    for (const double d : {1e-1, 1e-2, 1e-4, 1e-6, 1e-8}) {
      std::vector<double> c(static_cast<std::size_t>(order) + 2, 0.0);
      c[static_cast<std::size_t>(order)] = d;
      c[static_cast<std::size_t>(order) + 1] = -1.0;
      CAPTURE(order, d);
      check_crossing(search(polynomial(c), 10.0, order), 0, d, 64 * epsilon * d);
    }
  }
  // The same with oscillations: sin(s)(1 - sin(s)/d) = sin s - (1 - cos 2s)/(2d) crosses at asin d.
  for (const double d : {0.5, 1e-2, 1e-4, 1e-6}) {
    const Terms terms = {cosine(1.0, 1.0, -pi / 2.0), constant(-0.5 / d), cosine(0.5 / d, 2.0)};
    CAPTURE(d);
    check_crossing(search(terms, 3.0, 1), 0, std::asin(d), 64 * epsilon * std::asin(d) + 4 * epsilon * d);
  }
}

TEST_CASE("A guard that is negative at the start counts as crossed there") {
  const Result result = search(polynomial({-1e-3, 1.0}), 10.0);
  REQUIRE(result.crossing.found);
  CHECK(result.crossing.s <= 1e-12);
}

TEST_CASE("A zero at the horizon belongs to the next search") {
  for (const int periods : {1, 3, 100}) {
    const double horizon = pi / 2.0 + 2.0 * pi * (periods - 1);
    // cos s + cut off the earlier crossings: 1 + cos s touches zero only; use a ramp for one crossing at the end.
    const Result result = search({constant(horizon), {0.0, -1.0, 0}}, horizon);
    CHECK_FALSE(result.crossing.found);
    CHECK(result.grazings.empty());
  }
  CHECK_FALSE(search({cosine(1.0, 1.0)}, pi / 2.0).crossing.found);
  // A crossing just before the horizon is an event, one just behind is not.
  check_crossing(search({cosine(1.0, 1.0)}, pi / 2.0 + 1e-12), 0, pi / 2.0, 4 * epsilon);
  CHECK_FALSE(search({cosine(1.0, 1.0)}, pi / 2.0 - 1e-12).crossing.found);
}

TEST_CASE("A crossing is found to rounding wherever it is expected") {
  // sin(s + 0.3) - sin(0.3)
  const Terms terms{cosine(1.0, 1.0, 0.3 - 0.5 * pi), constant(-std::sin(0.3)), cosine(0.0, 2.0)};
  const double root = pi - 0.6;
  for (const double expected : {0.0, root, root * (1.0 + 4 * epsilon), root + 1e-9, root - 1e-4, root + 0.02,
                                root + 0.049, root - 0.06, 0.5, root + 2.0 * pi, 1e-300, 1e9}) {
    const Result result = search(Problem({terms}, 1, expected), 10.0);
    check_crossing(result, 0, root, 8 * epsilon * root);
    CHECK(result.count.splits == 0);
  }
}

TEST_CASE("An expected crossing does not hide what comes before it") {
  // 1 - cos s + d sin s starts with slope d and is zero at 2 pi n and where tan(s/2) = -d: a narrow dip before each
  // 2 pi n, which it enters with slope -d.
  const double d = 1e-3;
  const Terms terms{constant(1.0), {Complex(0.0, 1.0), Complex(-1.0, -d)}};
  const double root = 2.0 * (pi - std::atan(d));
  for (const double expected : {root, 2.0 * pi, root + 2.0 * pi, 4.0 * pi}) {
    check_crossing(search(Problem({terms}, 1, expected), 20.0), 0, root, 16 * epsilon * root / d);
  }
  const Terms touching{constant(1.0), cosine(-1.0, 1.0)};
  const Result touched = search(Problem({touching}, 2, 2.0 * pi), 10.0);
  CHECK_FALSE(touched.crossing.found);
  CHECK(touched.grazings.size() == 1);
}

TEST_CASE("An expected crossing at or behind the horizon belongs to the next search") {
  const Problem problem({{cosine(1.0, 1.0, -0.5 * pi)}}, 1, pi * (1.0 - epsilon));
  CHECK_FALSE(search(problem, pi).crossing.found);
  CHECK_FALSE(search(problem, pi * (1.0 + epsilon)).crossing.found);
  CHECK_FALSE(search(problem, pi - 1e-12).crossing.found);
  check_crossing(search(problem, pi + 1e-12), 0, pi, 8 * epsilon);
}

TEST_CASE("A fast transient that has died out neither hides a slow root nor costs panels") {
  for (const double decay : {10.0, 1e3, 1e6}) {
    // 1 + e^(-decay s) - s/1000
    const Result result = search({constant(1.0), {0.0, -1e-3, 0}, {-decay, 1.0}}, 1e4);
    CAPTURE(decay);
    check_crossing(result, 0, 1000.0, 1e4 * epsilon);
    const Result ringing = search({cosine(1.0, 1e-3, 0.1), {Complex(-decay, 5.0 * decay), 0.5}}, 1e5);
    check_crossing(ringing, 0, (pi / 2.0 - 0.1) * 1e3, 1e4 * epsilon);
    CHECK(ringing.count.panels < 400);
  }
}

TEST_CASE("A guard that decays to nothing is searched down to the end without grazings") {
  // exp keeps its sign and its relative precision: there is no zero and nothing to report, at any horizon.
  const std::vector<std::pair<Terms, int>> cases = {
      {{{-1.0, 1.0}}, 0},
      {{{-1.0, 1.0}, {-2.0, -1.0}}, 1},       // e^-s - e^-2s
      {{{-1.0, 1.0}, {-1.0, 1.0, 0}}, 0},     // e^-s (1 + s)
      {{{-1.0, 0.0}, {-1.0, 1.0, 0}}, 1},     // s e^-s
      {{{-0.01, 0.0}, {-100.0, 1.0, 0}}, 1},  // overdamped release
      {{{-1.0, 1.0}, {Complex(-1.0, 3.0), 0.9}}, 0},
  };
  for (const auto& [terms, zeros] : cases) {
    for (const double horizon : {30.0, 100.0, 1e4, 1e6}) {
      const Result result = search(terms, horizon, zeros);
      CAPTURE(terms.size(), horizon);
      CHECK_FALSE(result.crossing.found);
      CHECK(result.grazings.empty());
    }
  }
}

TEST_CASE("A crossing far down a decay is found") {
  // e^-s (1 - s/60) at 60, where the guard has fallen to 1e-26 of its start.
  check_crossing(search({{-1.0, 1.0}, {-1.0, -1.0 / 60.0, 0}}, 100.0), 0, 60.0, 256 * epsilon * 60.0);
  // e^-s - 1e-15 e^(-s/2) at 2 ln 1e15.
  check_crossing(search({{-1.0, 1.0}, {-0.5, -1e-15}}, 100.0), 0, 2.0 * std::log(1e15), 256 * epsilon * 70.0);
}

TEST_CASE("Far down a decay a zero behind the horizon is not taken for one before it") {
  // Decayed by e^-225 at the horizon. The root lies 3e-15 behind it, less than a hundredth of an ulp; rounding of
  // -0.046 s in the exponent would be 2 roundings of the guard and put it before.
  const Terms terms = {{-2.8412283360639235e-05, -8.1813949472038238e-101},
                       {-0.046369285302411467, 0.0032136842669512294},
                       constant(0.0),
                       cosine(0.0, 0.0012455067006126768)};
  const double horizon = 4849.2589766104156;
  const auto level = reference(terms).level(horizon);
  REQUIRE((level > 0 && level < 0.1L));
  CHECK_FALSE(search(terms, horizon).crossing.found);
  const double behind = 2.0 * horizon;
  check_crossing(search(terms, behind), 0, horizon, 2 * epsilon * horizon);
}

TEST_CASE("Growing guards") {
  // 2 - e^s at ln 2; e^s (1 + 0.9 cos 5s) never; e^(s/10) cos s at pi/2; cosh-like growth past all bounds.
  check_crossing(search({constant(2.0), {1.0, -1.0}}, 50.0), 0, std::log(2.0), 16 * epsilon);
  CHECK_FALSE(search({{1.0, 1.0}, {Complex(1.0, 5.0), 0.9}}, 100.0).crossing.found);
  check_crossing(search({{Complex(0.1, 1.0), 1.0}}, 50.0), 0, pi / 2.0, 16 * epsilon);
  const Result late = search({{0.5, 1e-12}, constant(-1.0), {-1e-3, 2.0}}, 50.0);
  CHECK_FALSE(late.crossing.found);
  check_crossing(search({{0.5, -1e-12}, constant(1.0)}, 100.0), 0, 2.0 * std::log(1e12), 1024 * epsilon);
}

TEST_CASE("Secular terms: resonance without damping, critical damping, polynomials") {
  // 1 - s sin(s)/20 with s exp(is) for the nodes i, i; against the reference.
  const Terms forced = {constant(1.0), cosine(0.0, 1.0), {Complex(0.0, 1.0), Complex(0.0, 0.05), 1}};
  check_crossing(search(forced, 100.0), 0, static_cast<double>(reference(forced).first_crossing(100.0L).value()),
                 1e-13);
  // e^-s (1 - s)
  check_crossing(search({{-1.0, 1.0}, {-1.0, -1.0, 0}}, 10.0), 0, 1.0, 16 * epsilon);
  // 1 - s^5
  check_crossing(search(polynomial({1.0, 0.0, 0.0, 0.0, 0.0, -1.0}), 10.0), 0, 1.0, 1024 * epsilon);
}

TEST_CASE("Constant and identically zero guards never cross") {
  const Result zero = search({constant(0.0), cosine(0.0, 3.0)}, 100.0);
  CHECK_FALSE(zero.crossing.found);
  CHECK(zero.grazings.empty());
  CHECK_FALSE(search({constant(1e-9)}, 1e12).crossing.found);
  CHECK_FALSE(search({constant(1.0), cosine(0.0, 3.0)}, 1e3).crossing.found);
  // A zero guard beside one that crosses.
  check_crossing(search(Problem({{constant(0.0)}, {cosine(1.0, 1.0)}}), 10.0), 1, pi / 2.0, 4 * epsilon);
}
