#include "scenarios/format/json_text.hpp"

namespace dualdamp::scenarios {

namespace {

constexpr int most_levels = 64;

struct TooDeep {};

}  // namespace

Json parse_json(std::string_view text) {
  const auto watch = [](int depth, Json::parse_event_t /*event*/, const Json& /*parsed*/) {
    if (depth > most_levels) throw TooDeep();
    return true;
  };
  try {
    return Json::parse(text, watch, false);
  } catch (const TooDeep&) {
    return Json::value_t::discarded;
  }
}

}  // namespace dualdamp::scenarios
