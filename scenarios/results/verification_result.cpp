#include "scenarios/results/verification_result.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "core/constants.hpp"

namespace dualdamp::scenarios {

namespace {

/// The numbers of what was not compared, which are written if they are not zero.
constexpr std::array<std::pair<std::string_view, long Verification::*>, 5> left_out = {{
    {"rows_left_out", &Verification::rows_left_out},
    {"rows_without_numbers", &Verification::rows_without_numbers},
    {"others_left_out", &Verification::others_left_out},
    {"times_left_out", &Verification::times_left_out},
    {"multipliers_left_out", &Verification::multipliers_left_out},
}};

}  // namespace

Json json_of(const Verification& verification) {
  Json json = {{"engine", verification.engine}};
  if (verification.quantity.empty()) {
    json["largest_difference"] = nullptr;
    json["quantity"] = nullptr;
  } else {
    json["largest_difference"] = verification.largest_difference;
    json["quantity"] = verification.quantity;
    json["tolerance"] = verification.tolerance;
  }
  json["quantities"] = verification.quantities;
  for (const auto& [key, count] : left_out)
    if (verification.*count > 0) json[std::string(key)] = verification.*count;
  if (verification.time_shift > 0.0) json["time_shift"] = verification.time_shift;
  json["agrees"] = verification.agrees;
  if (!verification.reason.empty()) json["reason"] = verification.reason;
  return json;
}

Verification verification_of(const Json& json) {
  Verification verification{.engine = json.at("engine").get<std::string>()};
  if (const Json& quantity = json.at("quantity"); quantity.is_string()) {
    verification.quantity = quantity.get<std::string>();
    const Json& difference = json.at("largest_difference");
    verification.largest_difference = difference.is_number() ? difference.get<double>() : core::infinity;
    verification.tolerance = json.at("tolerance").get<double>();
  }
  verification.quantities = json.at("quantities").get<long>();
  for (const auto& [key, count] : left_out) verification.*count = json.value(std::string(key), 0L);
  verification.time_shift = json.value("time_shift", 0.0);
  verification.agrees = json.at("agrees").get<bool>();
  verification.reason = json.value("reason", "");
  return verification;
}

bool is_worse(const Verification& than, const Verification& verification) {
  if (than.agrees != verification.agrees) return than.agrees;
  const auto share = [](const Verification& v) { return v.largest_difference / v.tolerance; };
  if (!than.agrees || verification.quantities == 0) return false;
  return than.quantities == 0 || share(verification) > share(than);
}

Verification merged(Verification a, Verification b) {
  const Verification sums[] = {a, b};
  Verification result = is_worse(a, b) ? std::move(b) : std::move(a);
  result.quantities = sums[0].quantities + sums[1].quantities;
  for (const auto& [key, count] : left_out) result.*count = sums[0].*count + sums[1].*count;
  result.time_shift = std::max(sums[0].time_shift, sums[1].time_shift);
  return result;
}

}  // namespace dualdamp::scenarios
