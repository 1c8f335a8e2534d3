"""The end of the interpreter, with results of laws written in Python still there and with threads that still compute."""

import subprocess
import sys

import pytest

LAW = '''
import math, threading, time
import dualdamp as dd

@dd.friction_law
class smooth_coulomb:
    """Coulomb friction without a jump."""
    equation = "F = level tanh(v/speed)"
    parameters = {"level": dd.parameter("N", "force", at_least=0, is_limit=True), "speed": dd.parameter("m/s", "width", above=0)}
    def __init__(self, level, speed):
        self.level, self.speed = level, speed
    def force(self, now):
        return now.limit(self.level) * math.tanh(now.v / self.speed)

@dd.friction_law
class failing:
    """A law that fails."""
    equation = "F = 1/0"
    def force(self, now):
        return 1 / 0

RIG = {"mass": 1.0, "stiffness": 100.0, "damping": 1.0}
rig = dd.System(**RIG, friction=dd.law("smooth_coulomb", level=2, speed="20 mm/s"))
start = {"position": 0.3}
'''

KEPT = {
    "run": "kept = rig.simulate(initial=start, duration=0.1)",
    "threads": 'kept = rig.xy_curve(dd.excitation("base_harmonic", frequency="natural"), amplitudes=[0.1, 0.2], threads=2)',
    "sweep": """
kept = dd.run({"system": rig, "initial": start, "analysis": {"type": "simulate", "duration": 0.1}, "sweep": {"system.friction.level": [1, 2]}})
""",
    "progress": """
class Told:
    def __call__(self, done, all):
        self.kept = kept
kept = Told()
kept.result = rig.xy_curve(dd.excitation("base_harmonic", frequency="natural"), amplitudes=[0.1, 0.2], progress=kept)
""",
    "exception": """
try:
    dd.System(**RIG, friction=dd.law("failing")).simulate(initial=start, duration=0.1)
except dd.NumericalFailure as error:
    kept = error
""",
}


def end_of(script):
    """Standard output and error of a script, which must end with status 0 and its last line."""
    done = subprocess.run([sys.executable, "-c", script + '\nprint("end", flush=True)\n'], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (0, "end\n", "")


@pytest.mark.parametrize("kept", KEPT)
def test_a_result_of_a_python_law_may_live_until_the_interpreter_ends(kept):
    end_of(LAW + KEPT[kept])


@pytest.mark.parametrize("friction", ['"smooth_coulomb", level=2, speed=0.02', '"dahl", kinetic=2, sigma0=2e4'])
def test_daemon_threads_may_compute_until_the_interpreter_ends(friction):
    """Without the cancellation, the first lock that such a thread takes again aborts the process."""
    work = f"""
rig = rig.replace(friction=dd.law({friction}))
def work():
    while True:
        rig.simulate(initial=start, duration=10.0)
for _ in range(2):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.5)
"""
    end_of(LAW + work)
