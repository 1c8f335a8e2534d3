#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "scenarios/format/excitations.hpp"

using namespace dualdamp;
using scenarios::SamplesIn;

namespace {

/// What the name of a type promises by its words.
bool has(const std::string& name, const std::string& word) { return name.find(word) != std::string::npos; }

}  // namespace

TEST_CASE("excitations: each type of a file is in the model what its name says") {
  for (const scenarios::Variant& one : scenarios::excitations().variants) {
    CAPTURE(one.name);
    const sim::Excitation drive = scenarios::excitation_named(one.name);
    CHECK(scenarios::excitation_type(one.name) == drive.type);
    CHECK((drive.type == sim::ExcitationType::none) == (one.name == "none"));
    CHECK(scenarios::moves_base(one.name) == has(one.name, "base"));
    CHECK(drive.moves_base() == has(one.name, "base"));
    CHECK(drive.is_harmonic() == has(one.name, "_harmonic"));
    CHECK(drive.is_ramp() == has(one.name, "_ramp"));
    CHECK(drive.is_noise() == has(one.name, "_noise"));
    CHECK(drive.is_chirp() == has(one.name, "_chirp"));
    const SamplesIn samples = scenarios::samples_of(one.name);
    CHECK((samples == SamplesIn::scenario) == has(one.name, "_table"));
    CHECK((samples == SamplesIn::data_file) == has(one.name, "measured_"));
    CHECK(drive.is_sampled() == (samples != SamplesIn::nowhere));
  }
  CHECK(scenarios::harmonic_excitations() == std::vector<std::string>{"base_harmonic", "force_harmonic"});
}

TEST_CASE("excitations: a name that is not in the list says nothing") {
  for (const char* name : {"", "base_wiggle", "measured_air"}) {
    CHECK_FALSE(scenarios::excitation_type(name));
    CHECK(scenarios::excitation_named(name).type == sim::ExcitationType::none);
    CHECK(scenarios::samples_of(name) == SamplesIn::nowhere);
    CHECK_FALSE(scenarios::moves_base(name));
  }
}
