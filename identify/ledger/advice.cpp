#include "identify/ledger/advice.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostics.hpp"

namespace dualdamp::identify {

namespace {

bool has_phases_over_frequency(const Recorded& recorded) { return recorded.phases && recorded.frequencies; }

std::string of_sensors(const Recorded& recorded) {
  if (recorded.one_sensor)
    return "check the zero and the range of x, or record a second sensor on the mass, which x can be compared with";
  std::string calibrate = "calibrate the sensors against each other";
  if (recorded.histories || has_phases_over_frequency(recorded)) return calibrate;
  return calibrate + (recorded.phases ? ", or record the phase at several frequencies" : ", or record the phase");
}

std::string of_stationarity(const Recorded& recorded) {
  if (recorded.histories)
    return "analyse the parts of the record one by one, or measure again when the rig is steady";
  if (recorded.free) return "measure several decays, and check the zero of x after each";
  if (recorded.sweeps) return "analyse the sweeps one by one, or measure again when the rig is steady";
  return "give the sweeps their labels, or measure them one by one";
}

std::string of_spring(const Recorded& recorded) {
  std::string smaller = "measure at smaller amplitudes";
  if (recorded.free || recorded.histories || recorded.phases) return smaller;
  return smaller + ", or record the phase: the work of a forcing period does not depend on the spring";
}

/// Smaller amplitudes do not part the modes.
std::string of_one_mode(const Recorded& recorded) {
  std::string hold = "hold the part of the structure that moves by itself";
  if (recorded.free) return hold;
  hold += ", or measure further below its resonance";
  if (recorded.histories || recorded.phases) return hold;
  return hold + ", or record the phase: the work of a forcing period does not depend on the mass";
}

std::string of_friction(const Recorded& recorded) {
  std::string law = "fit a law that has such a term";
  if (recorded.histories) return law;
  if (recorded.free) return "record the whole history, and " + law;
  if (has_phases_over_frequency(recorded)) return law + ", or record a history";
  const std::string phase = recorded.frequencies ? "record the phase" : "record the phase at several frequencies";
  return phase + ", or a history, and " + law;
}

std::string what_would_help(Assumption assumption, const Recorded& recorded) {
  using enum Assumption;
  switch (assumption) {
    case constants:
      return "leave out the stated stiffness or mass where the record determines it, or measure them anew";
    case sensors:
      return of_sensors(recorded);
    case stationarity:
      return of_stationarity(recorded);
    case drive:
      return recorded.drive ? "leave out where the drive is not steady"
                            : "record the drive, or leave out where it is not steady";
    case spring:
      return of_spring(recorded);
    case one_mode:
      return of_one_mode(recorded);
    case friction_velocity:
    case friction_displacement:
      return of_friction(recorded);
    case symmetry:
      return "measure each direction of motion separately";
  }
  return "more data, or less noise";
}

/// One thing that would test an assumption.
struct Means {
  Assumption assumption;
  std::string_view name;
  bool (*is_there)(const Recorded& recorded);
};

bool has_history(const Recorded& recorded) { return recorded.histories; }
bool has_phases(const Recorded& recorded) { return recorded.phases; }
bool has_frequencies(const Recorded& recorded) { return recorded.frequencies; }
bool has_times(const Recorded& recorded) { return recorded.times; }
bool has_sweeps(const Recorded& recorded) { return recorded.sweeps; }
bool has_drive(const Recorded& recorded) { return recorded.drive; }
bool has_directions(const Recorded& recorded) { return recorded.histories || recorded.free; }
bool is_not_free(const Recorded& recorded) { return !recorded.free; }
bool is_not_driven(const Recorded& recorded) { return !recorded.histories || recorded.free; }
bool has_second_sensor(const Recorded& recorded) { return recorded.second_sensor; }

using enum Assumption;
constexpr std::array all_means = {
    Means{constants, "phases", has_phases},
    Means{constants, "several frequencies", has_frequencies},
    Means{constants, "times of the extremes", has_times},
    Means{constants, "a history", has_history},
    Means{sensors, "a second sensor on the mass", has_second_sensor},
    Means{sensors, "phases at several frequencies", has_phases_over_frequency},
    Means{spring, "phases at several amplitudes", has_phases},
    Means{spring, "times of the extremes", has_times},
    Means{spring, "a history", has_history},
    Means{one_mode, "phases at several frequencies", has_phases_over_frequency},
    Means{one_mode, "a history", has_history},
    Means{drive, "the history of the drive", has_drive},
    Means{stationarity, "repeated sweeps with their labels", has_sweeps},
    Means{stationarity, "a history", has_history},
    Means{friction_velocity, "more levels, further apart", [](const Recorded& r) { return r.histories || r.free; }},
    Means{friction_velocity,
          "free vibrations of several sizes, after blows or releases, the largest twice the smallest or more",
          is_not_free},
    Means{friction_velocity, "records under drives of several sizes", is_not_driven},
    Means{friction_velocity, "a history", has_history},
    Means{friction_displacement, "phases", has_phases},
    Means{friction_displacement, "a second frequency", has_frequencies},
    Means{friction_displacement, "a history", has_history},
    Means{symmetry, "a history", has_directions},
    Means{symmetry, "signed extremes", has_directions},
};

/// Departures that decays from several amplitudes would distinguish.
bool drifts_or_has_speed(const std::vector<Assumption>& departure) {
  return std::ranges::any_of(departure, [](Assumption assumption) {
    return assumption == stationarity || assumption == friction_velocity;
  });
}

/// "fit a law that has such a term; or, for constants: measure them anew": for every assumption whose failure may
/// be the departure, best explanation first.
std::string what_would_help(const std::vector<Assumption>& departure, const Ledger& ledger) {
  const bool is_like_speed = ledger.entry(stationarity).is_like_speed && drifts_or_has_speed(departure);
  std::vector<std::string> helps = {
      is_like_speed ? "measure a decay from another amplitude as well: a drift goes with time, friction over "
                      "speed with the amplitude"
                    : what_would_help(departure.front(), ledger.recorded)};
  std::string text = helps.front();
  const auto add = [&](Assumption assumption) {
    if (is_like_speed && drifts_or_has_speed({assumption})) return;
    std::string help = what_would_help(assumption, ledger.recorded);
    if (std::ranges::find(helps, help) != helps.end()) return;
    text += "; or, for " + std::string(name_of(assumption)) + ": " + help;
    helps.push_back(std::move(help));
  };
  std::ranges::for_each(departure, add);
  const LedgerEntry& first = ledger.entry(departure.front());
  if (first.p_value)
    for (const LedgerEntry* entry : harmless_beside(first, ledger)) add(entry->assumption);
  return text;
}

/// Departures that a swing that is cut off can pretend.
bool looks_clipped(const std::vector<Assumption>& departure) {
  return std::ranges::any_of(departure, [](Assumption assumption) {
    return assumption == friction_velocity || assumption == friction_displacement || assumption == stationarity ||
           assumption == symmetry || assumption == spring;
  });
}

}  // namespace

Recorded recorded_in(const Record& record) {
  const auto any_has = [&](const std::vector<std::vector<double> History::*>& signals) {
    return std::ranges::any_of(record.histories, [&](const History& history) {
      return std::ranges::any_of(signals, [&](auto signal) { return !(history.*signal).empty(); });
    });
  };
  Recorded recorded{.histories = !record.histories.empty()};
  recorded.drive = any_has({&History::y, &History::force});
  recorded.states = record.pairs.has_value();
  recorded.clipped = std::ranges::any_of(record.histories, &History::is_clipped);
  recorded.free = recorded.histories ? !recorded.drive : !record.pairs && record.decay;
  recorded.second_sensor = any_has({&History::v, &History::a});
  recorded.one_sensor = recorded.free && !recorded.second_sensor;
  recorded.times = recorded.free && (recorded.histories || !record.decay->times.empty());
  if (!record.pairs) return recorded;
  const std::vector<Pair>& pairs = record.pairs->pairs;
  const auto differ = [&](auto of) {
    return std::ranges::any_of(pairs, [&](const Pair& pair) { return of(pair) != of(pairs.front()); });
  };
  recorded.phases = std::ranges::any_of(pairs, [](const Pair& pair) { return !std::isnan(pair.phase); });
  recorded.frequencies = differ([](const Pair& pair) { return std::isnan(pair.omega) ? 0.0 : pair.omega; });
  recorded.sweeps = differ([](const Pair& pair) { return pair.sweep; });
  return recorded;
}

std::string means_to_show(Assumption assumption, const Recorded& recorded) {
  std::vector<std::string> lacking;
  for (const Means& means : all_means)
    if (means.assumption == assumption && !means.is_there(recorded)) lacking.emplace_back(means.name);
  return core::joined(lacking, " or ");
}

std::string would_show(Assumption assumption, const Recorded& recorded) {
  const std::string means = means_to_show(assumption, recorded);
  return means.empty() ? "" : "; " + means + " would show it";
}

std::vector<const LedgerEntry*> harmless_beside(const LedgerEntry& violated, const Ledger& ledger) {
  std::vector<const LedgerEntry*> beside;
  for (const LedgerEntry& entry : ledger.entries)
    if (entry.standing == Standing::holds && entry.p_value == violated.p_value && *entry.p_value < family_level)
      beside.push_back(&entry);
  return beside;
}

std::string what_would_help(const Ledger& ledger) {
  std::vector<std::string> helps;
  if (ledger.recorded.clipped && std::ranges::any_of(ledger.departures, looks_clipped))
    helps.emplace_back(
        "first leave out the part of the record that is clipped: clipping looks like friction or drift");
  for (const std::vector<Assumption>& departure : ledger.departures)
    if (std::string help = what_would_help(departure, ledger); std::ranges::find(helps, help) == helps.end())
      helps.push_back(std::move(help));
  return core::joined(helps, "; and ");
}

}  // namespace dualdamp::identify
