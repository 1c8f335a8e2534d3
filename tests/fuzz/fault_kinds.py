"""The kinds of faults of the campaign: how a command meets each, and what it then owes."""

import ctypes
import os
import re
import resource
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from execution import BUG
from fault_commands import files_below

LIBC = ctypes.CDLL(None, use_errno=True)
PATIENCE = 120  # s
NOBODY = 65534


def enter_namespace():
    """A mount namespace of this process alone; false where the system has none for this user."""
    new_namespace, new_users = 0x00020000, 0x10000000
    uid, gid = os.geteuid(), os.getegid()
    if LIBC.unshare(new_namespace | (0 if uid == 0 else new_users)) != 0:
        return False
    if uid != 0:
        Path("/proc/self/setgroups").write_text("deny")
        Path("/proc/self/uid_map").write_text(f"0 {uid} 1")
        Path("/proc/self/gid_map").write_text(f"0 {gid} 1")
    return mount("none", "/", "", 0x4000 | 0x40000, "")  # private: no mount is seen outside


def mount(source, target, kind, flags, data):
    return LIBC.mount(str(source).encode(), str(target).encode(), kind.encode(), flags, data.encode()) == 0


@dataclass
class Trial:
    program: str
    prepared: object
    place: Path
    random: object
    number: int  # chooses the step of a series

    @property
    def command(self):
        return self.prepared.command

    def start(self, arguments=None, **options):
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "stdin": subprocess.DEVNULL, "cwd": self.place}
        return subprocess.Popen([self.program, *(arguments or self.command.arguments)], **{**streams, **options})

    def run(self, arguments=None, **options):
        process = self.start(arguments, **options)
        out, errors = process.communicate(timeout=PATIENCE)
        return End(process.returncode, out or b"", (errors or b"").decode(errors="replace"))

    def files(self):
        return files_below(self.place)


@dataclass
class End:
    status: int
    out: bytes
    errors: str


def faults_of_end(end, statuses):
    found = []
    if end.status not in statuses:
        found.append(f"status {end.status}: {end.errors[-300:]!r}")
    if match := BUG.search(end.errors):
        found.append(f"says {match.group()!r}: {end.errors[-300:]!r}")
    if end.status > 1 and not end.errors.strip():
        found.append(f"status {end.status} without a message")
    return found


def faults_of_files(trial, end, wanted=None, allows_partial=False):
    """`wanted`: the state that each place must have; without it, 'after' where the command succeeded."""
    files = trial.files()
    states = trial.prepared.states(files)
    wanted = wanted or ("after" if end.status in (0, 4) else None)
    if wanted == "before" and trial.command.name == "run several":  # each file for itself
        wanted = None
    found = []
    if any(not state or (wanted and wanted not in state) for state in states):
        found.append(f"the places {trial.command.places} are as {states}, status {end.status}: {end.errors[-300:]!r}")
    strays = [name for name in trial.prepared.strays(files) if not (allows_partial and ".dualdamp.partial" in name)]
    if trial.command.is_campaign and end.status not in (0, 1, 4, 5):  # a campaign goes on with them
        strays = [name for name in strays if not name.endswith(".jsonl")]
    if end.status != 0:  # a directory may have been made before the command ended
        strays = [name for name in strays if not name.endswith("/") or ".dualdamp" in name]
    return found + ([f"left {strays}"] if strays else []) + [f"a case that is not whole: {line}" for line in trial.prepared.damaged_cases(files)]


def faults_of_next_run(trial):
    """The next run, with --resume where there are cases, gives what an undisturbed one gives, and leaves nothing behind."""
    arguments = [word for word in trial.command.arguments if word != "--overwrite" or not trial.command.is_campaign]
    other = trial.command.is_campaign and "--overwrite" in trial.command.arguments and not began_anew(trial)
    end = trial.run([*arguments, *(["--overwrite" if other else "--resume"] if trial.command.is_campaign else [])])
    found = faults_of_end(end, {0, 4})
    found += faults_of_files(trial, end, "after")
    if trial.command.is_campaign and not found:
        for name, content in trial.files().items():
            if name.endswith(".jsonl") and content != trial.prepared.after[name]:
                found.append(f"{name} is another one than of an undisturbed run")
    return [f"the next run: {fault}" for fault in found]


def began_anew(trial):
    """Whether a campaign that discards an earlier one has got to that."""
    return all(content != trial.prepared.before.get(name) for name, content in trial.files().items() if name.endswith(".jsonl"))


def heeds_signals(process):
    """Whether the program has blocked SIGTERM to handle it itself. Before that, while it is loaded, a signal ends it like any program."""
    try:
        text = Path(f"/proc/{process.pid}/status").read_text()
    except OSError:
        return False
    blocked = re.search(r"SigBlk:\s*(\w+)", text)
    return blocked is not None and bool(int(blocked.group(1), 16) >> (signal.SIGTERM - 1) & 1)


def by_signal(trial):
    number = trial.random.choice((signal.SIGINT, signal.SIGTERM, signal.SIGKILL, signal.SIGHUP))
    process = trial.start()
    heeds = True
    if trial.random.random() < 0.7:  # not while the program is loaded
        deadline = time.monotonic() + trial.prepared.seconds
        while process.poll() is None and not heeds_signals(process) and time.monotonic() < deadline:
            time.sleep(0.001)
    after = trial.random.uniform(0, 1.1) * trial.prepared.seconds
    what = f"{number.name} after {after:.4f} s"
    try:
        out, errors = process.communicate(timeout=after)
    except subprocess.TimeoutExpired:
        heeds = heeds_signals(process)
        process.send_signal(number)
        sent = time.monotonic()
        out, errors = process.communicate(timeout=PATIENCE)
        what += f", ended {time.monotonic() - sent:.2f} s later"
    end = End(process.returncode, out, errors.decode())
    is_heeded = heeds and number in (signal.SIGINT, signal.SIGTERM)
    killed = end.status == -number
    found = faults_of_end(end, {0, 4, 130} if is_heeded else {0, 4, 130, -number})
    if end.status == 130 and "interrupted\n" not in end.errors:
        found.append(f"130 without the word interrupted: {end.errors!r}")
    found += faults_of_files(trial, end, allows_partial=killed and not is_heeded)
    if "--isolate-plugins=60" in trial.command.arguments and killed:
        time.sleep(0.2)  # the child is killed when its parent has ended
    return what, end.status, found + faults_of_next_run(trial)


def least_memory(trial, known={}):
    """MB of address space with which the program is loaded."""
    if trial.program not in known:
        def loads(megabytes):
            return subprocess.run([trial.program, "--version"], capture_output=True, check=False, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20,) * 2)).returncode == 0
        known[trial.program] = next(megabytes for megabytes in range(16, 4000) if loads(megabytes))
    return known[trial.program]


def by_memory(trial):
    """From too little for the loader to plenty; the last of 20 steps is 600 MB more than the least."""
    step = trial.number % 20
    more = step / 2 - 1 if step < 10 else 4 * 1.75 ** (step - 10 + trial.random.random())
    limit = int((least_memory(trial) + more) * (1 << 20))
    end = trial.run(preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
    what = f"{limit >> 10} kB of memory"
    if end.status == 127 or "error while loading" in end.errors:  # of the loader
        return what, end.status, faults_of_files(trial, end, "before")
    statuses = {0, 2, trial.command.status}
    found = faults_of_end(end, statuses)
    if end.status == 2 and not any(word in end.errors for word in ("memory", "allocate")):
        found.append(f"no word about memory: {end.errors[-300:]!r}")
    return what, end.status, found + faults_of_files(trial, end, "before" if end.status == 2 else None)


def by_disk(trial):
    """A disk with room for the earlier files and for a part of what the command writes."""
    page = 4096
    if not mount("tmpfs", trial.place, "tmpfs", 0, "size=256m"):
        return "no disk", "no mount", ["a disk cannot be mounted"]
    try:
        subprocess.run(["cp", "-r", f"{trial.prepared.before_folder}/.", str(trial.place)], check=True)
        disk = os.statvfs(trial.place)
        used = (disk.f_blocks - disk.f_bfree) * disk.f_frsize // page
        added = sum(len(content) // page + 2 for name, content in trial.prepared.after.items() if trial.prepared.before.get(name) != content)
        room = trial.random.choice((0, 1, 2, trial.random.randrange(added + 4), trial.random.randrange(added + 4)))
        if not mount("tmpfs", trial.place, "tmpfs", 32, f"size={(used + room) * page}"):  # 32: remount
            return "no disk", "no mount", ["a disk cannot be mounted again"]
        end = trial.run()
        found = faults_of_end(end, {0, 2, trial.command.status})
        if end.status == 2 and not ("No space left" in end.errors and "cannot" in end.errors):
            found.append(f"says neither what nor why: {end.errors[-300:]!r}")
        wanted = "before" if end.status == 2 and "chart.svg" not in end.errors else None
        found += faults_of_files(trial, end, wanted)
        if not mount("tmpfs", trial.place, "tmpfs", 32, "size=256m"):
            found.append("a disk cannot be mounted again")
        if end.status == 2:
            found += faults_of_next_run(trial)
        return f"a disk with {room} free pages of {added}", end.status, found
    finally:
        LIBC.umount2(str(trial.place).encode(), 2)


