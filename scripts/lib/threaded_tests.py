#!/usr/bin/env python3
"""Which tests start a second thread: the argument of `ctest -I` that chooses them.

usage: threaded_tests.py STARTS BUILD OTHER

STARTS: what lib/thread_starts.c has written during the tests of the build directory BUILD. The numbers are those of the same tests in OTHER.
"""

import json
import subprocess
import sys


def tests(build):
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True, text=True).stdout
    return json.loads(shown)["tests"]


def commands_of(starts):
    """Of every test with a second thread: the line of the process that ctest has started."""
    with open(starts, encoding="utf-8", errors="replace") as file:
        for line in file:
            chain = [command.strip() for command in line.rstrip("\n").split("\1")]
            yield from (own for own, parent in zip(chain, chain[1:]) if parent.split(" ")[0].rsplit("/", 1)[-1] == "ctest")


def main():
    starts, build, other = sys.argv[1:]
    threaded = set(commands_of(starts))
    names = {test["name"] for test in tests(build) if " ".join(test["command"]).strip() in threaded}
    if not names:
        sys.exit("threaded_tests: no test starts a thread: was lib/thread_starts.c preloaded?")
    numbers = [str(number) for number, test in enumerate(tests(other), 1) if test["name"] in names]
    print(f"{len(numbers)} of {len(tests(other))} tests start a thread", file=sys.stderr)
    # Start, end and stride of zero: without them ctest runs all tests.
    print("0,0,0," + ",".join(numbers))


if __name__ == "__main__":
    main()
