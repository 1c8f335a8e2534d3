/// How often the ledger of assumptions and the answer are right, by records of random rigs, identified as the
/// program does it. usage: verdict_rates RECORDS FIRST_SEED [--ranges] [ROW]...   ROW: a part of the name of a row.
/// Prints a line for each. --ranges: with ranges over laws, seconds for a record in which friction departs.

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "identify/answer/answer.hpp"
#include "identify/ledger/amplitude_model.hpp"
#include "identify/ledger/decay_model.hpp"
#include "identify/ledger/estimate/unstated_constants.hpp"
#include "identify/ledger/histories/history_model.hpp"
#include "identify/methods.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/statistics/distributions.hpp"
#include "tests/identify/ledger/laboratory.hpp"
#include "tests/identify/ledger/uncertain_rates.hpp"

namespace {

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

struct Row {
  std::string name;
  Kind kind;
  void (*alter)(Rig&) = nullptr;
  Off off = {};
  bool with_ranges = false;
};

const std::vector<Kind> all = {Kind::xy,     Kind::xy_phase, Kind::response, Kind::extremes, Kind::decay,
                               Kind::forced, Kind::beat,     Kind::ramp,     Kind::random};

std::vector<Row> rows() {
  std::vector<Row> list;
  const auto add = [&](const std::string& what, void (*alter)(Rig&), const Off& off,
                       const std::vector<Kind>& kinds) {
    for (const Kind kind : kinds) list.push_back({what + ", " + std::string(name_of(kind)), kind, alter, off});
  };
  const std::vector<Kind> pairs = {Kind::xy, Kind::xy_phase, Kind::response};
  const std::vector<Kind> driven = {Kind::forced, Kind::beat, Kind::ramp, Kind::random};
  add("exact", nullptr, {}, all);
  for (const int states : {7, 9, 12}) {
    const std::string what = "exact, " + std::to_string(states) + " states";
    add(what, nullptr, {.states = states}, {Kind::response});
    add(what + ", exact Y", nullptr, {.states = states, .drive_noise = 0.0}, {Kind::response});
    add(what + " above resonance", nullptr, {.states = states, .shift = 0.5, .drive_noise = 0.0}, {Kind::response});
  }
  add("7 states, stiffness 2 %", nullptr, {.stiffness = 0.02, .states = 7}, {Kind::response});
  add("9 states, stiffness 2 %", nullptr, {.stiffness = 0.02, .states = 9}, {Kind::response});
  add("stiffness 2 %", nullptr, {.stiffness = 0.02}, all);
  add("stiffness -2 %", nullptr, {.stiffness = -0.02}, pairs);
  add("cubic spring", [](Rig& rig) { rig.cubic = 0.03; }, {}, all);
  add("second mode", [](Rig& rig) { rig.second_mass = 0.05; }, {}, all);
  add("delay 1 %", nullptr, {.delay = 0.01},
      {Kind::xy_phase, Kind::response, Kind::forced, Kind::beat, Kind::ramp, Kind::random});
  add("gain 1 %", nullptr, {.gain = 0.01}, all);
  add("detuning 2 %", nullptr, {.frequency = 0.02}, pairs);
  add("drift", nullptr, {.sweep_drift = 0.2}, {Kind::xy, Kind::xy_phase});
  add("drift", [](Rig& rig) { rig.drift = 0.3; }, {}, driven);
  add("zero drifts", nullptr, {.zero_drift = 2.0},
      {Kind::extremes, Kind::decay, Kind::forced, Kind::beat, Kind::ramp, Kind::random});
  add("clock of 0.02 s", nullptr, {.noise = 0.1, .clock = 0.02}, {Kind::extremes});
  add("8 bits", nullptr, {.bits = 8}, {Kind::extremes, Kind::decay, Kind::forced, Kind::beat, Kind::random});
  add("12 samples", nullptr, {.samples = 12.0}, {Kind::decay, Kind::forced, Kind::beat, Kind::random});
  add("noise in v", nullptr, {.v_noise = 0.02}, {Kind::decay, Kind::forced, Kind::beat, Kind::ramp, Kind::random});
  add("zero of v", nullptr, {.v_noise = 0.002, .zero = 0.5}, {Kind::decay, Kind::forced, Kind::beat});
  for (const double samples : {25.0, 100.0}) {
    const std::string what = "a with " + std::to_string(std::lround(samples)) + " samples";
    const std::vector<Kind> kinds = {Kind::decay, Kind::forced, Kind::beat, Kind::ramp, Kind::random};
    add(what, nullptr, {.a_noise = 0.001, .samples = samples}, kinds);
    add("zero of " + what, nullptr, {.a_noise = 0.001, .zero = 0.5, .samples = samples}, kinds);
  }
  add("friction: quadratic", [](Rig& rig) { rig.drag = 0.5; }, {}, all);
  add("friction: saturating", [](Rig& rig) { rig.saturation = 0.5; }, {}, all);
  add("friction: Stribeck", [](Rig& rig) { rig.stribeck = 0.5; }, {}, all);
  add("friction: compliance", [](Rig& rig) { rig.compliance = 0.05; }, {}, all);
  add("friction: LuGre", [](Rig& rig) { rig.lugre = 0.03; }, {}, all);
  add("friction: asymmetric", [](Rig& rig) { rig.asymmetry = 0.3; }, {}, all);
  add("friction: free play", [](Rig& rig) { rig.play = 0.03; }, {}, all);
  for (const double stated : {0.0, 1.0}) {
    const std::string what = stated > 0.0 ? "stated noise" : "noise not stated";
    const std::vector<Kind> kinds = {Kind::decay, Kind::forced, Kind::beat};
    add(what + ", plain", nullptr, {.stated_noise = stated}, kinds);
    add(what + ", weak drag", [](Rig& rig) { rig.drag = 0.06; }, {.stated_noise = stated}, kinds);
  }
  return list;
}

/// `with_ranges`: methods that take seconds run as well, which answer where friction departs.
Identification identified(Measured& measured, bool with_ranges) {
  Record& record = measured.record;
  static_cast<void>(complete(record, measured.constants.frequency));
  const LedgerOptions options{.deviations = measured.deviations};
  Ledger ledger = ledger_of(record, measured.constants, options);
  reach_over_unstated(record, measured.constants, options, ledger);
  std::vector<Estimate> estimates;
  // If the estimate of the joint model is usable it answers, and the other methods need not run.
  if (ledger.joint && ledger.joint->usable && ledger.joint->interval95 && (!ledger.frees_law || !with_ranges)) {
    estimates.push_back(*ledger.joint);
    return concluded(std::move(estimates), std::move(ledger));
  }
  for (const MethodEntry& method : methods())
    if ((with_ranges || !method.takes_seconds) && method.lacks(record).empty())
      estimates.push_back(method.run(record, measured.constants));
  return concluded(std::move(estimates), std::move(ledger));
}

bool covers(const Interval& interval, double value) { return interval[0] <= value && value <= interval[1]; }

/// The joint model of a record; nothing where there is none.
std::optional<JointModel> model_of(const Measured& measured) {
  const Record& record = measured.record;
  auto model = !record.histories.empty() ? history_model(record, measured.constants)
               : record.pairs            ? amplitude_model(record, measured.constants)
                                         : decay_model(record, measured.constants);
  if (auto* found = std::get_if<JointModel>(&model)) return std::move(*found);
  return std::nullopt;
}

/// The relaxations of friction that a t test of 5 % rejects, each tested by itself.
std::vector<std::string> known_departures(const Measured& measured) {
  std::vector<std::string> rejected;
  const std::optional<JointModel> model = model_of(measured);
  if (!model) return rejected;
  const Eigen::Index base = model->base.cols();
  for (std::size_t j = 0; j < model->relaxations.size(); ++j) {
    if (!is_of_friction(model->relaxations[j].assumption)) continue;
    Eigen::MatrixXd columns(model->base.rows(), base + 1);
    columns << model->base, model->relaxed.col(static_cast<Eigen::Index>(j));
    const Eigen::VectorXd scale = columns.colwise().norm().cwiseMax(1e-300);
    columns *= scale.cwiseInverse().asDiagonal();
    const Eigen::MatrixXd inverse = (columns.transpose() * columns).inverse();
    const Eigen::VectorXd step = inverse * (columns.transpose() * model->residuals);
    const double freedom = static_cast<double>(columns.rows() - base - 1) - model->spent;
    const double variance = (model->residuals - columns * step).squaredNorm() / freedom;
    const double t = step[base] / std::sqrt(variance * inverse(base, base));
    const int sign = model->relaxations[j].sign;
    const double sides = sign == 0 ? 1.0 : 0.5;
    const bool possible = sign == 0 || sign * t > 0.0;
    constexpr double level = 0.05;
    if (possible && sides * f_test_p_value(t * t, 1.0, freedom) < level)
      rejected.push_back(model->relaxations[j].test);
  }
  return rejected;
}

struct Counts {
  int records = 0, rejected = 0, friction = 0, answers = 0, zeta = 0, F0 = 0, off = 0, off_rejected = 0, misled = 0;
  int tested = 0, seen = 0, blamed = 0, joint = 0, joint_zeta = 0, joint_F0 = 0;
  int ranges = 0, range_zeta = 0, range_F0 = 0, range_misled = 0;
  std::vector<double> widths, range_widths;  ///< half, of zeta or F0, relative, the larger
  std::map<std::string, int> named, named_off, tests, by, known;
  double seconds = 0.0;
};

/// Half of the wider one of zeta and F0, relative.
double width_of(const ParameterIntervals& at, const Rig& rig) {
  return 0.5 * std::max((at.zeta[1] - at.zeta[0]) / rig.zeta, (at.F0[1] - at.F0[0]) / rig.F0);
}

void count_range(const Identification& found, const Rig& rig, Counts& counts) {
  const Estimate& answer = found.estimates[*found.answer];
  const ParameterIntervals& range = found.range ? found.range->ends : *answer.interval95;
  counts.ranges += found.range ? 1 : 0;
  const bool in = covers(range.zeta, rig.zeta);
  counts.range_zeta += in ? 1 : 0;
  counts.range_F0 += covers(range.F0, rig.F0) ? 1 : 0;
  counts.range_misled += !in && std::abs(answer.value.zeta / rig.zeta - 1.0) > 0.05 ? 1 : 0;
  counts.widths.push_back(width_of(*answer.interval95, rig));
  counts.range_widths.push_back(width_of(range, rig));
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

void count_verdict(const Row& row, std::uint64_t seed, Counts& counts) {
  Measured record = measured(row.kind, seed, row.alter, row.off);
  const auto start = std::chrono::steady_clock::now();
  const Identification found = identified(record, row.with_ranges);
  counts.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Rig& rig = record.rig;
  ++counts.records;
  if (row.name.starts_with("friction"))
    for (const std::string& test : known_departures(record)) ++counts.known[test];
  counts.tested += found.ledger.data.empty() ? 0 : 1;
  const auto violated = [&](Assumption assumption) { return found.ledger.is_violated(assumption); };
  const bool any = std::ranges::any_of(assumptions(), violated);
  const auto error = [](double value, double truth) { return std::abs(value / truth - 1.0); };
  const double largest = 0.05;
  const bool is_off = found.ledger.data.empty() || error(found.ledger.plain.zeta, rig.zeta) > largest ||
                      error(found.ledger.plain.F0, rig.F0) > largest;
  counts.rejected += any ? 1 : 0;
  counts.seen += std::ranges::any_of(
      found.ledger.entries, [](const LedgerEntry& entry) { return entry.p_value.value_or(1.0) < family_level; });
  counts.friction +=
      std::ranges::any_of(assumptions(), [&](Assumption a) { return is_of_friction(a) && violated(a); });
  // What explains a departure has its p, whether it moves anything or not.
  const auto explains = [&](Assumption assumption, const std::vector<Assumption>& departure) {
    return found.ledger.entry(assumption).p_value == found.ledger.entry(departure.front()).p_value;
  };
  // Friction alone is charged if no other assumption is named with it.
  counts.blamed += std::ranges::any_of(found.ledger.departures, [&](const std::vector<Assumption>& departure) {
    return std::ranges::none_of(assumptions(),
                                [&](Assumption a) { return !is_of_friction(a) && explains(a, departure); });
  });
  if (found.ledger.joint && found.ledger.joint->interval95) {
    ++counts.joint;
    counts.joint_zeta += covers(found.ledger.joint->interval95->zeta, rig.zeta) ? 1 : 0;
    counts.joint_F0 += covers(found.ledger.joint->interval95->F0, rig.F0) ? 1 : 0;
  }
  counts.off += is_off ? 1 : 0;
  counts.off_rejected += is_off && any ? 1 : 0;
  for (const Assumption assumption : assumptions()) {
    const auto explained_so = [&](const auto& departure) { return explains(assumption, departure); };
    if (std::ranges::none_of(found.ledger.departures, explained_so)) continue;
    ++counts.named[std::string(name_of(assumption))];
    if (is_off) ++counts.named_off[std::string(name_of(assumption))];
  }
  for (const LedgerEntry& entry : found.ledger.entries)
    if (entry.standing == Standing::violated) ++counts.tests[entry.test];
  if (!found.answer) return;
  const Estimate& answer = found.estimates[*found.answer];
  ++counts.answers;
  ++counts.by[answer.method];
  const bool in = covers(answer.interval95->zeta, rig.zeta);
  counts.zeta += in ? 1 : 0;
  counts.F0 += covers(answer.interval95->F0, rig.F0) ? 1 : 0;
  counts.misled += !in && error(answer.value.zeta, rig.zeta) > largest ? 1 : 0;
  count_range(found, rig, counts);
}

std::string list_of(const std::map<std::string, int>& map, int total) {
  std::string text;
  for (const auto& [name, number] : map)
    text += (text.empty() ? "" : ", ") + name + " " + std::to_string(100 * number / std::max(1, total));
  return text;
}

void print(const Row& row, const Counts& c) {
  const auto share = [](int part, int whole) { return 100.0 * part / std::max(1, whole); };
  const auto best = std::ranges::max_element(c.known, {}, [](const auto& entry) { return entry.second; });
  if (best != c.known.end())
    std::printf("[known %.0f by %s] ", share(best->second, c.records), best->first.c_str());
  std::printf(
      "%-34s n %3d tested %3.0f seen %5.1f rejected %5.1f friction %5.1f alone %5.1f joint %5.1f %5.1f answer "
      "%5.1f zeta %5.1f F0 %5.1f misled %4.1f | ranges %3.0f zeta %5.1f F0 %5.1f misled %4.1f half width %.3f of %.3f | off %3.0f found %3.0f %4.2f s | named: %s | tests: %s | where off: %s | by: %s\n",
      row.name.c_str(), c.records, share(c.tested, c.records), share(c.seen, c.records),
      share(c.rejected, c.records), share(c.friction, c.records), share(c.blamed, c.records),
      share(c.joint_zeta, c.joint), share(c.joint_F0, c.joint), share(c.answers, c.records),
      share(c.zeta, c.answers), share(c.F0, c.answers), share(c.misled, c.records), share(c.ranges, c.answers),
      share(c.range_zeta, c.answers), share(c.range_F0, c.answers), share(c.range_misled, c.records),
      median(c.widths), median(c.range_widths), share(c.off, c.records), share(c.off_rejected, c.off),
      c.seconds / std::max(1, c.records), list_of(c.named, c.records).c_str(), list_of(c.tests, c.records).c_str(),
      list_of(c.named_off, c.off).c_str(), list_of(c.by, c.answers).c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const int records = std::atoi(argv[1]);
  const std::uint64_t first = std::strtoull(argv[2], nullptr, 10);
  const bool with_ranges = argc > 3 && std::string(argv[3]) == "--ranges";
  const std::vector<std::string> parts(argv + (with_ranges ? 4 : 3), argv + argc);
  const auto wanted = [&](const std::string& name) {
    return parts.empty() || std::ranges::any_of(parts, [&](const std::string& part) {
             return name.find(part) != std::string::npos;
           });
  };
  std::vector<Row> list = rows();
  for (Row& row : list) {
    if (!wanted(row.name)) continue;
    row.with_ranges = with_ranges;
    Counts counts;
    for (int i = 0; i < records; ++i) count_verdict(row, first + static_cast<std::uint64_t>(i), counts);
    print(row, counts);
  }
  for (const Kind kind : all)
    for (const auto& [what, deviation] : {std::pair{"exact, every method, ", 0.0}, {"uncertain, ", 0.01}})
      if (wanted(what + std::string(name_of(kind)))) print_uncertain_rates(kind, deviation, records, first);
  return 0;
}
