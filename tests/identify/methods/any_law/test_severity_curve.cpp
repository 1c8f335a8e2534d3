#include "identify/methods/any_law/severity_curve.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "identify/methods/any_law/any_law.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/methods/any_law/steady_readings.hpp"
#include "tests/identify/methods/any_law/law_laboratory.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr double usual_noise = 0.003;

struct Contact {
  LawRig rig;
  std::unique_ptr<const ReadingModel> model;
  PlainFit plain;
};

/// A record of the rig `seed` whose contact yields by `severity`.
Contact stiff_contact(LawRecord kind, std::uint64_t seed, double severity, double relative_noise = usual_noise) {
  Contact one;
  one.rig = law_rig(kind, seed);
  one.rig.noise = relative_noise;
  const Record record =
      law_record(kind, one.rig, identify::departures::find_departure("contact_compliance"), severity, seed);
  REQUIRE(record.pairs);
  auto readings = steady_readings(record, one.rig.constants, {});
  REQUIRE(std::holds_alternative<std::unique_ptr<const ReadingModel>>(readings));
  one.model = std::move(std::get<0>(readings));
  std::optional<PlainFit> plain = plain_fit(*one.model);
  if (plain) plain = with_law_error(*one.model, std::move(*plain), LawIntervalOptions{}.law_error);
  REQUIRE(plain);
  one.plain = std::move(*plain);
  return one;
}

const LawAnswer& answer_of(const LawIntervals& found, const std::string& name) {
  const auto law = std::ranges::find(found.laws, name, &LawAnswer::name);
  REQUIRE(law != found.laws.end());
  return *law;
}

}  // namespace

TEST_CASE("any_law: readings move in proportion to the coordinate of a mild severity, or slower") {
  const Contact one = stiff_contact(LawRecord::phases, 5, 0.002);
  const std::vector<double> fine(2, 0.0);
  const Eigen::VectorXd& unknowns = one.plain.fit.unknowns;
  const auto near = one.model->no_orbits(fine);
  int compared = 0;
  const std::optional<Eigen::VectorXd> plain = one.model->residuals({}, unknowns, *near);
  REQUIRE(plain);
  for (const LibraryLaw& law : law_library(*one.model, {})) {
    INFO(law.name());
    constexpr double mild = 0.001;
    const auto moved = [&](double severity) {
      const auto orbits = one.model->no_orbits(fine);
      auto apart = one.model->residuals({law.departure, severity}, unknowns, *orbits);
      REQUIRE(apart);
      *apart -= *plain;
      for (Eigen::Index i = 0; i < apart->size(); ++i)
        (*apart)[i] /= one.plain.noise.deviations.at(
            static_cast<std::size_t>(one.model->channels()[static_cast<std::size_t>(i)]));
      return apart->norm();
    };
    const double little = moved(mild);
    const double more = moved(4.0 * mild);
    constexpr double nothing = 1e-3;  // deviations
    if (more < nothing) continue;
    const SeverityScale scale(law.departure);
    const double ratio = scale.of(4.0 * mild) / scale.of(mild);
    CHECK(more / little > 0.75 * ratio);
    ++compared;
  }
  CHECK(compared >= 15);
}

TEST_CASE("any_law: between its fits the curve over the severity is that of direct fits, for every law") {
  for (const auto& [kind, severity, relative_noise] :
       {std::tuple{LawRecord::phases, 0.003, usual_noise}, {LawRecord::amplitudes, 0.1, usual_noise}}) {
    const Contact one = stiff_contact(kind, 5, severity, relative_noise);
    int compared = 0;
    for (const LawFits& law : fit_library(*one.model, {}, one.plain)) {
      if (law.fits.size() < 2) continue;
      const std::vector<SeverityPoint> points =
          severity_curve(*one.model, SeverityScale(law.law.departure), law.fits);
      constexpr double in_region = 6.0;
      std::vector<SeverityPoint> region;
      for (const SeverityPoint& point : points)
        if (point.severity != 0.0 && point.chi2 < best_of(points).chi2 + in_region) region.push_back(point);
      for (const std::size_t part : {1U, 2U}) {
        if (region.empty()) continue;
        const SeverityPoint& point = region[part * region.size() / 3];
        INFO(law.law.name() << " at severity " << point.severity << ", " << name_of(kind) << ", noise "
                            << relative_noise);
        const auto nearest = std::ranges::min_element(
            law.fits, {}, [&](const SeverityFit& fit) { return std::abs(fit.severity - point.severity); });
        const auto near = one.model->no_orbits(one.plain.noise.deviations);
        const std::optional<SeverityFit> direct = fit_law(*one.model, {law.law.departure, point.severity},
                                                          one.plain.noise, {.unknowns = nearest->unknowns}, *near);
        REQUIRE(direct);
        CHECK(point.chi2 == Approx(direct->chi2).margin(0.5).epsilon(0.02));
        CHECK(std::abs(point.F0 - direct->unknowns[0] * one.model->F0_unit()) < 0.3 * point.F0_deviation);
        CHECK(std::abs(point.c - direct->unknowns[1] * one.model->c_unit()) < 0.3 * point.c_deviation);
        ++compared;
      }
    }
    CHECK(compared >= 35);
  }
}

TEST_CASE("any_law: the region of a contact that yields little holds its force") {
  std::vector<std::string> others = library_names();
  std::erase(others, "contact_compliance");
  int held = 0;
  constexpr int rigs = 12;
  for (int i = 0; i < rigs; ++i) {
    const double severity = 0.0005 * std::pow(12.0, static_cast<double>(i) / (rigs - 1));
    const Contact one = stiff_contact(LawRecord::phases, 501000U + static_cast<unsigned>(i), severity);
    auto study = study_laws(*one.model, one.rig.constants, {.without = others});
    REQUIRE(std::holds_alternative<LawStudy>(study));
    const LawAnswer& law = answer_of(std::get<LawStudy>(study).intervals, "contact_compliance");
    UNSCOPED_INFO("severity " << severity << ", found " << law.severity << ", F0 over the truth "
                              << law.F0_interval95[0] / one.rig.truth.F0 << " to "
                              << law.F0_interval95[1] / one.rig.truth.F0);
    held += holds(law.F0_interval95, one.rig.truth.F0) ? 1 : 0;
    CHECK(law.severity < 3.0 * severity);
  }
  CHECK(held >= 11);
}

TEST_CASE("any_law: a law of two signs is fitted no further than it has a meaning, on either side") {
  int limits = 0;
  const Contact one = stiff_contact(LawRecord::phases, 5, 0.002);
  for (const LibraryLaw& law : law_library(*one.model, {.largest_severity = 1.0})) {
    INFO(law.name());
    for (const double severity : {law.largest, law.largest_below}) {
      if (severity == 0.0) continue;
      const auto near = one.model->no_orbits(one.plain.noise.deviations);
      const auto residuals = one.model->residuals({law.departure, severity}, one.plain.fit.unknowns, *near);
      REQUIRE(residuals);
      CHECK(residuals->allFinite());
      ++limits;
    }
  }
  CHECK(limits >= 20);
}
