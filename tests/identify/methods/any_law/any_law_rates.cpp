/// How often the ranges over laws hold the truth if the law that made the record is left out of the library, by
/// random rigs. usage: any_law_rates RECORDS FIRST_SEED [KIND[/DEPARTURE]]...   e.g. phases/lugre. One line a row.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "identify/methods.hpp"
#include "identify/methods/any_law/decay_readings.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/methods/any_law/steady_readings.hpp"
#include "tests/identify/methods/any_law/advice_rates.hpp"
#include "tests/identify/methods/any_law/alias_bound.hpp"
#include "tests/identify/methods/any_law/answer_rates.hpp"
#include "tests/identify/methods/any_law/law_laboratory.hpp"

namespace {

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

constexpr double least_bias = 0.02;
constexpr double largest_bias = 0.2;
constexpr double largest_severity = 0.3;

std::unique_ptr<const ReadingModel> readings_of(const Record& record, const KnownConstants& constants) {
  auto readings = record.pairs ? steady_readings(record, constants, {}) : decay_readings(record, constants, 0.0);
  if (auto* model = std::get_if<0>(&readings)) return std::move(*model);
  return nullptr;
}

/// Relative error of plain friction in zeta or F0, the larger of both; nothing if it has no answer.
std::optional<double> bias_of(const LawRig& rig, const Record& record) {
  const auto model = readings_of(record, rig.constants);
  if (!model) return std::nullopt;
  const std::optional<PlainFit> plain = plain_fit(*model);
  if (!plain) return std::nullopt;
  const double F0 = plain->fit.unknowns[0] * model->F0_unit() / rig.truth.F0;
  const double c = plain->fit.unknowns[1] * model->c_unit() / rig.truth.model.oscillator.damping;
  return std::max(std::abs(F0 - 1.0), std::abs(c - 1.0));
}

/// A record whose plain fit errs by about `wanted`, or by what the largest severity gives. Nothing if that is too
/// little, or if plain friction has no answer.
struct Departed {
  Record record;
  double severity = 0.0;
  double bias = 0.0;
};
std::optional<Departed> departed_by(double wanted, LawRecord kind, const LawRig& rig,
                                    const identify::departures::Departure& departure, std::uint64_t seed) {
  double severity = std::min(largest_severity, departure.largest);
  std::optional<Departed> best;
  constexpr int rounds = 6;
  for (int i = 0; i < rounds; ++i) {
    const Record record = law_record(kind, rig, &departure, severity, seed);
    const std::optional<double> bias = bias_of(rig, record);
    if (bias && *bias >= least_bias && *bias <= largest_bias) best = Departed{record, severity, *bias};
    constexpr double near = 1.2;
    if (bias && (*bias < wanted * near) && (i == 0 || *bias > wanted / near)) break;
    severity *= bias ? std::clamp(wanted / *bias, 0.1, 3.0) : 0.3;
    severity = std::min(severity, std::min(largest_severity, departure.largest));
  }
  return best;
}

/// Names to leave out: the departure, and the law of the library of which it is one side.
std::vector<std::string> without(const identify::departures::Departure& departure) {
  std::vector<std::string> names = {std::string(departure.name)};
  if (!departure.twin_of.empty()) names.emplace_back(departure.twin_of);
  return names;
}

/// Means over records: coverage, interval score at 95 % (Gneiting and Raftery) and half width, over the truth.
struct Tally {
  int held = 0;
  double score = 0.0;
  double half = 0.0;

  void add(const Interval& interval, double truth) {
    const double miss = std::max({interval[0] - truth, truth - interval[1], 0.0});
    held += miss == 0.0 ? 1 : 0;
    constexpr double penalty = 2.0 / 0.05;
    const double width = interval[1] - interval[0];
    score += (width + penalty * miss) / truth;
    half += 0.5 * width / truth;
  }
};

/// For zeta and for F0.
using Two = std::array<Tally, 2>;

struct Row {
  int records = 0, harmless = 0, failed = 0, inflated = 0, plain_allowed = 0;
  double bias = 0.0, seconds = 0.0;
  Two hull, average, plain, single;
  std::vector<std::string> misses;
};

void add(Two& two, const Interval& zeta, const Interval& F0, const LawRig& rig) {
  two[0].add(zeta, rig.zeta);
  two[1].add(F0, rig.truth.F0);
}

const char* single_method(LawRecord kind) {
  if (kind == LawRecord::extremes || kind == LawRecord::history) return "free_decay";
  return kind == LawRecord::response || kind == LawRecord::phases ? "energy_balance" : "den_hartog_fit";
}

void tell_miss(const LawIntervals& found, const LawRig& rig, const Departed& departed, std::uint64_t seed,
               Row& row) {
  const auto share = [](double value, double truth) { return 100.0 * (value / truth - 1.0); };
  std::array<char, 240> text{};
  std::snprintf(
      text.data(), text.size(),
      "  seed %llu s %.3f bias %.1f %% hull zeta %+.1f %+.1f F0 %+.1f %+.1f %% inflation %.2f best %s (p %.3f)",
      static_cast<unsigned long long>(seed), departed.severity, 100.0 * departed.bias,
      share(found.zeta_hull[0], rig.zeta), share(found.zeta_hull[1], rig.zeta),
      share(found.F0_hull[0], rig.truth.F0), share(found.F0_hull[1], rig.truth.F0), found.inflation,
      found.laws.front().name.c_str(), found.laws.front().p_value);
  row.misses.emplace_back(text.data());
}

void count(LawRecord kind, const identify::departures::Departure* departure, std::uint64_t seed, Row& row) {
  const LawRig rig = law_rig(kind, seed);
  // Biases evenly spread over their logarithm.
  const double wanted = least_bias * std::pow(largest_bias / least_bias, static_cast<double>(seed % 7) / 6.0);
  std::optional<Departed> departed;
  if (departure == nullptr)
    departed = Departed{law_record(kind, rig, nullptr, 0.0, seed), 0.0, 0.0};
  else
    departed = departed_by(wanted, kind, rig, *departure, seed);
  if (!departed) {
    ++row.harmless;
    return;
  }
  const auto model = readings_of(departed->record, rig.constants);
  LawIntervalOptions options;
  if (departure != nullptr) options.without = without(*departure);
  const std::clock_t start = std::clock();
  std::optional<LawIntervals> found;
  if (model) {
    auto study = study_laws(*model, rig.constants, options);
    if (auto* law = std::get_if<LawStudy>(&study)) found = std::move(law->intervals);
  }
  if (!found) {
    ++row.failed;
    return;
  }
  row.seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  ++row.records;
  row.bias += departed->bias;
  row.inflated += found->inflation > 1.0 ? 1 : 0;
  const int held = row.hull[0].held + row.hull[1].held;
  add(row.hull, found->zeta_hull, found->F0_hull, rig);
  if (row.hull[0].held + row.hull[1].held < held + 2) tell_miss(*found, rig, *departed, seed, row);
  add(row.average, found->zeta_average, found->F0_average, rig);
  const auto plain = std::ranges::find(found->laws, "coulomb_viscous", &LawAnswer::name);
  add(row.plain, plain->zeta_interval95, plain->F0_interval95, rig);
  row.plain_allowed += plain->rejected ? 0 : 1;
  const Estimate single = find_method(single_method(kind))->run(departed->record, rig.constants);
  if (single.outcome.ok() && single.interval95)
    add(row.single, single.interval95->zeta, single.interval95->F0, rig);
}

void print(const std::string& name, const identify::departures::Departure* departure, const Row& row) {
  const double n = std::max(row.records, 1);
  std::printf("%-36s n %3d harmless %3d failed %2d bias %4.1f %% |", name.c_str(), row.records, row.harmless,
              row.failed, 100.0 * row.bias / n);
  // A value that the departure does not have cannot be held.
  if (departure != nullptr && !(departure->has_zeta && departure->has_F0))
    std::printf(" (no %s of its own)", departure->has_zeta ? "F0" : "zeta and no F0");
  for (const auto& [what, two] :
       {std::pair{"hull", &row.hull}, {"average", &row.average}, {"plain", &row.plain}, {"single", &row.single}})
    std::printf(" %s %3.0f/%3.0f half %.1f/%.1f score %.2f/%.2f |", what, 100.0 * (*two)[0].held / n,
                100.0 * (*two)[1].held / n, 100.0 * (*two)[0].half / n, 100.0 * (*two)[1].half / n,
                (*two)[0].score / n, (*two)[1].score / n);
  std::printf(" plain allowed %3.0f inflated %3.0f | %.1f s\n", 100.0 * row.plain_allowed / n,
              100.0 * row.inflated / n, row.seconds / n);
  for (const std::string& miss : row.misses) std::printf("%s\n", miss.c_str());
  std::fflush(stdout);
}

/// Means over departures with equal weights, for those that have records and a value of their own.
class Means {
 public:
  void add(const identify::departures::Departure& departure, const Row& row) {
    if (row.records == 0) return;
    records_ += row.records;
    const std::array own = {departure.has_zeta, departure.has_F0};
    const std::array rows = {&row.hull, &row.average, &row.plain, &row.single};
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        if (!own[j]) continue;
        const Tally& tally = (*rows[i])[j];
        held_[i][j].push_back(100.0 * tally.held / row.records);
        half_[i][j].push_back(100.0 * tally.half / row.records);
        score_[i][j].push_back(tally.score / row.records);
      }
    }
  }

  void print(const char* kind) const {
    constexpr std::array names = {"hull", "average", "plain", "single"};
    if (records_ == 0) return;
    std::printf("%s: means over %zu departures, n %d |", kind, held_[0][0].size(), records_);
    for (std::size_t i = 0; i < names.size(); ++i)
      std::printf(" %s %.0f/%.0f half %.1f/%.1f score %.2f/%.2f |", names[i], mean(held_[i][0]), mean(held_[i][1]),
                  mean(half_[i][0]), mean(half_[i][1]), mean(score_[i][0]), mean(score_[i][1]));
    std::printf("\n");
    std::fflush(stdout);
  }

 private:
  using Columns = std::array<std::array<std::vector<double>, 2>, 4>;

  static double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / std::max<double>(static_cast<double>(values.size()), 1.0);
  }

  Columns held_, half_, score_;
  int records_ = 0;
};

/// The departures to play; plain friction first.
std::vector<const identify::departures::Departure*> played(LawRecord kind) {
  std::vector<const identify::departures::Departure*> list = {nullptr};
  const bool free = kind == LawRecord::extremes || kind == LawRecord::history;
  for (const identify::departures::Departure& departure : identify::departures::departures()) {
    const bool of_friction = departure.mislead == nullptr &&
                             departure.family != identify::departures::Family::spring &&
                             departure.family != identify::departures::Family::drive;
    const bool of_drive = departure.name == "base_distortion" && !free;
    if ((of_friction && departure.name != "warming") || of_drive) list.push_back(&departure);
  }
  return list;
}

double median(std::vector<double> values) {
  if (values.empty()) return unknown;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Half width of the hull over the bound, under plain friction.
void print_bound(LawRecord kind, int records, std::uint64_t first) {
  std::array<std::vector<double>, 2> ratios;
  std::array<std::vector<double>, 2> bounds;
  for (int i = 0; i < records; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    const LawRig rig = law_rig(kind, seed);
    const auto bound = alias_bound(kind, rig);
    const auto model = readings_of(law_record(kind, rig, nullptr, 0.0, seed), rig.constants);
    if (!bound || !model) continue;
    const auto study = study_laws(*model, rig.constants, {});
    const auto* found = std::get_if<LawStudy>(&study);
    if (found == nullptr) continue;
    const LawIntervals& laws = found->intervals;
    const std::array half = {0.5 * (laws.zeta_hull[1] - laws.zeta_hull[0]),
                             0.5 * (laws.F0_hull[1] - laws.F0_hull[0])};
    const std::array truth = {rig.zeta, rig.truth.F0};
    for (std::size_t j = 0; j < 2; ++j) {
      ratios[j].push_back(half[j] / (*bound)[j]);
      bounds[j].push_back((*bound)[j] / truth[j]);
    }
  }
  std::printf(
      "bound/%s n %zu: half width of the hull over the bound %.2f / %.2f, the bound %.1f / %.1f %% (medians)\n",
      std::string(name_of(kind)).c_str(), ratios[0].size(), median(ratios[0]), median(ratios[1]),
      100.0 * median(bounds[0]), 100.0 * median(bounds[1]));
  std::fflush(stdout);
}

void print_advice(const identify::departures::Departure& departure, int records, std::uint64_t first) {
  std::array<std::vector<double>, 2> narrower;
  std::array<std::vector<double>, 2> over_promised;
  std::array<std::vector<double>, 2> over_expected;
  std::array<int, 2> rejected{};
  std::array<int, 2> held{};
  std::map<std::string, int> advice;
  constexpr std::array severities = {0.05, 0.1, 0.2};
  for (int i = 0; i < records; ++i) {
    const std::uint64_t seed = first + 2 * static_cast<std::uint64_t>(i);
    const LawRig rig = law_rig(LawRecord::amplitudes, seed);
    const auto followed =
        followed_advice(rig, departure, severities.at(static_cast<std::size_t>(i) % severities.size()), seed);
    if (!followed) continue;
    ++advice[followed->advice];
    std::printf(
        "advice/%s seed %llu: expected %.3f / %.3f, promised %.3f / %.3f, found %.3f / %.3f, narrower %.2f / %.2f, plain friction rejected %d "
        "-> %d, held %d / %d: %s\n",
        std::string(departure.name).c_str(), static_cast<unsigned long long>(seed), followed->expected[0],
        followed->expected[1], followed->promised[0], followed->promised[1], followed->found[0], followed->found[1],
        followed->narrower[0], followed->narrower[1], followed->rejected[0], followed->rejected[1],
        followed->held[0], followed->held[1], followed->advice.c_str());
    std::fflush(stdout);
    for (std::size_t j = 0; j < 2; ++j) {
      narrower[j].push_back(followed->narrower[j]);
      over_expected[j].push_back(followed->found[j] / followed->expected[j]);
      over_promised[j].push_back(followed->found[j] / followed->promised[j]);
      rejected[j] += followed->rejected[j] ? 1 : 0;
      held[j] += followed->held[j] ? 1 : 0;
    }
  }
  const double n = std::max<double>(static_cast<double>(narrower[0].size()), 1.0);
  std::printf(
      "advice/%s n %.0f: found over promised %.2f / %.2f, over the mean of all laws %.2f / %.2f, narrower %.2f / %.2f (medians), plain friction rejected %.0f "
      "-> %.0f %%, held %.0f / %.0f %%\n",
      std::string(departure.name).c_str(), n, median(over_promised[0]), median(over_promised[1]),
      median(over_expected[0]), median(over_expected[1]), median(narrower[0]), median(narrower[1]),
      100.0 * rejected[0] / n, 100.0 * rejected[1] / n, 100.0 * held[0] / n, 100.0 * held[1] / n);
  for (const auto& [name, count] : advice) std::printf("  %d: %s\n", count, name.c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const int records = std::atoi(argv[1]);
  const std::uint64_t first = std::strtoull(argv[2], nullptr, 10);
  const auto wanted = [&](const std::string& name) {
    return argc == 3 || std::any_of(argv + 3, argv + argc, [&](const std::string& row) {
             return name == row || name.starts_with(row + "/");
           });
  };
  for (const LawRecord kind :
       {LawRecord::phases, LawRecord::amplitudes, LawRecord::response, LawRecord::extremes, LawRecord::history}) {
    Means means;
    for (const identify::departures::Departure* departure : played(kind)) {
      const std::string name =
          std::string(name_of(kind)) + "/" + (departure == nullptr ? "none" : std::string(departure->name));
      if (!wanted(name)) continue;
      Row row;
      for (int i = 0; i < records; ++i) count(kind, departure, first + static_cast<std::uint64_t>(i), row);
      print(name, departure, row);
      if (departure != nullptr) means.add(*departure, row);
    }
    means.print(std::string(name_of(kind)).c_str());
  }
  for (const LawRecord kind : {LawRecord::phases, LawRecord::amplitudes, LawRecord::response})
    if (wanted("bound/" + std::string(name_of(kind)))) print_bound(kind, records, first);
  for (const char* name : {"contact_compliance", "dahl", "quadratic_drag", "stribeck"})
    if (wanted("advice/" + std::string(name)))
      print_advice(*identify::departures::find_departure(name), records, first);
  for (const identify::departures::Departure& departure : identify::departures::departures())
    if (departure.mislead == nullptr && departure.name != "warming" &&
        wanted("answers/" + std::string(departure.name)))
      print_answers(departure, records, first);
  return 0;
}
