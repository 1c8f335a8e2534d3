#include "bench/truth.hpp"

#include "scenarios/format/values.hpp"

namespace dualdamp::bench {

void check_truth(scenarios::CheckedFile& file) {
  const std::string allowed = "{law: coulomb, kinetic: ...}";
  if (!file.has("system", "friction")) {
    if (file.node("system") != nullptr && !file.stands_in_file("system", "friction"))
      file.complain(file.node("system")->head(),
                    "'system.friction' is missing: " + file.subject() + " departs from it", allowed);
    return;
  }
  const scenarios::Json& friction = file.values().at("system").at("friction");
  const auto unit = [&](const char* name) { return core::unit_for(file.coordinate(), name); };
  const bool plain = friction.is_object() && friction.value("law", "") == "coulomb" &&
                     friction.contains("kinetic") && friction.contains("static") &&
                     friction.at("static") == friction.at("kinetic") && friction.size() == 3;
  if (!plain)
    file.complain("system.friction", file.subject() + " departs from Coulomb friction, and from nothing else",
                  allowed);
  else if (scenarios::number(friction.at("kinetic")) == 0.0)
    file.complain("system.friction.kinetic",
                  "'system.friction.kinetic' is out of range: numbers are relative to it", "> 0 " + unit("N"),
                  "0 " + unit("N"));
  if (file.number_at("system", "damping").value_or(1.0) <= 0.0)
    file.complain("system", "'system' has no damping: numbers are relative to it", "damping > 0 " + unit("N.s/m"));
}

void refuse_replaced_amplitude(scenarios::CheckedFile& file) {
  const std::string path = "excitation.amplitude";
  if (file.is_chosen(path))
    file.complain(path, "'" + path + "' has no effect: " + file.subject() + " has levels of its own", "without it");
}

}  // namespace dualdamp::bench
