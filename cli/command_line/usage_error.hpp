#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace dualdamp::cli {

/// What is wrong with a command line that `app` has refused, with the command or option that it probably means.
[[nodiscard]] std::string usage_error(const CLI::App& app, const CLI::ParseError& error);

/// The command line that prints what the command named in it takes: `dualdamp stress export --help`.
[[nodiscard]] std::string help_of(const CLI::App& app);

}  // namespace dualdamp::cli
