"""One execution of the program under limits, and what is wrong with how it ended."""

import json
import os
import re
import resource
import signal
import subprocess
import tempfile
import threading
import time

# Statuses that scenario-format promises; 2 (wrong usage) only where the command line or the place for results is at fault.
ENDS = {0, 1, 3, 4, 5}
NOT_FINITE = re.compile(r"(?:^|[,\s])[-+]?(?:nan|inf|infinity)(?:$|[,\s])", re.IGNORECASE | re.MULTILINE)
BUG = re.compile(r"this is a bug|terminate called|Assertion|Sanitizer|std::|bad_alloc|basic_string|vector::")


class Execution:
    def __init__(self, program, arguments, folder, seconds, memory=None, environment=None, before=None):
        """`seconds` of processor time; `memory`: bytes of address space."""

        def limit():
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            if memory and "DUALDAMP_SANITIZED" not in os.environ:
                resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
            if before:
                before()

        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            started = time.monotonic()
            child = subprocess.Popen([program, *map(str, arguments)], cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                     preexec_fn=limit, env={**os.environ, **(environment or {})}, start_new_session=True)
            # A sleeping program uses no processor time.
            watch = threading.Timer(30 * seconds, child.kill)
            watch.start()
            _, status, usage = os.wait4(child.pid, 0)
            watch.cancel()
            child.returncode = os.waitstatus_to_exitcode(status)
            self.wall = time.monotonic() - started
            self.processor = usage.ru_utime + usage.ru_stime
            self.megabytes = usage.ru_maxrss / 1024
            self.status = child.returncode
            self.is_late = self.status in (-signal.SIGXCPU, -signal.SIGKILL)
            out.seek(0)
            err.seek(0)
            self.stdout = out.read(4_000_000).decode("utf-8", "replace")
            self.stderr = err.read(4_000_000).decode("utf-8", "replace")

    def faults(self, ends=ENDS):
        """Of any execution: signals, statuses that are not promised, words of a bug."""
        found = []
        if self.is_late:
            return [f"out of time: {self.processor:.1f} s of processor time, {self.wall:.1f} s"]
        if self.status < 0:
            found.append(f"ended by signal {-self.status}")
        elif self.status not in ends:
            found.append(f"status {self.status}")
        if match := BUG.search(self.stderr):
            found.append(f"says '{match.group()}'")
        if self.status in ends and self.status not in (0, 1) and not self.stderr.strip():
            found.append(f"status {self.status} without a message")
        return found


# What a refusal may cost. A second on a processor of its own is promised; one that other work shares counts up to three times as much.
# A sanitizer takes several times the time and the memory.
SANITIZED = "DUALDAMP_SANITIZED" in os.environ
SECONDS, MEGABYTES = (30.0, 1000.0) if SANITIZED else (3.0, 100.0)


def faults_of_refusal(execution, names):
    """A refusal is quick, small and says where: every message opens with the name of a file or of an option."""
    found = []
    if execution.processor > SECONDS:
        found.append(f"a refusal took {execution.processor:.1f} s")
    if execution.megabytes > MEGABYTES:
        found.append(f"a refusal took {execution.megabytes:.0f} MB")
    first = execution.stderr.splitlines()[0] if execution.stderr.strip() else ""
    if not any(name in first for name in names):
        found.append(f"the refusal does not say where: {first[:200]!r}")
    if len(execution.stderr) > 400_000:
        found.append(f"a refusal of {len(execution.stderr)} characters")
    return found


def refuse_constant(word):
    raise ValueError(f"holds {word}")


def faults_of_results(folder, status):
    """What lies in the directory of results: documents that parse, tables without a number that is none, nothing half-written."""
    found = []
    if not os.path.isdir(folder):
        return ["status 0 without results"] if status == 0 else []
    names = sorted(os.listdir(folder))
    if status == 0 and "result.json" not in names:
        found.append("status 0 without result.json")
    for name in names:
        path = os.path.join(folder, name)
        if name.endswith(".json"):
            try:
                with open(path, encoding="utf-8") as file:
                    document = json.load(file, parse_constant=refuse_constant)
            except ValueError as error:
                found.append(f"{name}: {error}")
                continue
            if name == "result.json":
                if document["status"] != status:
                    found.append(f"{name} has status {document['status']}")
                if status == 0 and document["result"] is None:
                    found.append("status 0 without a result")
                if status in (2, 3) and document["result"] is not None:
                    found.append(f"status {status} with a result")
        elif name.endswith(".csv"):
            with open(path, encoding="utf-8") as file:
                text = "".join(line for line in file if not line.startswith("#"))
            if match := NOT_FINITE.search(text):
                found.append(f"{name} holds {match.group().strip(', ')!r}")
        elif name != "report.html" and not name.endswith(".jsonl") and not re.fullmatch(r"fitted(_\d+)?\.yaml", name):
            found.append(f"left {name}")
    return found
