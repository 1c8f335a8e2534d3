// Laws compared by AICc: what their weights rest on.

#include <catch2/catch.hpp>
#include <vector>

#include "identify/fit/comparison.hpp"

using namespace dualdamp;

TEST_CASE("comparison: weights that rest on few degrees of freedom and no stated noise are told",
          "[identify][fit]") {
  const auto fits = [](double freedom, double chi2_per_freedom) {
    identify::Fit fit;
    fit.AICc = 1.0;
    fit.signals.resize(1);
    fit.signals[0].freedom = freedom;
    fit.signals[0].chi2_per_freedom = chi2_per_freedom;
    return std::vector<identify::Fit>{fit, fit};
  };
  CHECK_THAT(identify::warning_of_weights(fits(5.0, identify::unknown)),
             Catch::StartsWith("the weights of the laws rest on 5 degrees of freedom and on no stated noise"));
  CHECK(identify::warning_of_weights(fits(50.0, identify::unknown)).empty());
  CHECK(identify::warning_of_weights(fits(5.0, 1.0)).empty());
  CHECK(identify::warning_of_weights({fits(5.0, identify::unknown).front()}).empty());
}
