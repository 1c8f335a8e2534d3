#!/usr/bin/env python3
"""A harness over its seeds and a few thousand mutants of them, without libFuzzer: one fault is a failure.

usage: test_replay.py REPLAY ROOT NAME [MUTANTS] [SEED]
"""

import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import seeds

# A scenario takes half a millisecond, a motion twenty, a process of its own two, the others a tenth.
MUTANTS = {"numbers": 50_000, "units": 50_000, "records": 5_000, "scenario": 1_000, "answers": 5_000, "mat": 1_000, "resume": 1_000, "plugin": 5_000, "engines": 100}


def main():
    program, root, name = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), sys.argv[3]
    mutants = sys.argv[4] if len(sys.argv) > 4 else MUTANTS[name]
    seed = sys.argv[5] if len(sys.argv) > 5 else 1
    with tempfile.TemporaryDirectory() as folder:
        seeds.write_seeds(root, folder)
        if name == "scenario":
            seeds.write_scenario_mutants(root, folder, int(seed), int(mutants))
        for file, content in seeds.shipped_data(root).items():
            Path(folder, file).write_bytes(content)
        arguments = [f"-runs={mutants}", f"-seed={seed}", f"-dict={root / 'tests/fuzz/words.dict'}", f"{name}"]
        result = subprocess.run([program, *arguments], cwd=folder, timeout=3000)
        for path in sorted(Path(folder).glob("crash-input*")):
            print(f"--- {path.name}:\n{path.read_bytes()[:3000]!r}", file=sys.stderr)
        return result.returncode


if __name__ == "__main__":
    sys.exit(main())
