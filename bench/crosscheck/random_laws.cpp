#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "bench/crosscheck/random_scenario.hpp"
#include "friction_models/registry.hpp"

namespace dualdamp::crosscheck {

namespace {

/// Draws laws. Their force limits are fractions of the drive's force; their stiffnesses lie in a wide range around
/// the oscillator's.
class RandomLaws {
 public:
  RandomLaws(Draws& draws, const Sizes& sizes) : draws_(draws), sizes_(sizes) {}

  using Draw = Json (RandomLaws::*)();
  using Kind = std::pair<const char*, Draw>;
  static const std::array<Kind, 5> exact;
  static const std::array<Kind, 11> smooth;
  static const std::array<Kind, 4> late;
  static const Kind beside;

  Json law(const Kind& kind) {
    Json result = {{"law", kind.first}};
    result.update((this->*kind.second)());
    add_modifiers(result);
    return result;
  }

  /// In one law of eight. A law that knows neither modifier stays as it is.
  void add_load(Json& law, bool is_harmonic) {
    const friction::LawEntry* entry = friction::find_law(law.at("law").get<std::string>());
    const auto takes = [&](std::string_view modifier) {
      return std::ranges::find(entry->modifiers, modifier) != entry->modifiers.end();
    };
    if (!draws_.chance(0.125)) return;
    if (takes("load_modulation") && is_harmonic && draws_.chance(0.5))
      law["load_modulation"] = {
          {"ratio", draws_.uniform(0.0, 0.99)}, {"order", 1 + draws_.pick(3)}, {"phase", draws_.angle()}};
    else if (takes("load_gradient") && !law.contains("contact_damping"))
      law["load_gradient"] = draws_.sign() * draws_.logarithmic(1e-3, 1.5) / sizes_.length();
  }

 private:
  double force() {
    return sizes_.force * (sizes_.wide ? draws_.logarithmic(1e-6, 1e3) : draws_.logarithmic(1e-2, 1.5));
  }
  double critical() const { return 2.0 * sizes_.mass * sizes_.natural; }
  double time() const { return 1.0 / sizes_.natural; }
  double contact_stiffness() {
    return sizes_.stiffness * (sizes_.wide ? draws_.logarithmic(1e-3, 1e8) : draws_.logarithmic(0.3, 1e4));
  }

  /// Kinetic friction, and with this probability a higher static friction.
  Json levels(double chance_of_static) {
    const double kinetic = force();
    Json result = {{"kinetic", kinetic}};
    if (draws_.chance(chance_of_static)) result["static"] = kinetic * draws_.uniform(1.0, sizes_.wide ? 5.0 : 2.5);
    return result;
  }
  Json coulomb() { return levels(0.5); }
  Json contact() {
    Json result = levels(0.5);
    result["contact_stiffness"] = contact_stiffness();
    if (draws_.chance(0.4))
      result["contact_damping"] =
          critical() * (sizes_.wide ? draws_.logarithmic(1e-12, 1e5) : draws_.logarithmic(1e-3, 10.0));
    return result;
  }
  Json reset_integrator() {
    Json result = {{"kinetic", force()}, {"stiffness", contact_stiffness()}};
    if (draws_.chance(0.6)) result["static_gain"] = draws_.uniform(0.0, 1.5);
    if (draws_.chance(0.4)) result["damping"] = critical() * draws_.logarithmic(1e-3, 10.0);
    return result;
  }
  Json iwan() {
    const double limit = force();
    const double stiffness = contact_stiffness();
    if (draws_.chance(0.5)) return {{"stiffness", stiffness}, {"limit", limit}, {"count", 1 + draws_.pick(20)}};
    Json elements = Json::array();
    const int count = 1 + draws_.pick(5);
    for (int i = 0; i < count; ++i)
      elements.push_back({{"stiffness", stiffness * draws_.logarithmic(0.1, 10.0)},
                          {"limit", limit * draws_.logarithmic(0.1, 1.0)}});
    return {{"elements", elements}};
  }
  /// Bristles long enough not to snap all the time.
  Json bristle() {
    const int count = 1 + draws_.pick(5);
    const double distance = sizes_.length() * draws_.logarithmic(0.2, 2.0);
    const double limit = std::min(force(), sizes_.force);
    const double stiffness = limit / (count * distance);
    return {{"stiffness", stiffness}, {"snap_distance", distance}, {"count", count}, {"seed", draws_.pick(1000)}};
  }

  Json curve() {
    Json result = levels(0.8);
    result["stribeck_velocity"] = sizes_.speed() * draws_.logarithmic(0.02, 2.0);
    return result;
  }
  Json stribeck() {
    Json result = curve();
    const int form = draws_.pick(4);
    if (form == 0) result["exponent"] = draws_.uniform(0.7, 3.0);
    if (form >= 2) result["form"] = form == 2 ? "exponential" : "lorentz";
    return result;
  }
  /// Bristles not much softer than the spring, nor so stiff that only implicit steps are fast.
  double sigma0(double kinetic) {
    return kinetic /
           (sizes_.length() * (sizes_.wide ? draws_.logarithmic(1e-5, 1.0) : draws_.logarithmic(1e-3, 0.3)));
  }
  Json lugre() {
    Json result = curve();
    result["sigma0"] = sigma0(result.at("kinetic").get<double>());
    result["sigma1"] = critical() * draws_.logarithmic(1e-3, 1.0);
    if (draws_.chance(0.5)) result["sigma2"] = critical() * draws_.logarithmic(1e-3, 0.5);
    return result;
  }
  Json elasto_plastic() {
    Json result = lugre();
    result["elastic_limit"] =
        result.at("kinetic").get<double>() / result.at("sigma0").get<double>() * draws_.uniform(0.2, 0.9);
    return result;
  }
  Json dahl() {
    const double kinetic = force();
    Json result = {{"kinetic", kinetic}, {"sigma0", sigma0(kinetic)}};
    if (draws_.chance(0.3)) result["exponent"] = draws_.uniform(1.0, 2.0);
    return result;
  }
  Json bouc_wen() {
    const double limit = force();
    Json result = {{"limit", limit}, {"stiffness", sigma0(limit)}, {"exponent", draws_.uniform(1.0, 4.0)}};
    if (draws_.chance(0.5)) result["ratio"] = draws_.uniform(0.0, 0.5);
    if (draws_.chance(0.5)) result["beta_share"] = draws_.uniform(0.5, 1.0);
    return result;
  }
  Json generalized_maxwell_slip() {
    Json result = curve();
    const double stiffness = sigma0(result.at("kinetic").get<double>());
    const int count = 1 + draws_.pick(4);
    Json elements = Json::array();
    for (int i = 0; i < count; ++i)
      elements.push_back({{"stiffness", stiffness * draws_.logarithmic(0.2, 2.0)}, {"share", 1.0 / count}});
    result["elements"] = elements;
    result["attraction"] = result.at("kinetic").get<double>() * sizes_.natural * draws_.logarithmic(1.0, 100.0);
    return result;
  }
  Json rate_state() {
    const double a = draws_.logarithmic(0.003, 0.03);
    return {{"normal_force", force()},
            {"mu0", draws_.uniform(0.3, 0.8)},
            {"a", a},
            {"b", a * draws_.uniform(0.2, 2.0)},
            {"slip_distance", sizes_.length() * draws_.logarithmic(1e-2, 1.0)},
            {"reference_velocity", sizes_.speed() * draws_.logarithmic(1e-5, 1e-2)},
            {"evolution", draws_.chance(0.5) ? "aging" : "slip"}};
  }
  Json friction_lag() {
    Json result = stribeck();
    result["lag"] = time() * draws_.logarithmic(1e-2, 1.0);
    return result;
  }
  Json normal_vibration() {
    Json result = {{"mu", draws_.uniform(0.1, 0.6)}, {"weight", force()}};
    if (draws_.chance(0.5)) result["mu_static"] = result.at("mu").get<double>() * draws_.uniform(1.0, 1.5);
    const double weight = result.at("weight").get<double>();
    const double rise = draws_.logarithmic(3.0, 30.0) * sizes_.natural;
    result["static_approach"] = sizes_.length() * draws_.logarithmic(1e-4, 1e-2);
    result["normal_mass"] = 2.0 * weight / result.at("static_approach").get<double>() / (rise * rise);
    result["normal_damping_ratio"] = draws_.uniform(0.02, 0.5);
    result["lift_velocity"] = sizes_.speed() * draws_.logarithmic(0.1, 3.0);
    result["lift"] = 0.6 * weight / result.at("lift_velocity").get<double>() * draws_.uniform(0.0, 1.0);
    return result;
  }
  Json viscous_saturating() {
    const double velocity = sizes_.speed() * draws_.logarithmic(0.05, 5.0);
    return {{"coefficient", force() / velocity}, {"saturation_velocity", velocity}};
  }
  Json viscous_power() {
    return {{"coefficient", force()},
            {"reference_velocity", sizes_.speed()},
            {"exponent", draws_.chance(0.3) ? 2.0 : draws_.uniform(0.5, 3.0)}};
  }
  Json asymmetric_coulomb() {
    Json result;
    for (const char* direction : {"_forward", "_backward"}) {
      const double kinetic = force();
      result[std::string("kinetic") + direction] = kinetic;
      if (draws_.chance(0.5)) result[std::string("static") + direction] = kinetic * draws_.uniform(1.0, 2.5);
      result[std::string("viscous") + direction] =
          draws_.chance(0.5) ? critical() * draws_.logarithmic(1e-3, 1.0) : 0.0;
    }
    return result;
  }
  Json free_play() {
    Json result = levels(0.5);
    result["play"] =
        sizes_.length() * (sizes_.wide ? draws_.logarithmic(1e-6, 1e2) : draws_.logarithmic(1e-3, 3.0));
    return result;
  }
  Json gap_spring() {
    const double stiffness =
        sizes_.stiffness * (sizes_.wide ? draws_.logarithmic(1e-3, 1e6) : draws_.logarithmic(0.1, 100.0));
    return {{"stiffness", stiffness},
            {"gap", draws_.chance(0.1) ? 0.0 : sizes_.length() * draws_.logarithmic(1e-3, 3.0)}};
  }
  Json iwan_four_parameter() {
    return {{"stiffness", contact_stiffness()},
            {"limit", force()},
            {"exponent", draws_.uniform(-0.9, 2.0)},
            {"beta", draws_.chance(0.2) ? 0.0 : draws_.logarithmic(1e-3, 10.0)},
            {"count", 2 + draws_.pick(30)}};
  }
  Json attached_mass() {
    const double mass = sizes_.mass * (sizes_.wide ? draws_.logarithmic(1e-5, 1e2) : draws_.logarithmic(1e-3, 2.0));
    const double natural =
        sizes_.natural * (sizes_.wide ? draws_.logarithmic(1e-2, 1e2) : draws_.logarithmic(0.1, 10.0));
    Json result = {{"mass", mass}, {"stiffness", mass * natural * natural}};
    if (draws_.chance(0.75)) result["damping"] = 2.0 * mass * natural * draws_.logarithmic(1e-3, 1.0);
    return result;
  }

  void add_modifiers(Json& law) {
    const friction::LawEntry* entry = friction::find_law(law.at("law").get<std::string>());
    for (const std::string_view modifier : drawn_modifiers) {
      if (std::ranges::find(entry->modifiers, modifier) == entry->modifiers.end() || !draws_.chance(0.07)) continue;
      if (modifier == "drift") {
        law["drift"] = draws_.uniform(-0.03, 0.03) / time();
      } else if (modifier == "position_slope" && !law.contains("contact_damping")) {
        law["position_slope"] = draws_.sign() * sizes_.stiffness * draws_.logarithmic(1e-3, 1.5);
      } else if (modifier == "fluctuation") {
        const double ratio = draws_.uniform(0.05, entry->is_random ? 0.2 : 0.9);
        law["fluctuation"] = {{"ratio", ratio},
                              {"correlation_time", time() * draws_.logarithmic(1.0, 50.0)},
                              {"seed", draws_.pick(1000)}};
      } else if (modifier == "warming") {
        law["warming"] = {{"power", sizes_.force * sizes_.speed() * draws_.logarithmic(0.1, 10.0)},
                          {"time_constant", time() * draws_.logarithmic(1.0, 100.0)}};
      }
    }
  }

  /// A list of its own: a new modifier in the list of modifiers would change all cases. `add_load` draws
  /// `load_gradient` and `load_modulation`, from the seeds on that have late laws.
  static constexpr std::array<std::string_view, 4> drawn_modifiers = {"drift", "position_slope", "fluctuation",
                                                                      "warming"};

  Draws& draws_;
  const Sizes& sizes_;
};

const std::array<RandomLaws::Kind, 5> RandomLaws::exact = {{{"coulomb", &RandomLaws::coulomb},
                                                            {"contact_compliance", &RandomLaws::contact},
                                                            {"reset_integrator", &RandomLaws::reset_integrator},
                                                            {"iwan", &RandomLaws::iwan},
                                                            {"bristle", &RandomLaws::bristle}}};

const std::array<RandomLaws::Kind, 11> RandomLaws::smooth = {
    {{"stribeck", &RandomLaws::stribeck},
     {"lugre", &RandomLaws::lugre},
     {"elasto_plastic", &RandomLaws::elasto_plastic},
     {"dahl", &RandomLaws::dahl},
     {"bouc_wen", &RandomLaws::bouc_wen},
     {"generalized_maxwell_slip", &RandomLaws::generalized_maxwell_slip},
     {"rate_state", &RandomLaws::rate_state},
     {"friction_lag", &RandomLaws::friction_lag},
     {"normal_vibration", &RandomLaws::normal_vibration},
     {"viscous_saturating", &RandomLaws::viscous_saturating},
     {"viscous_power", &RandomLaws::viscous_power}}};

/// Laws that the lower seeds do not draw.
const std::array<RandomLaws::Kind, 4> RandomLaws::late = {
    {{"asymmetric_coulomb", &RandomLaws::asymmetric_coulomb},
     {"free_play", &RandomLaws::free_play},
     {"gap_spring", &RandomLaws::gap_spring},
     {"iwan_four_parameter", &RandomLaws::iwan_four_parameter}}};

const RandomLaws::Kind RandomLaws::beside = {"attached_mass", &RandomLaws::attached_mass};

/// Laws of the exact engine, weighted by how common they are: mostly rigid friction and contacts.
std::size_t exact_kind(Draws& draws) {
  constexpr std::array<std::size_t, 10> kinds = {0, 0, 0, 0, 1, 1, 1, 2, 3, 4};
  return kinds[static_cast<std::size_t>(draws.pick(static_cast<int>(kinds.size())))];
}

}  // namespace

Json random_friction(Draws& draws, const Sizes& sizes) {
  RandomLaws laws(draws, sizes);
  Json list = Json::array();
  const bool has_smooth = draws.chance(0.25);
  if (has_smooth)
    list.push_back(laws.law(RandomLaws::smooth[static_cast<std::size_t>(draws.pick(RandomLaws::smooth.size()))]));
  const int more = draws.chance(0.65) ? (has_smooth ? 0 : 1) : 2 + draws.pick(2) - (has_smooth ? 1 : 0);
  for (int i = 0; i < more; ++i) list.push_back(laws.law(RandomLaws::exact[exact_kind(draws)]));
  return list;
}

void attach_mass(Draws& draws, const Sizes& sizes, Json& friction) {
  if (draws.chance(0.1)) friction.push_back(RandomLaws(draws, sizes).law(RandomLaws::beside));
}

void add_late_laws(Draws& draws, const Sizes& sizes, bool is_harmonic, Json& friction) {
  RandomLaws laws(draws, sizes);
  if (draws.chance(0.3)) {
    const std::size_t kind = static_cast<std::size_t>(draws.pick(RandomLaws::late.size()));
    if (draws.chance(0.5)) friction.clear();
    friction.push_back(laws.law(RandomLaws::late[kind]));
  }
  for (Json& law : friction) laws.add_load(law, is_harmonic);
}

}  // namespace dualdamp::crosscheck
