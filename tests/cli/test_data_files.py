#!/usr/bin/env python3
"""Broken and hostile data files, through the program: each ends in a clear message with status 3, or is read as stated.

usage: test_data_files.py PROGRAM [TEST...]
"""

import json
import math
import os
import random
import struct
import subprocess
import sys
import tempfile
import threading
import unittest
import zlib
from pathlib import Path

from case import PATIENCE

PROGRAM = str(Path(sys.argv[1]).resolve())

# Coulomb and viscous friction at resonance: laboratory_records.py.
PAIRS = "Y [mm],x [mm]\n4.4,5.787\n4.8,7.454\n5.2,9.122\n5.6,10.790\n"
CONSTANTS = ["--mass", "1.042 kg", "--stiffness", "1568 N/m", "--frequency", "6.1739 Hz"]
QUICK = ["--method", "resonance_least_squares", "--method", "den_hartog_fit"]  # of all methods one takes most of a second


def history(times, form="{:.4f}"):
    return "t,x\n" + "".join(f"{form.format(t)},{i % 7}\n" for i, t in enumerate(times))


def mat4(name, values, imaginary=0, rows=None):
    head = struct.pack("<5i", 0, len(values) if rows is None else rows, 1, imaginary, len(name) + 1)
    return head + name.encode() + b"\0" + struct.pack(f"<{len(values)}d", *values)


def mat5(*elements):
    return b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + b"".join(elements)


def element5(kind, content):
    return struct.pack("<2I", kind, len(content)) + content + bytes(-len(content) % 8)


def array5(kind, shape, name, content):
    head = element5(6, struct.pack("<2I", kind, 0)) + element5(5, struct.pack("<2i", *shape)) + element5(1, name.encode())
    return element5(14, head + content)


def labels5(kind):
    """A history with labels in a compressed cell array of arrays of signed bytes; `kind`: 4 characters, 8 numbers."""
    cells = b"".join(array5(kind, (1, 2), "", element5(1, b"up")) for _ in range(20))
    x = element5(9, struct.pack("<20d", *(i % 7 for i in range(20))))
    packed = [zlib.compress(part) for part in (array5(6, (20, 1), "x", x), array5(6, (1, 1), "dt", element5(9, struct.pack("<d", 0.1))), array5(1, (20, 1), "sweep", cells))]
    return mat5(*(struct.pack("<2I", 15, len(part)) + part for part in packed))


def uff58(kind=1, count=20, values=20, form=2, number="    58"):
    lines = ["    -1", number, "LVDT", "NONE", "NONE", "NONE", "NONE"]
    lines.append(f"{kind:5d}{1:10d}{0:5d}{0:10d} {'NONE':10s}{1:10d}{3:4d} {'NONE':10s}{0:10d}{0:4d}")
    lines.append(f"{form:10d}{count:10d}{1:10d}{0:13.5E}{0.001:13.5E}{0:13.5E}")
    lines.append(f"{17:10d}{0:5d}{0:5d}{0:5d} {'Time':20s} {'s':20s}")
    lines.append(f"{8:10d}{0:5d}{0:5d}{0:5d} {'x':20s} {'m':20s}")
    lines += [f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':20s} {'NONE':20s}"] * 2
    lines += [f"{float(i):13.5E}" for i in range(values)]
    return "\n".join([*lines, "    -1", ""])


EVEN = [i / 1000 for i in range(100)]

# Name: (content, words of the message).
REFUSED = {
    "nothing.csv": ("", "the file holds no header"),
    "blank.csv": ("\n\n  \r\n", "the file holds no header"),
    "header_only.csv": ("Y,x\n", "there is a header and no data below it"),
    "no_header.csv": ("4.4,5.1\n5.0,7.1\n", "the first row holds numbers"),
    "one_column.csv": ("Y\n1\n2\n", "there is no column x"),
    "ragged.csv": ("Y,x\n1,2\n3\n4,5,6\n", "the row does not have as many fields as the header"),
    "nan.csv": ("Y,x\n1,nan\n", "is not a finite number"),
    "infinite.csv": ("Y,x\n1,1e999\n", "is not a finite number"),
    "words.csv": ("Y,x\n1,two\n", "is not a number"),
    "empty_field.csv": ("Y,x\n1,\n", "an empty field"),
    "decimal_comma.csv": ("Y;x\n4,4;5,1\n", "a decimal number with a point, not with a comma"),
    "wrong_unit.csv": ("Y [kg],x\n1,2\n", "the unit of column Y"),
    "no_unit.csv": ("Y [banana],x\n1,2\n", "the unit of column Y"),
    "open_unit.csv": ("Y [mm,x\n1,2\n", "square brackets"),
    "twice.csv": ("Y,x,position\n1,2,3\n", "appears twice"),
    "negative.csv": ("Y,x\n1,-2\n", "is negative"),
    "open_quote.csv": ('Y,x\n1,"2\n', "does not end with its quote"),
    "nul.csv": (b"Y,x\n1,2\n3,\x004\n", "holds a control character"),
    "random.bin": (random.Random(1).randbytes(100_000), "not UTF-8"),
    "workbook.xlsx": (b"PK\x03\x04" + bytes(1000), "a workbook or an archive"),
    "old.xls": (b"\xd0\xcf\x11\xe0" + bytes(1000), "an old Excel workbook"),
    "packed.csv.gz": (b"\x1f\x8b\x08" + bytes(100), "compressed"),
    "labview.tdms": (b"TDSm" + bytes(100), "TDMS"),
    "hdf5.h5": (b"\x89HDF\r\n\x1a\n" + bytes(1000), "no MATLAB file"),
    "unsorted.csv": (history(EVEN[:50] + [0.01] + EVEN[50:]), "the time does not increase"),
    "time_twice.csv": (history(EVEN[:50] + EVEN[49:]), "it appears twice"),
    "torn.csv": (history([t for i, t in enumerate(EVEN) if i % 6]), "no stretch between them is long enough"),
    "short.csv": ("t,x\n0,1\n1,2\n2,3\n", "too short"),
    "no_time.csv": ("x,v\n1,2\n2,3\n", "there is no column t"),
    "sweeps_mixed.csv": ("t,x,sweep\n" + "".join(f"{i},{i},{'ab'[i // 20 % 2]}\n" for i in range(60)), "are not together"),
    "many_rows.csv": ("x\n" + "1\n" * 20_000_001, "more than 20 million rows"),
    "many_columns.csv": (",".join(f"c{i}" for i in range(2000)) + "\n1\n", "more than 1000 fields"),
    "empty.mat": (mat5(), "it holds no variables"),
    "signed_labels.mat": (labels5(4), "save the file without compression (save -v6), or number the tests"),
    "number_labels.mat": (labels5(8), "cellfun(@char, sweep, 'UniformOutput', false), or a vector of numbers"),
    "cut.mat": (mat5(struct.pack("<2I", 14, 5000), bytes(100)), "damaged or cut off"),
    "garbage.mat": (mat5(struct.pack("<2I", 14, 96), random.Random(2).randbytes(96)), "MATLAB file"),
    "cut_73.mat": (b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM" + bytes(384) + b"\x89HDF\r\n\x1a\n" + bytes(20), "damaged or cut off"),
    "complex4.mat": (mat4("x", [0.0] * 40, imaginary=1, rows=20) + mat4("dt", [0.1]), "complex"),
    "cut4.mat": (mat4("x", [0.0] * 20, rows=30), "damaged or cut off"),
    "nan4.mat": (mat4("Y", [1.0, 2.0]) + mat4("x", [1.0, math.nan]), "element 2 of variable 'x'"),
    "ragged4.mat": (mat4("Y", [1.0, 2.0]) + mat4("x", [1.0]), "not of the same length"),
    "cut.uff": (uff58(values=12), "the data set ends after 12 of 20 values"),
    "lies.uff": (uff58(count=-5), "the data set holds no values"),
    "words.uff": (uff58().replace("7.00000E+00", "7,0"), "no number in columns"),
    "spectrum.uff": (uff58(kind=4), "no time response"),
    "no_sets.uff": ("    -1\n   151\nmodel\n    -1\n", "no time response"),
    "cut.uff58b": (uff58(number=f"    58b{1:6d}{2:6d}{11:12d}{80:12d}{0:6d}{0:6d}{0:12d}{0:12d}", values=0)[:-8], "ends before its 20 values"),
}

# Read as stated.
ACCEPTED = {
    "mark.csv": b"\xef\xbb\xbf" + PAIRS.encode(),
    "carriage_returns.csv": PAIRS.replace("\n", "\r"),
    "crlf.csv": PAIRS.replace("\n", "\r\n"),
    "tabs.csv": PAIRS.replace(",", "\t"),
    "semicolons.csv": PAIRS.replace(",", ";"),
    "excel.csv": "sep=;\n" + PAIRS.replace(",", ";"),
    "quoted.csv": '"Y [mm]","x [mm]"\n' + "".join(f'"{a}","{b}"\n' for a, b in (line.split(",") for line in PAIRS.split()[4:])),
    "round_brackets.csv": PAIRS.replace("[", "(").replace("]", ")"),
    "comments.csv": "# instrument 7\n\n" + PAIRS + "\n\n",
    "no_extension": PAIRS,
    "pairs.mat": mat4("Y", [0.004452, 0.005027, 0.005602]) + mat4("x", [0.005117, 0.007143, 0.009667]),
}


class DataFiles(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def identify(self, data, *more, constants=CONSTANTS):
        return subprocess.run(
            [PROGRAM, "identify", str(data), *constants, *more], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE * 60
        )

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def check_refused(self, data, words):
        result = self.identify(data)
        self.assertEqual(result.returncode, 3, result.stdout + result.stderr)
        self.assertIn(words, result.stderr)
        self.assertTrue(result.stderr.startswith(str(data)), result.stderr)
        self.assertLess(len(result.stderr), 20_000)
        self.assertFalse((self.folder / "results").exists())

    def test_there_are_thirty(self):
        self.assertGreaterEqual(len(REFUSED), 30)

    def test_refused(self):
        for name, (content, words) in REFUSED.items():
            with self.subTest(name):
                self.check_refused(self.write(name, content), words)

    def test_a_force_that_takes_energy_out_of_a_fitted_motion_is_refused(self):
        """Pairs under a driving force with phases of the wrong sign, and a friction loop."""
        pairs, loop = ["Y [N],x [m],frequency [Hz],phase [deg]"], ["t [s],x [m],force [N]"]
        for i in range(8):
            omega = 26.0 + 1.7 * i
            needed = complex(1000.0 - omega**2, 4.0 * omega)
            pairs.append(f"3,{3 / abs(needed)!r},{omega / (2 * math.pi)!r},{-math.degrees(math.atan2(needed.imag, needed.real))!r}")
        for i in range(900):
            phase = 0.02 * i
            loop.append(f"{i / 500},{0.01 * math.cos(phase)!r},{math.copysign(1.0, math.sin(phase)) - 3.0 * math.cos(phase)!r}")
        self.write("pairs.csv", "\n".join(pairs) + "\n")
        self.write("loop.csv", "\n".join(loop) + "\n")
        driven = ("pairs.csv", "--mass", "1 kg", "--stiffness", "1000 N/m", "--set", "excitation={type: force_harmonic}")
        for data, cause, remedy in ((driven, "x leads the force in 8 of 8 pairs", "--scale phase=-1"),
                                    (("loop.csv", "--loop"), "friction cannot give energy", "--scale force=-1")):
            with self.subTest(cause):
                def fit(*more):
                    return subprocess.run([PROGRAM, "fit", "coulomb", *data, "--no-profile", *more], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE * 60)
                refused = fit()
                self.assertEqual(refused.returncode, 3, refused.stdout + refused.stderr)
                self.assertTrue(refused.stderr.startswith(data[0]), refused.stderr)
                self.assertIn(cause, refused.stderr)
                self.assertIn(remedy, refused.stderr)
                turned = fit(*remedy.split())
                self.assertNotIn("out of the motion", turned.stderr)

    def test_accepted(self):
        for name, content in ACCEPTED.items():
            with self.subTest(name):
                result = self.identify(self.write(name, content), *QUICK)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
                self.assertNotIn("error", result.stderr)

    def test_a_missing_free_vibration_is_explained(self):
        """A gap in the last swing leaves too little motion before it and the rest behind it: the refusal says so."""
        times = [k / 500 for k in range(1250) if not 40 <= k < 440]
        moved = [40 * math.cos(39 * t) * max(0, 1 - t / 0.7) + 0.02 * math.sin(7919.3 * t * t) for t in times]
        rows = "".join(f"{t:.4f},{x:.4f}\n" for t, x in zip(times, moved))
        options = ["--mass", "1 kg", "--stiffness", "1521 N/m", "--method", "free_decay"]
        said = self.identify(self.write("behind.csv", "t [s],x [mm]\n" + rows), constants=options).stderr
        self.assertIn("no extremes of a free vibration: x does not turn back in 1.618 s, where swings count above", said)
        self.assertIn("; needed are four extremes", said)
        self.assertIn("of 850 rows only the uninterrupted stretch with the most motion is used, 810 rows from t = 0.88 s", said)

    def test_gaps_of_a_labelled_test_explain_a_missing_free_vibration(self):
        times = [k / 500 for k in range(1250) if not 40 <= k < 440]
        moved = [40 * math.cos(39 * t) * max(0, 1 - t / 0.7) + 0.02 * math.sin(7919.3 * t * t) for t in times]
        rows = "".join(f"{t:.4f},{x:.4f},drop\n" for t, x in zip(times, moved))
        options = ["--mass", "1 kg", "--stiffness", "1521 N/m", "--method", "free_decay"]
        said = self.identify(self.write("labelled.csv", "t [s],x [mm],sweep\n" + rows), constants=options).stderr
        self.assertIn("; needed are four extremes, so two periods after a release; test 'drop': the times have gaps: of 850 rows", said)

    def test_a_stated_coordinate_explains_only_dimensions(self):
        constants = ["--mass", "1 kg", "--stiffness", "1 N/m", "--frequency", "1 Hz", "--coordinate", "displacement"]
        said = self.identify(self.write("banana.csv", "Y [mm],x [banana]\n1,2\n"), constants=constants).stderr
        self.assertIn("--unit x=UNIT; the coordinate is a displacement", said)
        said = self.identify(self.write("twice.csv", "Y [mm],x [mm]\num,mm\n1,2\n"), constants=constants).stderr
        self.assertIn("the unit of column Y is stated twice", said)
        self.assertNotIn("the coordinate is", said)

    def test_a_scenario_is_advised_its_keys_and_the_command_line_its_options(self):
        self.write("units.csv", "Y [mm],x [banana]\n1,2\n")
        path = self.write(
            "identify.yaml",
            "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 100 N/m}\n"
            "excitation: {type: base_harmonic, frequency: 1 Hz}\nanalysis: {type: identify, data: units.csv}\n",
        )
        said = subprocess.run([PROGRAM, "run", path], cwd=self.folder, capture_output=True, text=True).stderr
        self.assertIn("in the file as 'x [unit]', or as units: {x: UNIT}", said)
        self.assertNotIn("--unit", said)
        self.assertIn("in the file as 'x [unit]', or as --unit x=UNIT", self.identify("units.csv").stderr)

    def test_gaps_are_told(self):
        times = [t for i, t in enumerate(EVEN) if i not in (10, 11)]
        result = self.identify(self.write("gaps.csv", history(times).replace("t,x", "t,x [mm]")))
        self.assertIn("the uninterrupted stretch with the most motion is used, 88 rows", result.stderr)
        self.assertIn("left out are 10 rows from t = 0 s to", result.stderr)
        self.assertIn("a label in a column sweep", result.stderr)

    def test_a_frequency_that_the_base_does_not_have_is_named(self):
        rows = "".join(f"{i / 500:.3f},{math.sin(37.7 * i / 500 - 1):.6f},{0.2 * math.sin(37.7 * i / 500):.6f}\n" for i in range(1000))
        path = self.write("off.csv", "t [s],x [mm],y [mm]\n" + rows)
        options = ["--mass", "1 kg", "--stiffness", "1421 N/m", "--frequency", "6.12 Hz"]
        said = self.identify(path, "--method", "den_hartog_fit", constants=options).stderr
        self.assertIn("the base moves at 6.00014 Hz, not at 6.12 Hz, 2 % away where at most 1 % is taken for rounding", said)

    def test_a_history_without_x_is_told_once_what_to_do(self):
        rows = "".join(f"{i / 1000:.3f},{math.cos(39.0 * i / 1000) * math.exp(-2 * i / 1000):.6f}\n" for i in range(2000))
        result = self.identify(self.write("v.csv", "t [s],v [m/s]\n" + rows), constants=CONSTANTS[:4])
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertEqual(result.stderr.count("the displacement x was not recorded: record it, or add it to the file as the integral of v or a"), 1)
        self.assertIn("acceleration_velocity_displacement, energy_balance, ", result.stderr)

    def test_what_is_no_file(self):
        self.check_refused(self.folder / "none.csv", "cannot be opened")
        self.check_refused(self.folder, "a directory, not a file")
        link = self.folder / "link.csv"
        link.symlink_to(self.folder)
        self.check_refused(link, "a directory, not a file")
        loop = self.folder / "loop.csv"
        loop.symlink_to(loop)
        self.check_refused(loop, "cannot be opened")
        self.check_refused("/dev/zero", "holds a control character")
        with (self.folder / "sparse.csv").open("wb") as file:
            file.write(b"Y,x\n1,2\n")
            file.truncate(5 << 30)
        self.check_refused(self.folder / "sparse.csv", "larger than 1 GiB: 5120 MiB")

    def through_a_pipe(self, content):
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        writer = threading.Thread(target=pipe.write_bytes, args=[content])
        writer.start()
        result = self.identify(pipe)
        writer.join()
        pipe.unlink()
        return result

    def test_pipes(self):
        self.assertEqual(self.through_a_pipe(PAIRS.encode()).returncode, 0)
        result = self.through_a_pipe(ACCEPTED["pairs.mat"])
        self.assertEqual(result.returncode, 3)
        self.assertIn("cannot be read from a pipe", result.stderr)

    def test_columns_and_units_of_the_caller(self):
        plain = self.write("plain.csv", PAIRS.replace("Y [mm]", "LVDT 1").replace("x [mm]", "LVDT 2"))
        told = self.identify(plain, "--column", "Y=LVDT 1", "--column", "x=2", "--unit", "Y=mm", "--unit", "x=mm", "--json", *QUICK)
        stated = self.identify(self.write("pairs.csv", PAIRS), "--json", *QUICK)
        self.assertEqual(told.returncode, 0, told.stderr)
        estimates = [document[document.index('"estimates"'):document.index('"excluded"')] for document in (told.stdout, stated.stdout)]
        self.assertEqual(*estimates)
        for option in (["--column", "x=LVDT 9"], ["--column", "z=2"], ["--unit", "x=kg"], ["--unit", "x"]):
            self.assertEqual(self.identify(plain, *option).returncode, 3, option)

    def test_uncertainties_are_in_the_intervals(self):
        """Of F0 = k x_f: k by --stiffness, x_f by the gains."""
        data = self.write("pairs.csv", PAIRS)

        def std(*options, stiffness="1568 N/m"):
            constants = ["--mass", "1.042 kg", "--stiffness", stiffness, "--frequency", "6.17 Hz"]
            result = self.identify(data, "--json", "--method", "resonance_least_squares", *options, constants=constants)
            self.assertIn(result.returncode, (0, 4), result.stderr)
            return json.loads(result.stdout)["result"]["estimates"][0]["std"]["F0"]

        exact = std()
        self.assertGreater(std(stiffness="1568 N/m ± 5 %"), exact)
        by_gain = std("--gain-uncertainty", "x=5 %")
        self.assertGreater(by_gain, exact)
        self.assertEqual(std("--scale", "x=1 ± 5 %"), by_gain)
        self.assertEqual(self.identify(data, constants=["--mass", "1 kg ± 5 mm", *CONSTANTS[2:]]).returncode, 3)
        for options in (["--gain-uncertainty", "x=5 mm"], ["--gain-uncertainty", "z=1 %"],
                        ["--scale", "x=1 ± V"], ["--scale", "x=1 ± 1 %", "--gain-uncertainty", "x=1 %"]):
            self.assertEqual(self.identify(data, *options).returncode, 3, options)

    def test_result_directories_keep_inputs_apart(self):
        for day, scale in (("monday", 1.0), ("tuesday", 1.1)):
            (self.folder / day).mkdir()
            rows = [line.split(",") for line in PAIRS.split()[4:]]
            text = "Y [mm],x [mm]\n" + "".join(f"{a},{scale * float(b):.3f}\n" for a, b in rows)
            self.write(f"{day}/run.csv", text)
        first = self.identify("monday/run.csv")
        self.assertNotIn("is replaced", first.stderr)
        tables = {path.name for path in (self.folder / "results/run").glob("*.csv")}
        self.assertNotIn("is replaced", self.identify("monday/run.csv").stderr)  # the same input again
        self.write("results/run/mine.csv", "t,secret\n0,8675309\n")
        told = self.identify("tuesday/run.csv", "--method", "resonance_least_squares")
        self.assertIn("results/run held the result of monday/run.csv, which is replaced", told.stderr)
        written = {line.rsplit("/", 1)[1] for line in told.stderr.splitlines() if line.startswith("wrote ")}
        left = {path.name for path in (self.folder / "results/run").iterdir()}
        self.assertEqual(left, written | {"mine.csv"})
        self.assertLess({name for name in written if name.endswith(".csv")}, tables)
        page = (self.folder / "results/run/report.html").read_text()
        self.assertNotIn("8675309", page)
        self.assertIn("estimates", page)

    def test_damaged_matlab_files_do_no_harm(self):
        """Forty random changes of a sound file: read, or refused with a message; never a crash."""
        sound = ACCEPTED["pairs.mat"]
        generator = random.Random(3)
        for _ in range(40):
            damaged = bytearray(sound)
            for _ in range(generator.randint(1, 4)):
                damaged[generator.randrange(len(damaged))] = generator.randrange(256)
            result = self.identify(self.write("damaged.mat", bytes(damaged)))
            self.assertIn(result.returncode, (0, 3, 4), result.stderr)


if __name__ == "__main__":
    sys.argv[1:2] = []
    unittest.main()
