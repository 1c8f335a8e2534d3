# The compile options of every target; why they are what they are: docs/decisions/001-compile-options.md.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# A shared library of someone else's may hold ours; functions call each other as directly as without.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

find_program(CCACHE ccache)
if(CCACHE AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

if(PROJECT_IS_TOP_LEVEL)
  option(CMAKE_UNITY_BUILD "Compile the sources of a room together: less time from scratch, more after a change of one file" ON)
endif()
option(DUALDAMP_WARNINGS_AS_ERRORS "A warning stops the build" OFF)
option(DUALDAMP_FUZZ "Link the harnesses of tests/fuzz with clang's libFuzzer" OFF)
set(DUALDAMP_SANITIZE "" CACHE STRING "Sanitizers of every target: address,undefined or thread")

# Asserts stay on wherever speed is not the point: only Release turns them off.
string(REPLACE "-DNDEBUG" "" CMAKE_CXX_FLAGS_RELWITHDEBINFO "${CMAKE_CXX_FLAGS_RELWITHDEBINFO}")

add_library(dualdamp_options INTERFACE)
target_compile_options(dualdamp_options INTERFACE
  -ffp-contract=off
  # Asserts name files by their place in the tree: the same bits, and hits of the compiler cache, wherever it stands.
  -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=
  -fno-semantic-interposition
  # The compiler collects its garbage from 1 GB on, not from 128 MB on: a twentieth less time, a third more memory.
  $<$<CXX_COMPILER_ID:GNU>:-fcx-limited-range;-fno-math-errno;--param=ggc-min-heapsize=1000000>
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast -Wdouble-promotion -Wnon-virtual-dtor
  -Woverloaded-virtual -Wcast-qual -Wcast-align -Wformat=2 -Wimplicit-fallthrough
  # Tables leave out the fields that stay empty.
  -Wno-missing-field-initializers
  # The last four: false alarms of GCC 12 on std::string (GCC bug 105651), at link time too.
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond;-Wlogical-op;-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-array-bounds>
  # A false alarm of -O3 on members of temporaries that are empty strings.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<CONFIG:Release>>:-Wno-maybe-uninitialized>
  # Where rooms are compiled together a name of one file may shadow another file's; clang-tidy looks at the files alone.
  $<$<BOOL:${CMAKE_UNITY_BUILD}>:-Wno-shadow>
  $<$<BOOL:${DUALDAMP_WARNINGS_AS_ERRORS}>:-Werror>)
# What reads, writes and tests computes little: its time is the compiler's, which -O1 costs a third less.
add_library(dualdamp_brief_options INTERFACE)
target_compile_options(dualdamp_brief_options INTERFACE $<$<CONFIG:RelWithDebInfo,Release>:-O1>)
set(DUALDAMP_BRIEF_FOLDERS scenarios bench)

# The engine's loops cross folders: where speed counts, these are optimised at link time, and no others, so that
# linking stays quick. Fat objects keep the installed libraries usable by other compilers, for a third more of the
# compiler's time in these folders. Their loops run over three or four exponentials: vector code and memset for long
# loops only get in the way, and what was stored one by one and is loaded in pairs stops the processor for a dozen
# clock ticks.
option(DUALDAMP_FAT_OBJECTS "Libraries of a Release build serve other compilers than this one too" ON)
set(DUALDAMP_LINK_TIME_FOLDERS core friction_models sim)
set(DUALDAMP_SHORT_LOOPS "-fno-tree-vectorize;-fno-tree-loop-distribute-patterns")
set(DUALDAMP_LINK_TIME "$<AND:$<CXX_COMPILER_ID:GNU>,$<CONFIG:Release>>")
target_link_options(dualdamp_options INTERFACE "$<${DUALDAMP_LINK_TIME}:-flto=auto;-fcx-limited-range;-Wno-stringop-overflow>")

if(DUALDAMP_SANITIZE)
  target_compile_options(dualdamp_options INTERFACE
    -fsanitize=${DUALDAMP_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    # GCC loses track of what instrumentation has initialised.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(dualdamp_options INTERFACE -fsanitize=${DUALDAMP_SANITIZE})
endif()
