#include "identify/outliers/readings.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

#include "identify/ledger/amplitude_model.hpp"
#include "identify/ledger/decay_model.hpp"

namespace dualdamp::identify {

namespace {

Pair& pair_of(Record& record, int number) { return *std::ranges::find(record.pairs->pairs, number, &Pair::number); }

}  // namespace

std::optional<JointModel> model_of_readings(const Record& record, const KnownConstants& constants) {
  auto found = record.pairs ? amplitude_model(record, constants) : decay_model(record, constants);
  if (std::holds_alternative<std::string>(found)) return std::nullopt;
  return std::get<JointModel>(std::move(found));
}

double& value_of(Record& record, const Reading& reading) {
  switch (reading.kind) {
    case ReadingKind::amplitude:
      return pair_of(record, reading.number).x;
    case ReadingKind::phase:
      return pair_of(record, reading.number).phase;
    case ReadingKind::extreme:
      return record.decay->extremes[static_cast<std::size_t>(reading.number - 1)];
    case ReadingKind::time:
      break;
  }
  return record.decay->times[static_cast<std::size_t>(reading.number - 1)];
}

std::string name_of(const Reading& reading) {
  const std::string number = std::to_string(reading.number);
  switch (reading.kind) {
    case ReadingKind::amplitude:
      return "x of pair " + number;
    case ReadingKind::phase:
      return "the phase of pair " + number;
    case ReadingKind::extreme:
      return "extreme " + number;
    case ReadingKind::time:
      break;
  }
  return "the time of extreme " + number;
}

}  // namespace dualdamp::identify
