#!/usr/bin/env python3
"""The committed schema accepts every shipped scenario and refuses every file in tests/invalid.

usage: check_schema.py ROOT
"""

import json
import sys
from pathlib import Path

import jsonschema
import yaml

root = Path(sys.argv[1])
schema = json.loads((root / "scenarios/scenario.schema.json").read_text())
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
faults = []


def files(folder):
    found = sorted((root / folder).glob("*.yaml"))
    if not found:
        faults.append(f"no scenario in {folder}")
    return found


for folder in ["scenarios/paper", "scenarios/examples", "scenarios/stress", "tests/valid"]:
    for path in files(folder):
        for error in validator.iter_errors(yaml.safe_load(path.read_text())):
            faults.append(f"{path}: refused: {list(error.absolute_path)}: {error.message}")

for path in files("tests/invalid"):
    if validator.is_valid(yaml.safe_load(path.read_text())):
        faults.append(f"{path}: accepted")

print("\n".join(faults))
sys.exit(1 if faults else 0)
