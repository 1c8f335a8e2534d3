#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/interrupt.hpp"

int main(int argc, char** argv) {
  dualdamp::cli::watch_for_interrupt();
  return dualdamp::cli::execute(dualdamp::cli::parse(argc, argv));
}
