#pragma once
/// The command line as values. Only arguments.cpp knows the library that parses it.

#include <string>
#include <variant>
#include <vector>

namespace dualdamp::cli {

struct RunCommand {
  std::vector<std::string> files;
  std::string out;
  std::vector<std::string> set;
  int jobs = 1;
  bool json = false;
  bool quiet = false;
  bool dry_run = false;
};

struct CheckCommand {
  std::vector<std::string> files;
};

struct LawsCommand {
  std::string name;
};

struct MethodsCommand {
  std::string name;
};

struct SchemaCommand {
  bool markdown = false;
};

struct IdentifyCommand {
  std::string data;
  std::string mass, stiffness, frequency;
  std::vector<std::string> methods;
  std::string out;
  bool json = false;
  bool quiet = false;
};

struct ReportCommand {
  std::vector<std::string> directories;
};

/// Nothing to do but to print and leave: help, version, or a wrong command line.
struct Leave {
  std::string message;
  int status = 0;
  bool json = false;  ///< the caller wanted JSON
};

using Command = std::variant<RunCommand, CheckCommand, LawsCommand, MethodsCommand, SchemaCommand, IdentifyCommand,
                             ReportCommand, Leave>;

[[nodiscard]] Command parse(int argc, const char* const* argv);

}  // namespace dualdamp::cli
