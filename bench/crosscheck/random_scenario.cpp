#include "bench/crosscheck/random_scenario.hpp"

#include <cmath>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "scenarios/format/limits.hpp"

namespace dualdamp::crosscheck {

namespace {

/// Lower seeds draw no attached masses, so that their cases stay the same as in earlier runs.
constexpr std::uint64_t first_with_attached_mass = 70;
/// From this seed on `add_late_laws` adds to the laws.
constexpr std::uint64_t first_with_late_laws = 10'000;

std::string frequency(double omega) { return core::format_number(omega) + " rad/s"; }

double damping_ratio(Draws& draws, bool wide) {
  const int kind = draws.pick(16);
  if (kind == 0) return 0.0;
  if (kind == 1) return -draws.logarithmic(1e-3, wide ? 10.0 : 0.5);
  return wide ? draws.logarithmic(1e-6, 1e4) : draws.logarithmic(1e-3, 2.0);
}

Json harmonics(Draws& draws, double amplitude) {
  Json list = Json::array();
  const int count = 1 + draws.pick(draws.chance(0.2) ? 8 : 3);
  int order = 1;
  for (int i = 0; i < count; ++i) {
    order += 1 + draws.pick(3);
    const double size = amplitude * draws.logarithmic(1e-3, 0.5);
    list.push_back({{"order", order}, {"amplitude", size}, {"phase", draws.angle()}});
  }
  return list;
}

Json harmonic(Draws& draws, const Sizes& sizes, bool moves_base) {
  const double ratio = sizes.wide ? draws.logarithmic(1e-3, 1e3) : draws.logarithmic(0.05, 20.0);
  const double amplitude = moves_base ? sizes.length() : sizes.force;
  Json drive = {{"type", moves_base ? "base_harmonic" : "force_harmonic"},
                {"amplitude", amplitude},
                {"frequency", frequency(ratio * sizes.natural)}};
  if (draws.chance(0.6)) drive["phase"] = draws.angle();
  if (draws.chance(0.2)) drive["harmonics"] = harmonics(draws, amplitude);
  if (!moves_base && draws.chance(0.3)) drive["offset"] = draws.sign() * sizes.force * draws.logarithmic(1e-2, 1.0);
  return drive;
}

/// A ramp that reaches the force of the drive within 0.1 to 100 natural periods, so that the friction gives way.
Json ramp(Draws& draws, const Sizes& sizes, bool moves_base) {
  const double time = draws.logarithmic(0.1, 100.0) * core::two_pi / sizes.natural;
  const double sign = draws.sign();
  if (moves_base) return {{"type", "base_ramp"}, {"velocity", sign * sizes.length() / time}};
  return {{"type", "force_ramp"}, {"rate", sign * sizes.force / time}};
}

Json noise(Draws& draws, const Sizes& sizes) {
  const double bandwidth = sizes.natural * draws.logarithmic(0.5, 20.0);
  const double size = sizes.force * sizes.force;
  return {{"type", "force_noise"},
          {"intensity", size / bandwidth},
          {"bandwidth", frequency(bandwidth)},
          {"seed", draws.pick(1'000'000)}};
}

/// Samples at nodes; a base with a damper to it may not jump.
Json table(Draws& draws, const Sizes& sizes, bool may_jump) {
  const bool moves_base = draws.chance(0.5);
  const double natural_period = core::two_pi / sizes.natural;
  const double spacing = natural_period * draws.logarithmic(0.01, 1.0);
  const double size = moves_base ? sizes.length() : sizes.force;
  Json times = {0.0};
  Json values = {size * draws.uniform(-1.0, 1.0)};
  const int count = 2 + draws.pick(100);
  for (int i = 0; i < count; ++i) {
    times.push_back(times.back().get<double>() + spacing * draws.uniform(0.1, 1.9));
    values.push_back(size * draws.uniform(-1.0, 1.0));
  }
  const bool jumps = may_jump || !moves_base;
  const int kind = draws.pick(jumps ? 3 : 2);
  return {{"type", moves_base ? "base_table" : "force_table"},
          {"times", times},
          {"values", values},
          {"interpolation", kind == 0   ? "linear"
                            : kind == 1 ? "cubic"
                                        : "step"},
          {"repeat", jumps && draws.chance(0.5)}};
}

/// A chirp, up or down by at most a decade, within the duration of the motion.
Json chirp(Draws& draws, const Sizes& sizes) {
  const bool moves_base = draws.chance(0.5);
  const double from = sizes.natural * draws.logarithmic(0.1, 10.0);
  return {{"type", moves_base ? "base_chirp" : "force_chirp"},
          {"amplitude", moves_base ? sizes.length() : sizes.force},
          {"from", frequency(from)},
          {"to", frequency(from * draws.logarithmic(0.1, 10.0))},
          {"duration", core::two_pi / sizes.natural * draws.logarithmic(0.5, 20.0)},
          {"spacing", draws.chance(0.5) ? "linear" : "log"},
          {"phase", draws.angle()}};
}

Json excitation(Draws& draws, const Sizes& sizes, bool may_jump) {
  const int kind = draws.pick(20);
  if (kind < 10) return harmonic(draws, sizes, true);
  if (kind < 14) return harmonic(draws, sizes, false);
  if (kind < 16) return ramp(draws, sizes, true);
  if (kind < 17) return ramp(draws, sizes, false);
  if (kind < 18) return noise(draws, sizes);
  if (kind < 19) return draws.chance(0.7) ? table(draws, sizes, may_jump) : chirp(draws, sizes);
  return {{"type", "none"}};
}

/// Duration of a motion without a period [s].
double duration(const Json& excitation, const Sizes& sizes) {
  const double natural_period = core::two_pi / sizes.natural;
  double time = 10.0 * natural_period;
  if (excitation.contains("velocity"))
    time += 3.0 * sizes.length() / std::abs(excitation.at("velocity").get<double>());
  if (excitation.contains("rate")) time += 3.0 * sizes.force / std::abs(excitation.at("rate").get<double>());
  return time;
}

/// `more`: draws of an attached mass; without them none is drawn. `with_late`: these draw more laws as well.
Json scenario_of(Draws& draws, Draws* more, bool with_late) {
  Sizes sizes;
  sizes.wide = draws.chance(0.3);
  sizes.mass = draws.logarithmic(1e-3, 1e3);
  sizes.natural = draws.logarithmic(0.1, 1e3);
  sizes.stiffness = sizes.mass * sizes.natural * sizes.natural;
  sizes.force = sizes.stiffness * draws.logarithmic(1e-4, 1.0);
  const double zeta = damping_ratio(draws, sizes.wide);
  Json system = {
      {"mass", sizes.mass}, {"stiffness", sizes.stiffness}, {"damping", 2.0 * zeta * sizes.mass * sizes.natural}};
  if (draws.chance(0.25)) system["damper_to"] = "base";
  if (draws.chance(0.08)) {
    const double share = draws.chance(0.7) ? draws.logarithmic(1e-3, 10.0) : -draws.logarithmic(1e-3, 0.05);
    system["cubic_stiffness"] = share * sizes.stiffness / (sizes.length() * sizes.length());
  }
  const Json drive = excitation(draws, sizes, !system.contains("damper_to"));
  system["friction"] = random_friction(draws, sizes);
  if (more != nullptr) attach_mass(*more, sizes, system["friction"]);
  if (more != nullptr && with_late) add_late_laws(*more, sizes, drive.contains("frequency"), system["friction"]);
  Json scenario = {{"schema", scenarios::schema_name}, {"system", system}, {"excitation", drive}};
  const bool is_free = drive.at("type") == "none";
  if (is_free || draws.chance(0.4)) {
    const double x = draws.sign() * sizes.length() * draws.logarithmic(0.1, 10.0);
    const double v = draws.chance(0.5) ? 0.0 : draws.sign() * sizes.speed() * draws.logarithmic(0.1, 10.0);
    scenario["initial"] = {{"position", x}, {"velocity", v}};
  }
  const bool is_periodic = drive.contains("frequency");
  scenario["analysis"] = is_periodic ? Json{{"type", "steady_state"}}
                                     : Json{{"type", "simulate"}, {"duration", duration(drive, sizes)}};
  return scenario;
}

}  // namespace

Json random_scenario(std::uint64_t seed, std::uint32_t index) {
  Draws draws(seed, index);
  Draws more(~seed, index);
  return scenario_of(draws, seed >= first_with_attached_mass ? &more : nullptr, seed >= first_with_late_laws);
}

Json random_scenario(std::string_view bytes) {
  Draws draws(bytes);
  return scenario_of(draws, &draws, true);
}

std::string yaml(const Json& scenario) {
  std::string text;
  for (const auto& [key, value] : scenario.items()) {
    if (key != "system") {
      text += key + ": " + (value.is_string() ? value.get<std::string>() : value.dump()) + "\n";
      continue;
    }
    text += "system:\n";
    for (const auto& [name, part] : value.items()) {
      if (name != "friction") {
        text += "  " + name + ": " + (part.is_string() ? part.get<std::string>() : part.dump()) + "\n";
        continue;
      }
      text += "  friction:\n";
      for (const Json& law : part) text += "    - " + law.dump() + "\n";
    }
  }
  return text;
}

}  // namespace dualdamp::crosscheck
