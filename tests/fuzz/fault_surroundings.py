"""Strange surroundings of a command: closed streams, odd places, small limits, other languages and clocks."""

import os
import resource
import signal
import subprocess
import time
from pathlib import Path

from fault_kinds import LIBC, NOBODY, End, faults_of_end, faults_of_files, mount

JUMPY_CLOCK = r"""
#include <time.h>
#include <sys/syscall.h>
#include <unistd.h>
int clock_gettime(clockid_t id, struct timespec* now) {
  static _Thread_local unsigned calls;
  long result = syscall(SYS_clock_gettime, id, now);
  if (id == CLOCK_REALTIME) now->tv_sec += ++calls % 3 == 0 ? -400000000L : calls % 3 == 1 ? 0 : 4000000000L;
  return (int)result;
}
"""


def closed(*numbers):
    def close():
        for number in numbers:
            os.close(number)
    return close


def limited(what, most):
    return lambda: resource.setrlimit(what, (most, most))


def ordinary(trial, end, found=()):
    """As in any surroundings."""
    faults = faults_of_end(end, {trial.command.status, 0}) + faults_of_files(trial, end, "after")
    return end.status, [*found, *faults]


def refused(trial, end, words, others=()):
    """Either as in any surroundings, or 2 (or one of others) with one of these words, and the results of before."""
    if end.status in (0, trial.command.status):
        return ordinary(trial, end)
    faults = faults_of_end(end, {2, *others})
    if not any(word in end.errors for word in words):
        faults.append(f"none of {words}: {end.errors[-300:]!r}")
    return end.status, faults + faults_of_files(trial, end)


def streams(trial):
    """What cannot be said does not change the files; 2 where standard output is closed or full."""
    number, inherited = subprocess.DEVNULL, {}
    which = trial.random.choice(("stdin", "stdout", "stderr", "all", "full", "full errors", "pipe", "ignored pipe", "pipe of errors"))
    if which in ("stdin", "stdout", "stderr", "all"):
        numbers = {"stdin": [0], "stdout": [1], "stderr": [2], "all": [0, 1, 2]}[which]
        end = trial.run(stdout=number if 1 in numbers else subprocess.PIPE, stderr=number if 2 in numbers else subprocess.PIPE, preexec_fn=closed(*numbers))
    elif which.startswith("full"):
        with open("/dev/full", "w") as full:
            end = trial.run(**{"stderr" if "errors" in which else "stdout": full})
    else:
        reading, writing = os.pipe()
        os.close(reading)
        before = (lambda: signal.signal(signal.SIGPIPE, signal.SIG_IGN)) if "ignored" in which else None
        end = trial.run(**{"stderr" if "errors" in which else "stdout": writing}, preexec_fn=before)
        os.close(writing)
    writes = trial.prepared.stdout != b""
    statuses = {trial.command.status, 0}
    if writes and which in ("stdout", "all", "full", "ignored pipe"):
        statuses = {2}
    elif "pipe" in which and "ignored" not in which:
        statuses.add(-signal.SIGPIPE)
    faults = [] if end.status in statuses else [f"status {end.status}, not of {statuses}: {end.errors[-300:]!r}"]
    if end.status == 2 and end.errors and "standard output" not in end.errors:
        faults.append(f"does not name standard output: {end.errors[-300:]!r}")
    # Of several files, the first that cannot be spoken of ends the program.
    is_cut = end.status == -signal.SIGPIPE and trial.command.name == "run several"
    return f"streams: {which}", end.status, faults + faults_of_files(trial, end, None if is_cut else "after", allows_partial=is_cut)


def limits(trial):
    which = trial.random.choice(("size", "size", "files", "stack", "threads"))
    most = {"size": trial.random.choice((0, 1, 4096, trial.random.randrange(400_000))), "files": trial.random.randrange(3, 14),
            "stack": trial.random.choice((64, 128, 256, 300, 512)) << 10, "threads": trial.random.randrange(6)}[which]
    if which == "threads" and os.geteuid() == 0:
        subprocess.run(["chown", "-R", str(NOBODY), str(trial.place)], check=True)

        def before():
            os.setgid(NOBODY)
            os.setuid(NOBODY)
            limited(resource.RLIMIT_NPROC, most)()
    else:
        kind = {"size": resource.RLIMIT_FSIZE, "files": resource.RLIMIT_NOFILE, "stack": resource.RLIMIT_STACK, "threads": resource.RLIMIT_NPROC}[which]
        before = limited(kind, most)
    end = trial.run(preexec_fn=before)
    what = f"limits: {which} {most}"
    if end.status == 127 and which == "files":  # of the loader
        return what, 127, faults_of_files(trial, end, "before")
    words = {"size": ["File too large"], "files": ["Too many open files"], "stack": ["stack is limited"], "threads": ["Resource temporarily unavailable"]}[which]
    return what, *refused(trial, end, words)


def environment(trial):
    changes = trial.random.choice(({"LANG": "tr_TR.UTF-8", "LC_ALL": "tr_TR.UTF-8"}, {"LC_ALL": "C"}, {"LC_ALL": "xx_YY.none"}, {"LC_ALL": "de_DE.UTF-8", "LC_NUMERIC": "de_DE.UTF-8"},
                                   {"TZ": "Mars/Olympus"}, {"TZ": "XXX+99:99:99"}, {"TMPDIR": "/does/not/exist"}, {"HOME": None}, {"HOME": "/does/not/exist"}, {"PATH": None}, None))
    variables = {} if changes is None else {name: value for name, value in {**os.environ, **changes}.items() if value is not None}
    return f"environment: {changes}", *ordinary(trial, trial.run(env=variables))


def clock(trial, library=[]):
    if not library:
        folder = trial.prepared.before_folder.parent
        (folder / "clock.c").write_text(JUMPY_CLOCK)
        made = subprocess.run(["cc", "-shared", "-fPIC", "-o", str(folder / "clock.so"), str(folder / "clock.c")], check=False, capture_output=True)
        library.append(str(folder / "clock.so") if made.returncode == 0 else "")
    if not library[0] or "DUALDAMP_SANITIZED" in os.environ:  # a sanitizer must be loaded first
        return "clock: not here", None, []
    return "clock: jumps by years", *ordinary(trial, trial.run(env={**os.environ, "LD_PRELOAD": library[0]}))


def stopped(trial):
    """Stopped and continued (Ctrl-Z), and then a window of another size."""
    process = trial.start()
    for _ in range(3):
        time.sleep(trial.random.uniform(0, 0.4) * trial.prepared.seconds)
        process.send_signal(signal.SIGSTOP)
        time.sleep(0.02)
        process.send_signal(signal.SIGCONT)
        process.send_signal(signal.SIGWINCH)
    out, errors = process.communicate(timeout=120)
    return "stopped and continued", *ordinary(trial, End(process.returncode, out, errors.decode()))


def background(trial):
    """A shell without job control starts what is in the background with SIGINT ignored; then it does not end by it."""
    process = trial.start(preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))
    time.sleep(trial.random.uniform(0, 1) * trial.prepared.seconds)
    process.send_signal(signal.SIGINT)
    out, errors = process.communicate(timeout=120)
    return "SIGINT ignored from the start", *ordinary(trial, End(process.returncode, out, errors.decode()))


def places(trial):
    """What vanishes, cannot be written, or is something else."""
    which = trial.random.choice(("vanishes", "vanishes with all", "never there", "read-only", "file", "dangling", "pipe", "full"))
    place = trial.place / trial.command.places[0] if trial.command.places else trial.place / "none"
    if which == "never there":
        command = f'rm -rf "{trial.place}"; exec "$0" "$@"'
        process = subprocess.run(["sh", "-c", command, trial.program, *trial.command.arguments], cwd=trial.place, capture_output=True, check=False)
        trial.place.mkdir()
        end = End(process.returncode, process.stdout, process.stderr.decode())
        faults = faults_of_end(end, {0, 2, 3})
        return "places: no working directory", end.status, faults
    if which.startswith("vanishes"):
        process = trial.start()
        time.sleep(trial.random.uniform(0, 1) * trial.prepared.seconds)
        gone = trial.place if which.endswith("all") else place
        subprocess.run(["rm", "-rf", *([str(path) for path in gone.iterdir()] if gone == trial.place else [str(gone)])], check=False, capture_output=True)
        out, errors = process.communicate(timeout=120)
        end = End(process.returncode, out, errors.decode())
        return f"places: {which}", end.status, faults_of_end(end, {0, 2, 3, trial.command.status})
    if which == "read-only":
        if not mount(trial.place, trial.place, "", 0x1000, "") or not mount("none", trial.place, "", 0x1000 | 32 | 1, ""):
            return "places: no mount", None, []
        try:
            return "places: read-only", *refused(trial, trial.run(), ["Read-only file system"])
        finally:
            LIBC.umount2(str(trial.place).encode(), 2)
    if not trial.command.places or trial.command.name.startswith("report"):
        return "places: none", None, []
    subprocess.run(["rm", "-rf", str(place)], check=True)
    place.parent.mkdir(exist_ok=True)
    if which == "file":
        place.write_text("mine")
    elif which == "dangling":
        place.symlink_to("nowhere")
    elif which == "pipe":
        os.mkfifo(place)
    else:
        place.symlink_to("/dev/full")
    end = trial.run()
    faults = faults_of_end(end, {2})
    if "cannot" not in end.errors:
        faults.append(f"does not say what cannot be done: {end.errors[-300:]!r}")
    if which == "file" and (not place.is_file() or place.read_text() != "mine"):
        faults.append("the file of another is gone")
    if which == "dangling" and (trial.place / place.parent / "nowhere").exists():
        faults.append("wrote through a dangling link")
    return f"places: {which}", end.status, faults


def names(trial):
    """Directories with any name that a file system takes."""
    if "--out" not in trial.command.arguments or trial.command.places != ["out"]:
        return "names: none", None, []
    name = trial.random.choice(("with space", "two\nlines", "µm – 文", "n" * 250, "-dash", "~", "a'b\"c", "tab\there", "$(x)", "%s%n", "\x1b[31m", os.fsdecode(b"\xff\xfe"), "a/../b", "./c//d/"))
    if "--overwrite" in trial.command.arguments or "compare" in trial.command.name:
        name = name.replace("-dash", "dash")
    os.makedirs(Path(trial.place / name).parent, exist_ok=True)
    if trial.command.earlier and "/.." not in name:
        os.rename(trial.place / "out", trial.place / name)
    else:
        subprocess.run(["rm", "-rf", str(trial.place / "out")], check=True)
    arguments = [f"--out={name}" if before == "--out" else word for before, word in zip([None, *trial.command.arguments], trial.command.arguments) if word != "--out"]
    end = trial.run(arguments)
    if Path(trial.place / name).is_dir():
        os.rename(os.path.normpath(trial.place / name), trial.place / "out")
    for left in ("a", "c"):
        subprocess.run(["rm", "-rf", str(trial.place / left)], check=True)
    return f"names: {name!r}", *ordinary(trial, end)


ALL = (streams, streams, limits, limits, limits, environment, environment, clock, stopped, background, places, places, places, names)


def by_surroundings(trial):
    return trial.random.choice(ALL)(trial)
