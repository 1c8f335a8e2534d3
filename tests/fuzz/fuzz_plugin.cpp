/// The table of a plugin, drawn from the input, whose functions answer by the input, too: status, values that are
/// none, modes that it did not declare, exceptions. The table is refused, the law is refused, or the motion under
/// it is finite. Addresses are those of the harness: no program can judge others.

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bench/crosscheck/walk.hpp"
#include "core/diagnostics.hpp"
#include "friction_models/law_fault.hpp"
#include "friction_models/plugin.hpp"
#include "friction_models/registry.hpp"
#include "tests/fuzz/harness.hpp"

namespace {

using namespace dualdamp;
using fuzz::require;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<double, 16> numbers = {0.0,      1.0,       -1.0,         0.5,    2.0,    1e-300,
                                            1e300,    -1e300,    1e-12,        1000.0, -100.0, 1e154,
                                            infinity, -infinity, not_a_number, 5e-324};
constexpr unsigned most = std::numeric_limits<unsigned>::max();

/// The bytes of the input one by one, zero behind its end.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}

  unsigned next() {
    if (bytes_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(bytes_.front());
    bytes_.remove_prefix(1);
    return byte;
  }
  /// Mostly the first one, which is sound.
  template <class Item, std::size_t size>
  Item one_of(const std::array<Item, size>& items) {
    const unsigned byte = next();
    return byte < 200 ? items.front() : items.at(byte % size);
  }
  double number() { return numbers.at(next() % numbers.size()); }

 private:
  std::string_view bytes_;
};

std::string_view answers;  // NOLINT(*-avoid-non-const-global-variables): what the C functions answer by

/// The byte that one function answers by: the same for the same mode.
unsigned answer(unsigned function, int mode = 0) {
  if (answers.empty()) return 0;
  return static_cast<unsigned char>(answers[(function + 11U * static_cast<unsigned>(mode & 3)) % answers.size()]);
}

/// The sound value, or another one.
double value(unsigned byte, double sound) { return byte < 224 ? sound : numbers.at(byte % numbers.size()); }

int end(unsigned byte) {
  if (byte == 255) throw std::runtime_error("what a C function must not do");
  if (byte == 254) throw 5;
  return byte == 253 ? 7 : DUALDAMP_OK;
}

unsigned states_of_table = 0;  // NOLINT(*-avoid-non-const-global-variables)
unsigned guards_of_table = 0;  // NOLINT(*-avoid-non-const-global-variables)

int create(const double* /*values*/, void** law, char* message, unsigned size) {
  *law = nullptr;
  if (answer(0) % 16 == 15) std::string(size, '\xff').copy(message, size);
  return end(answer(1));
}
void destroy(void* /*law*/) {}
int respond(const void* /*law*/, int mode, const double* states, const dualdamp_instant* now, double* force,
            double* rates) {
  const double stretch = states_of_table > 0 ? now->x - states[0] : now->v;
  *force = value(answer(2, mode), mode % 2 == 0 ? 10.0 * stretch : now->direction * dualdamp_limit(now, 1.0));
  for (unsigned i = 0; i < states_of_table; ++i)
    rates[i] = value(answer(3 + i, mode), mode % 2 == 0 ? 0.0 : now->v);
  return end(answer(4, mode));
}
int scales(const void* /*law*/, double* sizes) {
  for (unsigned i = 0; i < states_of_table; ++i) sizes[i] = value(answer(5 + i), 0.1);
  return end(answer(6));
}
int start(const void* /*law*/, const dualdamp_instant* now, int* mode, double* states) {
  *mode = static_cast<int>(answer(7) % 32) - (answer(7) > 250 ? 9 : 0);
  for (unsigned i = 0; i < states_of_table; ++i) states[i] = value(answer(8 + i), now->x);
  return end(answer(9));
}
int static_limit(const void* /*law*/, int mode, const double* /*states*/, const dualdamp_instant* /*now*/,
                 double* limit) {
  *limit = value(answer(10, mode), 1.0);
  return end(answer(11, mode));
}
int guard(const void* /*law*/, int mode, const double* states, const dualdamp_instant* now, double* values) {
  const double stretch = states_of_table > 0 ? now->x - states[0] : now->x;
  for (unsigned i = 0; i < guards_of_table; ++i)
    values[i] = value(answer(12 + i, mode), mode % 2 == 0 ? 0.05 - (i % 2 == 0 ? stretch : -stretch) : 1.0);
  return end(answer(13, mode));
}
int jump(const void* /*law*/, int cause, const dualdamp_instant* now, int* mode, double* states) {
  const unsigned byte = answer(14, *mode);
  *mode = byte < 240 ? (cause >= 0 ? 1 : 0) : static_cast<int>(byte) - 245;
  for (unsigned i = 0; i < states_of_table; ++i) states[i] = value(answer(15 + i, *mode), now->x);
  return end(answer(16, *mode));
}
int dissipation(const void* /*law*/, int mode, const double* /*states*/, const dualdamp_instant* now,
                double* power) {
  *power = value(answer(17, mode), std::abs(now->v));
  return end(answer(18, mode));
}

/// A table and what it points to.
struct Plugin {
  std::string long_text = std::string(2000, 'a');
  std::array<dualdamp_parameter, 80> parameters{};
  dualdamp_law_table table{};

  explicit Plugin(Bytes& from) {
    const char* long_one = long_text.c_str();
    const std::array<const char*, 9> names = {"fuzzed", "coulomb", nullptr, "",      "Fuzzed",
                                              "a b",    "law",     "x\n",   long_one};
    const std::array<const char*, 7> texts = {"text",     nullptr,       "",      "two\nlines",
                                              "\xff\xfe", "caf\xc3\xa9", long_one};
    const std::array<const char*, 9> units = {"N", "N/m", "1", "m", "mm", "furlong", nullptr, "", long_one};
    const std::array<const char*, 8> keys = {"kinetic", "stiffness", "law", "drift",
                                             "Kinetic", nullptr,     "",    long_one};
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      dualdamp_parameter& p = parameters.at(i);
      p = {.name = i < 3 ? (i == 0 ? from.one_of(keys) : keys.at((i + from.next()) % keys.size())) : "more",
           .unit = i < 3 ? from.one_of(units) : "1",
           .meaning = i < 3 ? from.one_of(texts) : "text",
           .high = infinity};
      if (i >= 3 || from.next() < 128) continue;
      p.low = from.number();
      p.high = from.number();
      p.low_is_open = static_cast<int>(from.next() % 2);
      p.high_is_open = static_cast<int>(from.next() % 2);
      p.has_default = static_cast<int>(from.next() % 2);
      p.fallback = from.number();
      p.is_limit = static_cast<int>(from.next() % 2);
    }
    constexpr unsigned size = sizeof(dualdamp_law_table);
    table = {.size = from.one_of(std::array{size, 0U, size - 8, most}),
             .abi = from.one_of(std::array{DUALDAMP_LAW_ABI, 0U, 2U, most}),
             .abilities = from.next(),
             .modes = from.one_of(std::array{2U, 1U, 0U, 30U, most}),
             .states = from.one_of(std::array{1U, 0U, 2U, 64U, 65U, most}),
             .guards = from.one_of(std::array{2U, 0U, 1U, 16U, 17U, most}),
             .parameter_count = from.one_of(std::array{1U, 0U, 2U, 3U, 64U, 65U, most}),
             .parameters = from.next() < 250 ? parameters.data() : nullptr,
             .name = from.one_of(names),
             .version = from.one_of(texts),
             .summary = from.one_of(texts),
             .equation = from.one_of(texts),
             .remembers = from.one_of(texts),
             .caution = from.one_of(texts),
             .sources = from.one_of(texts)};
    // A function that is not there is as likely as a wrong text.
    const auto there = [&] { return from.next() < 240; };
    table.create = there() ? create : nullptr;
    table.destroy = there() ? destroy : nullptr;
    table.respond = there() ? respond : nullptr;
    table.scales = there() ? scales : nullptr;
    table.start = there() ? start : nullptr;
    table.static_limit = there() ? static_limit : nullptr;
    table.guard = there() ? guard : nullptr;
    table.jump = there() ? jump : nullptr;
    table.dissipation = there() ? dissipation : nullptr;
  }
};

void run(const friction::LawEntry& entry, Bytes& from) {
  friction::ParameterValues values;
  for (const friction::Parameter& parameter : entry.parameters)
    if (parameter.required()) values.set(parameter.name, from.number());
  if (!friction::complete(entry, values).empty()) return;
  if (entry.warnings) (void)entry.warnings(values);
  const sim::Model model{
      .oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0},
      .excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 20.0, .frequency = 9.0},
      .friction = entry.make(values)};
  const crosscheck::Walk walk = crosscheck::walk(model, {.duration = 3.0, .most_work = 5'000, .with_energy = true});
  require(walk.finite, "a motion is finite");
  require(walk.outcome.ok() || !walk.outcome.reason.empty(), "an end without a result has a reason");
  require(!walk.outcome.ok() || std::isfinite(walk.energy.defect), "an energy is finite");
}

}  // namespace

void dualdamp::fuzz::consume(std::string_view input) {
  constexpr std::size_t of_answers = 24;
  answers = input.substr(0, of_answers);
  Bytes from(input.size() > of_answers ? input.substr(of_answers) : std::string_view());
  const Plugin plugin(from);
  states_of_table = plugin.table.states;
  guards_of_table = plugin.table.guards;
  try {
    friction::add_plugin(plugin.table, "fuzzed.so", std::string(64, '0'));
  } catch (const core::InputError& error) {
    require(!error.diagnostics().empty(), "a refusal says why");
    return;
  }
  const std::string name = plugin.table.name;
  try {
    run(*friction::find_law(name), from);
  } catch (const friction::LawFault& fault) {
    require(*fault.what() != '\0', "a law's fault has a reason");
  } catch (...) {
    friction::remove_added_law(name);
    throw;
  }
  friction::remove_added_law(name);
}
