#!/usr/bin/env python3
"""The tables of a result as a MATLAB file, read by SciPy.

usage: test_mat_file.py PROGRAM [TEST...]
"""

import csv
import json
import unittest

from scipy.io import loadmat

from case import Case

HISTORY = """schema: dualdamp/1
system: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: {law: coulomb, kinetic: 2 N}}
excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}
analysis: {type: simulate, duration: 2 s, sample_rate: 100 Hz}
"""


class MatFile(Case):
    def setUp(self):
        super().setUp()
        (self.folder / "history.yaml").write_text(HISTORY)

    def loaded(self, name):
        return loadmat(self.folder / name, squeeze_me=True, struct_as_record=False)

    def columns(self, name):
        """Heading to fields of a CSV table."""
        with open(self.folder / name, newline="") as file:
            rows = list(csv.reader(line for line in file if not line.startswith("#")))
        return {heading: [row[i] for row in rows[1:]] for i, heading in enumerate(rows[0])}

    def test_every_table_with_every_bit(self):
        result = self.run_program("run", "history.yaml", "--out", "out", "--mat", "files/run.mat")
        self.assertIn("wrote files/run.mat", result.stderr)
        found = self.loaded("files/run.mat")
        for name in ("history", "events"):
            columns = self.columns(f"out/{name}.csv")
            self.assertEqual(len(columns), len(found[name]._fieldnames))
            for heading, fields in columns.items():
                column, unit = heading.removesuffix("]").split(" [") if " [" in heading else (heading, "")
                with self.subTest(table=name, column=column):
                    values = getattr(found[name], column)
                    is_text = column == "kind"
                    self.assertEqual(list(values), fields if is_text else [float(field) for field in fields])
                    stated = getattr(getattr(found["units"], name), column)
                    self.assertEqual("" if len(stated) == 0 else str(stated), unit)
        stored = json.loads((self.folder / "out/result.json").read_text())
        self.assertEqual(json.loads(str(found["provenance"])), stored["provenance"])

    def test_from_an_earlier_run(self):
        self.run_program("run", "history.yaml", "--out", "out", "--mat", "a.mat")
        self.run_program("report", "out", "--mat", "b.mat")
        a, b = ((self.folder / name).read_bytes() for name in ("a.mat", "b.mat"))
        self.assertEqual(a, b)
        # Replaced without a copy: nobody has changed it.
        self.run_program("report", "out", "--mat", "b.mat")
        self.assertFalse((self.folder / "b.mat~").exists())

    def test_names_with_points(self):
        (self.folder / "sweep.yaml").write_text(HISTORY + "sweep: {system.friction.kinetic: [1 N, 2 N]}\n")
        self.run_program("run", "sweep.yaml", "--out", "out", "--mat", "out.mat")
        found = self.loaded("out.mat")["sweep"]
        self.assertIn("system.friction.kinetic [N]", self.columns("out/sweep.csv"))
        self.assertEqual(list(found.system_friction_kinetic), [1.0, 2.0])

    def test_numbers_that_do_not_exist(self):
        (self.folder / "records.csv").write_text("Y [mm],x [mm]\n" + "".join(f"{y},{3 * y - 4}\n" for y in range(3, 11)))
        self.run_program("identify", "records.csv", "--mass", "1 kg", "--stiffness", "100 N/m", "--frequency", "natural", "--out", "out")
        self.run_program("report", "out", "--mat", "out.mat")
        found = self.loaded("out.mat")["estimates"]
        columns = self.columns("out/estimates.csv")
        empty = [value == "" for value in columns["zeta_low"]]
        self.assertIn(True, empty)
        self.assertEqual([value != value for value in found.zeta_low], empty)

    def test_a_file_of_the_user_is_kept(self):
        (self.folder / "mine.mat").write_text("measured last week")
        result = self.run_program("run", "history.yaml", "--out", "out", "--mat", "mine.mat")
        self.assertEqual((self.folder / "mine.mat~").read_text(), "measured last week")
        self.assertIn("mine.mat~", result.stderr)

    def test_refused(self):
        self.assertIn("does not end in .mat", self.run_program("run", "history.yaml", "--mat", "a.h5", status=2).stderr)
        self.assertIn("of one scenario", self.run_program("run", "history.yaml", "other.yaml", "--mat", "a.mat", status=2).stderr)
        self.run_program("run", "history.yaml", "--out", "out")
        table = self.folder / "out/history.csv"
        table.write_text(table.read_text() + "1,2,3,4,5,6\n")
        self.run_program("report", "out", "--mat", "a.mat", status=3)
        self.assertFalse((self.folder / "a.mat").exists())


if __name__ == "__main__":
    unittest.main(argv=[__file__])
