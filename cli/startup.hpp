#pragma once
/// What the program sets up before anything else, against surroundings that would damage a result or end it without
/// a message.

namespace dualdamp::cli {

/// Takes the numbers of standard streams that are closed, since otherwise a file of a result would get one of them,
/// and what is printed would be written into it. The streams still fail.
void hold_closed_streams() noexcept;

/// Takes address space for the stack of this thread while there is some. Where a limit of memory leaves none when
/// the stack grows, the system ends the program by SIGSEGV. Without memory, or if the stack is limited to less than
/// 256 kB, it ends with a message.
void hold_stack() noexcept;

/// An exception that nothing can handle ends the program with a message and the status of a refusal: lack of memory
/// in a destructor, or while the message about it is made. Everything else is a bug.
void end_with_a_message() noexcept;

/// Says that there is not enough memory, without memory. Returns the exit status.
int say_out_of_memory() noexcept;

}  // namespace dualdamp::cli
