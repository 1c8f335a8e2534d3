#include "identify/models/conversions.hpp"

#include <catch2/catch.hpp>
#include <vector>

using namespace dualdamp::identify;

namespace {

/// Table 3 of the paper: zeta and x_f in mm from the first and from the last four extremes of 17 free decays.
constexpr double table_3[17][4] = {
    {0.0990, 0.566, 0.0634, 0.965}, {0.0962, 0.581, 0.0607, 1.010}, {0.0911, 0.683, 0.0712, 0.887},
    {0.0884, 0.719, 0.0678, 0.949}, {0.0944, 0.639, 0.0666, 0.948}, {0.0793, 0.863, 0.0828, 0.828},
    {0.0804, 0.839, 0.0739, 0.906}, {0.0849, 0.791, 0.0741, 0.898}, {0.0850, 0.789, 0.0788, 0.847},
    {0.0813, 0.851, 0.0842, 0.825}, {0.1045, 0.532, 0.0639, 0.992}, {0.0841, 0.808, 0.0753, 0.899},
    {0.0836, 0.832, 0.0854, 0.817}, {0.0969, 0.649, 0.0713, 0.909}, {0.1078, 0.513, 0.0674, 0.951},
    {0.0924, 0.707, 0.0729, 0.904}, {0.0963, 0.703, 0.0802, 0.850}};

}  // namespace

TEST_CASE("The means of Table 3 and what they say about the soft spring") {
  std::vector<Friction> all;
  for (const auto& row : table_3) {
    all.push_back({row[0], 1e-3 * row[1]});
    all.push_back({row[2], 1e-3 * row[3]});
  }
  REQUIRE(all.size() == 34);
  const Friction average = mean(all);
  // Printed: 0.0819, 0.807 mm, 3.52 N; one digit more from the table itself.
  CHECK(average.zeta == Approx(0.08193).margin(5e-6));
  CHECK(average.x_f == Approx(0.8074e-3).margin(5e-8));
  CHECK(4365.0 * average.x_f == Approx(3.524).margin(5e-4));
  // Printed: 0.137, 2.25 mm, 3.52 N, from the means rounded as printed.
  const Friction soft = transfer_stiffness({0.0819, 0.807e-3}, 4365.0, 1568.0);
  CHECK(soft.zeta == Approx(0.1366).margin(5e-5));
  CHECK(soft.x_f == Approx(2.247e-3).margin(5e-7));
  CHECK(1568.0 * soft.x_f == Approx(3.523).margin(5e-4));
  // The force and the damping coefficient are what stays.
  CHECK(1568.0 * soft.x_f == Approx(4365.0 * 0.807e-3).epsilon(1e-15));
  CHECK(soft.zeta * soft.zeta * 1568.0 == Approx(0.0819 * 0.0819 * 4365.0).epsilon(1e-14));
}
