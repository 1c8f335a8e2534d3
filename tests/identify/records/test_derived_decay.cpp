#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "identify/ledger/histories/history_rows.hpp"
#include "identify/readers/time_base.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/records/usable_histories.hpp"
#include "sim/analytic/free_decay.hpp"
#include "tests/identify/histories.hpp"
#include "tests/identify/records/bearing_records.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("The turning points of a free decay, against the closed form") {
  for (const double X : {15e-3, 60e-3}) {
    const std::vector<double> exact = sim::analytic::free_decay_extremes(soft_zeta, soft_x_f, X, 20);
    const DerivedDecay decay = decay_of(released(X, 1.5, 2000.0));
    CAPTURE(X);
    // Released from rest at the first sample, and at rest at the end: these are extremes too.
    REQUIRE(decay.record.extremes.size() == exact.size());
    // A fit of fourth order over an eighth of a period errs by its next term, about (pi/4)^5/5!/2^4 of the swing:
    // 1.6e-4.
    for (std::size_t i = 0; i < exact.size(); ++i) {
      CAPTURE(i, decay.record.times[i]);
      CHECK(decay.record.extremes[i] == Approx(exact[i]).margin(1e-4 * X));
    }
    CHECK(decay.record.times[1] - decay.record.times[0] ==
          Approx(M_PI / (natural * std::sqrt(1.0 - soft_zeta * soft_zeta))).epsilon(2e-3));
  }
}

TEST_CASE("Extremes are read down to 16 samples a period; below, the rate that is needed is named") {
  constexpr double X = 60e-3;
  const std::vector<double> exact = sim::analytic::free_decay_extremes(soft_zeta, soft_x_f, X, 20);
  for (const double samples : {17.3, 20.0, 24.7, 32.1, 48.0, 63.0}) {
    const DerivedDecay decay = decay_of(released(X, 1.5, samples * natural / (2.0 * M_PI)));
    CAPTURE(samples, decay.fault);
    REQUIRE(decay.record.extremes.size() == exact.size());
    // The fit spans a quarter of the period on each side at 16 samples a period, an eighth from 32 on. Its error of
    // fifth order grows as the fifth power: 2e-4 at 16.
    for (std::size_t i = 0; i < exact.size(); ++i)
      CHECK(decay.record.extremes[i] == Approx(exact[i]).margin(2.5e-4 * X));
  }
  Record record;
  record.histories = {released(X, 1.5, 12.0 * natural / (2.0 * M_PI))};
  const std::string reason = decay_of(record.histories[0]).fault;
  CHECK(reason.find("a sample rate of about") != std::string::npos);
  CHECK(fault_of_histories(record).empty());  // the simulated motion needs no extremes
  const std::vector<std::string> warnings = complete(record);
  CHECK_FALSE(record.decay.has_value());
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find(reason) != std::string::npos);
}

TEST_CASE("Ripple, and the fast motion of a mass that sticks to its contact, are no swings of the decay") {
  constexpr double X = 60e-3;
  const History clean = released(X, 4.0, 1000.0);
  const std::vector<double> exact = sim::analytic::free_decay_extremes(soft_zeta, soft_x_f, X, 20);
  testing::Normal normal(19);

  // Mains of eight times the natural frequency, and a long rest in which nothing else moves.
  History humming = clean;
  for (std::size_t i = 0; i < humming.x.size(); ++i)
    humming.x[i] += 2e-3 * X * std::cos(8.1 * natural * static_cast<double>(i) / 1000.0) + 1e-6 * normal();
  const DerivedDecay read = decay_of(humming);
  CAPTURE(read.fault);
  REQUIRE(read.record.extremes.size() + 1 >= exact.size());
  for (std::size_t i = 0; i + 1 < exact.size(); ++i)
    CHECK(read.record.extremes[i] == Approx(exact[i]).margin(3e-3 * X));

  // A tail that shrinks slowly, at 1.8 times the frequency.
  History sticking = clean;
  std::size_t stop = clean.x.size();
  while (stop > 0 && clean.x[stop - 1] == clean.x.back()) --stop;
  for (std::size_t i = stop; i < clean.x.size(); ++i) {
    const double t = static_cast<double>(i - stop) / 1000.0;
    sticking.x[i] += 0.01 * X * std::exp(-0.1 * natural * t) * (std::cos(1.8 * natural * t) - 1.0);
  }
  for (double& x : sticking.x) x += 1e-6 * normal();
  const DerivedDecay cut = decay_of(sticking);
  CAPTURE(cut.fault);
  REQUIRE(cut.record.extremes.size() + 1 >= exact.size());
  CHECK(cut.record.extremes.size() <= exact.size() + 1);
  REQUIRE(cut.warnings.size() == 1);
  CHECK(cut.warnings[0].find("become faster") != std::string::npos);
  CHECK(cut.last < stop + 200);
}

TEST_CASE("A release from rest at the first sample is an extreme, however much noise hides its slope") {
  // Fourteen x_f, 40 samples a half swing, noise of 0.4 % and 1 % of the release.
  sim::Model model = soft_bearing();
  model.oscillator.damping = 2.0 * 0.03 * std::sqrt(mass * stiffness);
  const double X = 14.0 * soft_x_f;
  model.initial = {X, 0.0};
  const History still = sampled_displacements(model, 2.0, 500.0);
  model.initial = {0.9 * X, -0.4 * X * natural};  // an eighth of a half swing after the turn
  const History moving = sampled_displacements(model, 2.0, 500.0);
  for (const double share : {0.004, 0.01}) {
    int begun = 0;
    int turned = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      testing::Normal normal(seed);
      const auto noisy = [&](History history) {
        history.y.clear();
        for (double& x : history.x) x += share * X * normal();
        return history;
      };
      const DerivedDecay decay = decay_of(noisy(still));
      begun += decay.first == 0 ? 1 : 0;
      if (decay.first == 0) CHECK(decay.record.extremes[0] == Approx(X).margin(4.0 * share * X));
      turned += decay_of(noisy(moving)).first > 0 ? 1 : 0;
    }
    CAPTURE(share);
    CHECK(begun >= (share < 0.005 ? 18 : 14));  // at 1 % the times of the later turning points are uncertain too
    CHECK(turned == 20);
  }
}

TEST_CASE("Noise that turns within the first samples of a release adds no extreme") {
  // Noise that grows with the reading is largest there, and large beside its mean over the record.
  constexpr double X = 60e-3;
  const std::vector<double> exact = sim::analytic::free_decay_extremes(soft_zeta, soft_x_f, X, 20);
  int without_release = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    History history = released(X, 3.0, 1000.0);
    testing::Normal normal(seed);
    for (double& x : history.x) x *= 1.0 + 5e-3 * normal();
    const DerivedDecay decay = decay_of(history);
    CAPTURE(decay.fault);
    const std::size_t count = decay.record.extremes.size();
    REQUIRE((count == exact.size() || count + 1 == exact.size()));
    without_release += count < exact.size() ? 1 : 0;
    for (std::size_t i = 0; i < count; ++i)
      CHECK(decay.record.extremes[i] == Approx(exact[exact.size() - count + i]).margin(1e-2 * X));
  }
  // The noise may show a velocity.
  CHECK(without_release < 10);
}

TEST_CASE("A rest that wanders beyond the noise does not make the few swings before it long") {
  const std::vector<double> exact = {0.020, -0.0105, 0.0047, -0.0011};
  constexpr int half_swing = 15;
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    History history;
    history.sample_rate = 50.0;
    history.begins_free = true;
    testing::Normal normal(seed);
    double wander = 0.0;
    for (int i = 0; i < 300; ++i) {
      const std::size_t from = std::min<std::size_t>(static_cast<std::size_t>(i / half_swing), exact.size() - 2);
      const double phase = std::min(M_PI, M_PI * i / half_swing - M_PI * static_cast<double>(from));
      history.x.push_back(0.5 * (exact[from] + exact[from + 1]) +
                          0.5 * (exact[from] - exact[from + 1]) * std::cos(phase) + (wander += 1e-6 * normal()));
    }
    const DerivedDecay decay = decay_of(history);
    CAPTURE(decay.fault);
    REQUIRE(decay.record.extremes.size() >= 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK(decay.record.extremes[i] == Approx(exact[i]).epsilon(0.01));
  }
}

TEST_CASE("A last swing that is smaller than the noise's band is told from a stop at the last turning point") {
  // In units of x_f, the last turning point is at `last`, and the mass comes to rest on the same side.
  const double zeta = 0.01;
  sim::Model model = soft_bearing();
  model.oscillator.damping = 2.0 * zeta * std::sqrt(mass * stiffness);
  const double R = std::exp(-M_PI * zeta / std::sqrt(1.0 - zeta * zeta));
  const double noise = 0.05 * soft_x_f;
  for (const double last : {0.5, 0.98, 1.05, 1.1, 1.3}) {
    double X = last;
    for (int swing = 0; swing < 10; ++swing) X = (X + 1.0 + R) / R;
    model.initial = {X * soft_x_f, 0.0};
    const std::vector<double> exact = sim::analytic::free_decay_extremes(zeta, soft_x_f, X * soft_x_f, 20);
    REQUIRE(exact.size() == (last > 1.0 ? 12 : 11));
    const History clean = sampled_displacements(model, 3.0, 500.0);
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      History history = clean;
      history.y.clear();
      testing::Normal normal(seed);
      for (double& x : history.x) x += noise * normal();
      const DerivedDecay decay = decay_of(history);
      CAPTURE(last, seed, decay.fault);
      REQUIRE(decay.record.extremes.size() == exact.size());
      CHECK(decay.record.extremes[10] == Approx(exact[10]).margin(2.0 * noise));
      CHECK(decay.record.extremes.back() == Approx(exact.back()).margin(0.5 * noise));
    }
  }
}

TEST_CASE("A blow within the first samples is no part of the free motion") {
  // The mass is pushed for 20 ms, from the first sample on; the period is ten times as long.
  sim::Model model = soft_bearing();
  constexpr double rate = 1000.0;
  model.initial = {0.0, 60e-3 * natural};
  History history = sampled_displacements(model, 1.5, rate);
  history.y.clear();
  std::vector<double> pushed;
  for (int i = 0; i < 20; ++i) pushed.push_back(history.x[10] * 0.5 * std::pow(i / 20.0, 2.0));
  history.x.erase(history.x.begin(), history.x.begin() + 5);
  history.x.insert(history.x.begin(), pushed.begin(), pushed.end());
  const DerivedDecay decay = decay_of(history);
  REQUIRE(decay.record.extremes.size() > 3);
  CHECK(static_cast<double>(decay.first) == Approx(decay.record.times[0] * rate).margin(1.0));
  CHECK(decay.first > 20);

  // A release from rest keeps all samples.
  CHECK(decay_of(released(60e-3, 1.5, rate)).first == 0);
}

TEST_CASE("Held, released, at rest, in noise") {
  constexpr double sigma = 3e-6;  // the paper's resolution
  for (const double X : {15e-3, 60e-3}) {
    History history = released(X, 1.5, 2000.0);
    history.x.insert(history.x.begin(), 400, X);
    testing::Normal normal(11);
    for (double& x : history.x) x += sigma * normal();
    const DerivedDecay decay = decay_of(history);
    const std::vector<double> exact = sim::analytic::free_decay_extremes(soft_zeta, soft_x_f, X, 20);
    CAPTURE(X);
    REQUIRE(decay.record.extremes.size() == exact.size());
    for (std::size_t i = 0; i < exact.size(); ++i) {
      CAPTURE(i, decay.record.times[i], decay.standard_errors[i]);
      // Five standard errors beside the error of the fit.
      CHECK(decay.record.extremes[i] == Approx(exact[i]).margin(1e-4 * X + 5.0 * decay.standard_errors[i]));
      CHECK(decay.standard_errors[i] < sigma);
    }
    // The noise hides when the mass stopped, by up to a sixth of a half period.
    const std::size_t last = exact.size() - 1;
    if (last < 3) continue;  // one turning point, and a release that is hidden as well
    CHECK(decay.record.times[last] - decay.record.times[last - 1] ==
          Approx(M_PI / (natural * std::sqrt(1.0 - soft_zeta * soft_zeta))).epsilon(2e-3));
  }
}

TEST_CASE("The noise of a long rest adds no extremes") {
  // 25,000 samples of rest, whose noise spans more than eight of its deviations.
  const double sigma = 5e-5;
  const History clean = released(60e-3, 15.0, 2000.0);
  const std::vector<double> exact = sim::analytic::free_decay_extremes(soft_zeta, soft_x_f, 60e-3, 20);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    History history = clean;
    testing::Normal normal(seed);
    for (double& x : history.x) x += sigma * normal();
    const DerivedDecay decay = decay_of(history);
    CAPTURE(seed, decay.fault);
    REQUIRE(decay.record.extremes.size() == exact.size());
    CHECK(decay.record.times.back() < 1.5);
  }
}

TEST_CASE("Noise that lasts over some samples adds no swing about the position of rest") {
  // Each error has a correlation of 0.8 with the next: differences show 0.36 of their deviation.
  constexpr double sigma = 5e-5;
  constexpr double correlation = 0.8;
  const History clean = released(60e-3, 3.0, 500.0);
  const std::vector<double> exact = sim::analytic::free_decay_extremes(soft_zeta, soft_x_f, 60e-3, 20);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    History history = clean;
    testing::Normal normal(seed);
    double error = sigma * normal();
    for (double& x : history.x) {
      x += error;
      error = correlation * error + std::sqrt(1.0 - correlation * correlation) * sigma * normal();
    }
    const DerivedDecay decay = decay_of(history);
    CAPTURE(seed, decay.fault);
    CHECK(decay.record.extremes.size() <= exact.size());
    CHECK(decay.record.extremes.size() + 1 >= exact.size());
    CHECK(decay.rests);
  }
}

TEST_CASE("Ripple about the position of rest is no swing of the decay, and no zero of the sensor") {
  constexpr double sigma = 5e-5;
  const std::vector<double> exact = sim::analytic::free_decay_extremes(soft_zeta, soft_x_f, 60e-3, 20);
  const History clean = released(60e-3, 4.0, 1000.0);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    History history = clean;
    testing::Normal normal(seed);
    for (std::size_t i = 0; i < history.x.size(); ++i)
      history.x[i] += 3.0 * sigma * std::sin(8.1 * natural * static_cast<double>(i) / 1000.0) + sigma * normal();
    const DerivedDecay decay = decay_of(history);
    CAPTURE(seed, decay.fault);
    REQUIRE(decay.record.extremes.size() + 1 >= exact.size());
    CHECK(decay.record.extremes.size() <= exact.size());
    CHECK(decay.record.times.back() < 1.5);
    Record record;
    record.histories = {history};
    for (const std::string& warning : complete(record))
      CHECK(warning.find("the zero of the sensor") == std::string::npos);
  }
}

TEST_CASE("Interpolated samples overshoot where the mass stops: this is no swing and no zero of the sensor") {
  const std::vector<double> exact = sim::analytic::free_decay_extremes(soft_zeta, soft_x_f, 60e-3, 20);
  constexpr double rate = 20000.0;
  const History dense = released(60e-3, 4.0, rate);
  for (int begin = 0; begin < 12; ++begin) {
    // Steps of 1.2 to 4.8 ms, as a solver writes them.
    std::vector<double> t;
    std::vector<double> x;
    for (double at = 0.0; at < 79990.0;) {
      t.push_back(std::round(at) / rate);
      x.push_back(dense.x[static_cast<std::size_t>(std::round(at))]);
      at += 60.0 * (1.0 + 0.6 * std::sin(0.05 * static_cast<double>(t.size()) + begin));
    }
    Record record;
    History& history = record.histories.emplace_back();
    history.sample_rate = static_cast<double>(t.size() - 1) / (t.back() - t.front());
    history.x = even_samples({.is_interpolated = true}, t, x);
    const DerivedDecay decay = decay_of(history);
    CAPTURE(begin, decay.fault);
    CHECK(decay.record.extremes.size() == exact.size());
    for (const std::string& warning : complete(record))
      CHECK(warning.find("the zero of the sensor") == std::string::npos);
  }
}

TEST_CASE("Swings that shrink by less than the noise of their extremes are a free decay") {
  sim::Model model = soft_bearing();
  model.oscillator.damping = 2.0 * 0.002 * std::sqrt(mass * stiffness);
  model.friction = {friction::Law(friction::Coulomb(0.03e-3 * stiffness, 0.03e-3 * stiffness))};
  model.initial = {20e-3, 0.0};
  // 32 samples a period; a swing shrinks by 0.37 mm at first and by 0.18 mm at a quarter.
  const History clean = sampled_displacements(model, 40.0, 32.0 * natural / (2.0 * M_PI));
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    History history = clean;
    history.y.clear();
    testing::Normal normal(seed);
    for (double& x : history.x) x += 1e-4 * normal();
    const DerivedDecay decay = decay_of(history);
    CAPTURE(seed, decay.fault);
    CHECK(decay.fault.empty());
    CHECK(decay.record.extremes.size() > 60);
  }
}

TEST_CASE("A motion that something drives is no free vibration, whose swings shrink") {
  constexpr double rate = 200.0;
  const auto driven = [](double duration, auto swing) {
    testing::Normal normal(3);
    History history{.sample_rate = rate};
    for (int i = 0; i < static_cast<int>(duration * rate); ++i) {
      const double t = i / rate;
      history.x.push_back(swing(t) * std::sin(natural * t) + 1e-3 * normal());
    }
    return history;
  };
  // Resonance from rest, a sweep through it, and a steady motion.
  for (const History& history : {driven(20.0, [](double t) { return 1.0 - std::exp(-0.5 * t); }),
                                 driven(20.0, [](double t) { return 1.0 / (1.0 + (t - 8.0) * (t - 8.0)); }),
                                 driven(20.0, [](double) { return 1.0; })}) {
    const DerivedDecay decay = decay_of(history);
    CHECK(decay.is_driven);
    CHECK(decay.fault.ends_with("the drive of the motion was not recorded"));
    Record record;
    record.histories = {history};
    static_cast<void>(complete(record));
    CHECK_FALSE(record.decay.has_value());
    Estimate estimate;
    CHECK(usable_histories(record, {}, estimate).empty());
    CHECK(estimate.outcome.reason.find("record the force or the motion of the base too") != std::string::npos);
    // Methods of random responses know no drive either.
    Estimate of_noise;
    CHECK(usable_histories(record, {}, of_noise, UnmeasuredDrive::noise).size() == 1);
  }
  const DerivedDecay free = decay_of(driven(20.0, [](double t) { return std::exp(-0.0005 * t); }));
  CHECK(free.fault.empty());  // a hundredth in 40 periods
  CHECK_FALSE(free.is_driven);
}

TEST_CASE("A free vibration begins where a steady drive is taken away") {
  constexpr double zeta = 0.02;
  constexpr double rate = 200.0;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U}) {
    testing::Normal normal(seed);
    History history{.sample_rate = rate};
    constexpr double stop = 1.5;
    for (int i = 0; i < 800; ++i) {
      const double t = i / rate;
      history.x.push_back(std::exp(-zeta * natural * std::max(0.0, t - stop)) * std::sin(natural * t) +
                          2e-3 * normal());
    }
    const DerivedDecay decay = decay_of(history);
    CAPTURE(seed, decay.fault);
    REQUIRE(decay.fault.empty());
    const double half = M_PI / natural;
    CHECK(decay.record.times.front() > stop);
    CHECK(decay.record.times.front() < stop + 4.5 * half);
    const double first = std::abs(decay.record.extremes[1] - decay.record.extremes[0]);
    const double third = std::abs(decay.record.extremes[3] - decay.record.extremes[2]);
    CHECK(third / first == Approx(std::exp(-2.0 * M_PI * zeta)).epsilon(0.01));
  }
}

TEST_CASE("A long rest read by a coarse converter adds no extremes and does not outweigh the motion") {
  constexpr double X = 60e-3;
  const std::vector<double> exact = sim::analytic::free_decay_extremes(soft_zeta, soft_x_f, X, 20);
  for (const double step : {0.1e-3, 0.5e-3}) {
    Record record;
    record.histories = {released(X, 8.0, 1000.0)};
    History& history = record.histories[0];
    testing::Normal normal(13);
    for (double& x : history.x) x = step * std::round((x + 0.05 * step * normal()) / step);
    // At a place between two steps, the noise decides which is read.
    for (std::size_t i = 3000; i < history.x.size(); ++i)
      if (normal() > 2.0) history.x[i] += step;
    const std::vector<std::string> warnings = complete(record);
    CAPTURE(step);
    REQUIRE(record.decay.has_value());
    REQUIRE(record.decay->extremes.size() == exact.size());
    for (std::size_t i = 0; i < exact.size(); ++i)
      CHECK(record.decay->extremes[i] == Approx(exact[i]).margin(step));
    // Two half swings of the rest are left.
    CHECK(history.x.size() < 2500);
    CHECK(warnings.size() == 1);
  }
}

TEST_CASE("A motion that hardly turns is refused with its turning points, its time and its noise") {
  History history{.sample_rate = 100.0};
  for (int i = 0; i < 101; ++i) history.x.push_back(std::sin(0.012 * i));
  CHECK(decay_of(history).fault.starts_with("x does not turn back in 1 s, where swings count above "));
  for (int i = 0; i < 101; ++i) history.x[static_cast<std::size_t>(i)] = std::cos(0.05 * i);
  CHECK(decay_of(history).fault == "x has 2 extremes in 1 s");
  for (double& x : history.x) x = 1.0;
  CHECK(decay_of(history).fault == "x does not move in 1 s");
}
