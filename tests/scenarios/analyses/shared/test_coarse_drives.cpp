// Records whose drive has few samples in a period.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <cstdio>
#include <fstream>

#include "core/constants.hpp"
#include "core/random.hpp"
#include "tests/scenarios/answers.hpp"

using namespace dualdamp;
using scenarios::parse_scenario;

namespace {

/// 12 s of the linear rig (1 kg, 1000 N/m, 1.5 N.s/m) in its steady state under a base of 5 mm at 5.3 Hz, from the
/// closed form, with noise of x of 3 um.
void write_record(const std::string& file, double samples_in_period) {
  constexpr double stiffness = 1000.0;
  constexpr double damping = 1.5;
  constexpr double frequency = 5.3;
  const double omega = core::two_pi * frequency;
  const std::complex<double> gain = stiffness / std::complex<double>(stiffness - omega * omega, damping * omega);
  const core::RandomStream draws{3, 1};
  std::ofstream out(file);
  out.precision(12);
  out << "t [s],y [m],x [m]\n";
  for (std::uint64_t i = 0; static_cast<double>(i) < 12.0 * frequency * samples_in_period; ++i) {
    const double t = static_cast<double>(i) / (samples_in_period * frequency);
    const std::complex<double> drive = 0.005 * std::polar(1.0, omega * t);
    out << t << ',' << drive.real() << ',' << (gain * drive).real() + 3e-6 * draws.normal(i) << '\n';
  }
}

scenarios::RunResult run(const std::string& excitation, const std::string& analysis) {
  return scenarios::run(
      parse_scenario("schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, damping: 1 "
                     "N.s/m}\n" +
                         excitation + "analysis: {" + analysis + "}\n",
                     "test.yaml"));
}

bool tells_coarse_samples(const scenarios::RunResult& result) {
  return std::ranges::any_of(result.warnings, [](const std::string& warning) {
    return warning.find("samples of the drive") != std::string::npos ||
           warning.find("do not show the drive") != std::string::npos;
  });
}

}  // namespace

TEST_CASE("coarse drives: seven samples in a period drive a fit as the motion they were taken from",
          "[scenarios][fit]") {
  const std::string file = "coarse_drive.csv";
  write_record(file, 7.0);
  const std::string fit = "type: fit, data: " + file + ", free: damping, profile: false";
  const scenarios::RunResult own = run("", fit);
  REQUIRE(own.failure.empty());
  const auto damping_of = [](const scenarios::RunResult& result) {
    return testing::result_of(result).at("parameters").at(0);
  };
  CHECK(damping_of(own).at("value").get<double>() == Approx(1.5).margin(0.0006));
  CHECK(damping_of(own).at("std").get<double>() < 0.0003);
  CHECK(!tells_coarse_samples(own));
  // A spline that the scenario states is taken as it is. Its drive is (2 pi/7)^4/720 too small.
  const scenarios::RunResult stated =
      run("excitation: {type: measured_base, file: " + file + ", column: y, interpolation: cubic}\n", fit);
  REQUIRE(stated.failure.empty());
  CHECK(std::abs(damping_of(stated).at("value").get<double>() - 1.5) > 0.001);
  CHECK(tells_coarse_samples(stated));
  std::remove(file.c_str());
}

TEST_CASE("coarse drives: a warning is about a drive that drives a record", "[scenarios][predict]") {
  const std::string coarse = "coarse_drive_of_fit.csv";
  const std::string fine = "fine_drive.csv";
  write_record(coarse, 7.0);
  write_record(fine, 40.0);
  const scenarios::RunResult result =
      run("excitation: {type: measured_base, file: " + coarse + ", column: y, interpolation: cubic}\n",
          "type: predict, data: {file: " + fine + ", drive: y}, free: damping, covariance: [1e-4]");
  REQUIRE(result.failure.empty());
  CHECK(!tells_coarse_samples(result));
  std::remove(coarse.c_str());
  std::remove(fine.c_str());
}

TEST_CASE("coarse drives: samples that do not show the drive are told", "[scenarios][fit]") {
  const std::string file = "unresolved_drive.csv";
  write_record(file, 3.3);
  const scenarios::RunResult result = run("", "type: fit, data: " + file + ", free: damping, profile: false");
  REQUIRE(result.failure.empty());
  CHECK(tells_coarse_samples(result));
  std::remove(file.c_str());
}
