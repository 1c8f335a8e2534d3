#include "cli/command_line/arguments.hpp"
#include "cli/interrupt.hpp"
#include "cli/isolation.hpp"
#include "cli/startup.hpp"

int main(int argc, char** argv) {
  dualdamp::cli::hold_closed_streams();
  dualdamp::cli::hold_stack();
  dualdamp::cli::end_with_a_message();
  const dualdamp::cli::Call call = dualdamp::cli::parse(argc, argv);
  if (call.isolation > 0.0) return dualdamp::cli::execute_isolated(call);
  dualdamp::cli::watch_for_interrupt();
  return dualdamp::cli::execute_to_its_end(call);
}
