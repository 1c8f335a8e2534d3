// A law of a plugin for the tests: contact compliance without damping, static = kinetic, which needs modes, guards
// and jumps; and every way of breaking the interface. The environment variable FAULT chooses one; none: it is
// sound.

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "friction_models/dualdamp_law.h"

namespace {

bool is(std::string_view fault) {
  const char* text = std::getenv("FAULT");
  return text != nullptr && fault == text;
}

struct Slider {
  double kinetic;
  double stiffness;
};

enum Mode { stuck, forward, backward, modes };
enum Guard { forward_limit, backward_limit, guards };
enum State { slider_position, states };

double side_of(int mode) { return mode == forward ? 1.0 : -1.0; }

int create(const double* values, void** law, char* message, unsigned size) {
  if (is("create throws")) throw std::runtime_error("out of memory");
  if (is("refuses values")) {
    std::snprintf(message, size, "it does not like them");
    return 1;
  }
  if (is("warns")) std::snprintf(message, size, "the contact is soft");
  *law = new Slider{values[0], values[1]};
  return DUALDAMP_OK;
}

void destroy(void* law) { std::unique_ptr<Slider>(static_cast<Slider*>(law)); }

int respond(const void* law, int mode, const double* state, const dualdamp_instant* now, double* force,
            double* rates) {
  if (is("status")) return 7;
  if (is("crashes")) std::raise(SIGSEGV);
  if (is("calls exit")) std::exit(0);
  if (is("calls _exit")) std::_Exit(0);
  while (is("does not return")) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (is("throws")) throw std::runtime_error("what a C function must not do");
  if (is("throws a number")) throw 5;
  const auto& p = *static_cast<const Slider*>(law);
  const double limit = dualdamp_limit(now, p.kinetic);
  if (is("infinite") && now->x > 0.05) {
    *force = std::numeric_limits<double>::infinity();
    rates[0] = 0.0;
    return DUALDAMP_OK;
  }
  *force = mode == stuck ? p.stiffness * (now->x - state[slider_position]) : side_of(mode) * limit;
  if (is("active")) *force = -*force;
  if (is("NaN") && now->t > 0.1) *force = std::numeric_limits<double>::quiet_NaN();
  rates[slider_position] = is("rate NaN") ? std::sqrt(-1.0 - now->t) : 0.0;
  return DUALDAMP_OK;
}

int scales(const void* law, double* size) {
  const auto& p = *static_cast<const Slider*>(law);
  *size = is("scale") ? -1.0 : p.kinetic / p.stiffness;
  return DUALDAMP_OK;
}

int start(const void* /*law*/, const dualdamp_instant* now, int* mode, double* state) {
  *mode = is("start mode") ? -1 : stuck;
  state[slider_position] = now->x;
  return DUALDAMP_OK;
}

int guard(const void* law, int mode, const double* state, const dualdamp_instant* now, double* values) {
  static std::atomic<long> calls{0};
  const auto& p = *static_cast<const Slider*>(law);
  const double stretch = now->x - state[slider_position];
  const double limit = dualdamp_limit(now, p.kinetic);
  values[forward_limit] = mode == stuck ? limit - p.stiffness * stretch : 1.0;
  values[backward_limit] = mode == stuck ? limit + p.stiffness * stretch : 1.0;
  // Now and then it announces a limit as crossed, and does not stand by it when it is asked again.
  if (is("guard lies")) values[forward_limit] = ++calls % 97 == 0 ? -1.0 : 1.0;
  if (is("guard NaN")) values[backward_limit] = std::numeric_limits<double>::quiet_NaN();
  if (is("endless") && now->t > 0.1) values[forward_limit] = -1.0;
  return DUALDAMP_OK;
}

int jump(const void* law, int cause, const dualdamp_instant* now, int* mode, double* state) {
  const auto& p = *static_cast<const Slider*>(law);
  if (is("mode")) *mode = 5;
  if (is("mode")) return DUALDAMP_OK;
  if (cause >= 0) {
    *mode = cause == forward_limit ? forward : backward;
  } else if (*mode != stuck) {
    state[slider_position] = now->x - side_of(*mode) * dualdamp_limit(now, p.kinetic) / p.stiffness;
    *mode = stuck;
  }
  if (is("jump NaN")) state[slider_position] = std::numeric_limits<double>::quiet_NaN();
  return DUALDAMP_OK;
}

int negative_limit(const void* /*law*/, int /*mode*/, const double* /*state*/, const dualdamp_instant* /*now*/,
                   double* limit) {
  *limit = -1.0;
  return DUALDAMP_OK;
}

}  // namespace

extern "C" const dualdamp_law_table* dualdamp_law() {
  if (is("query throws")) throw std::runtime_error("what a C function must not do");
  if (is("no table")) return nullptr;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  static dualdamp_parameter parameters[] = {
      {"kinetic", "N", "level of the slider", 0.0, infinity, 1, 0, 0, 0.0, 1},
      {"contact_stiffness", "N/m", "stiffness of the contact", 0.0, infinity, 1, 0, 0, 0.0, 0}};
  if (is("parameter name")) parameters[0].name = "Kinetic level";
  if (is("parameter taken")) parameters[1].name = "kinetic";
  if (is("parameter of a modifier")) parameters[1].name = "drift";
  if (is("unit")) parameters[0].unit = "lbf";
  if (is("no unit")) parameters[0].unit = nullptr;
  if (is("meaning")) parameters[0].meaning = "";
  if (is("open infinity")) parameters[0].high_is_open = 1;
  if (is("range")) parameters[0].high = -1.0;
  if (is("range NaN")) parameters[0].low = std::numeric_limits<double>::quiet_NaN();
  if (is("default")) parameters[0].has_default = 1;
  static dualdamp_law_table table = {sizeof(dualdamp_law_table),
                                     DUALDAMP_LAW_ABI,
                                     DUALDAMP_IS_ODD | DUALDAMP_IS_PASSIVE,
                                     modes,
                                     states,
                                     guards,
                                     2,
                                     parameters,
                                     "test_slider",
                                     "0.3",
                                     "Coulomb slider behind a contact spring",
                                     "stuck: F = contact_stiffness (x - a);  slipping: F = +-kinetic",
                                     "position of the slider",
                                     nullptr,
                                     nullptr,
                                     create,
                                     destroy,
                                     respond,
                                     scales,
                                     start,
                                     nullptr,
                                     guard,
                                     jump,
                                     nullptr};
  if (is("version")) table.abi = 99;
  if (is("size")) table.size = 8;
  if (is("name taken")) table.name = "coulomb";
  if (is("name")) table.name = "Bad Law";
  if (is("no name")) table.name = nullptr;
  if (is("no summary")) table.summary = nullptr;
  if (is("text")) table.summary = "two\nlines";
  if (is("states")) table.states = 1000000;
  if (is("no modes")) table.modes = 0;
  if (is("no respond")) table.respond = nullptr;
  if (is("no scales")) table.scales = nullptr;
  if (is("no jump")) table.jump = nullptr;
  if (is("no parameters")) table.parameters = nullptr;
  if (is("limit")) table.static_limit = negative_limit;
  return &table;
}
