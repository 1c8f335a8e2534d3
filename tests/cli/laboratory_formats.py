"""Files as laboratories write them, each with what must come of it: the table of docs/data-files.md.

A row: name of the file, content, options of the command, and either PAIRS or DECAY (the estimate of that record, to the
precision that the file's digits allow) or words of the only refusal.
"""

import math
import random
import struct
import zlib

from laboratory_records import PERIOD, SLOW, decay, mat4, mat5, matrix5, pairs, phases, struct5, table, uff58

PAIRS, DECAY = "pairs", "decay"

MM = [(1e3 * y, 1e3 * x) for y, x in pairs()]
WITH_PHASE = [(*row, phase) for row, phase in zip(MM, phases())]
SI = table("Y [m],x [m]", pairs(), form="{:.9f}")
PLAIN = table("Y [mm],x [mm]", MM)
VOLTS = [(y / 2.5, x / 2.5) for y, x in MM]
STEP = 0.02
HALF = 1 / math.sqrt(1 - SLOW["zeta"] ** 2)  # half a period at 0.5 Hz
TIMES = [STEP * i for i in range(1250)]
X = [round(x, 6) for x in decay(TIMES)]  # of a sensor that shows micrometres: exact numbers take the methods four times as long
ROWS = list(zip(TIMES, [1e3 * x for x in X]))
HISTORY = table("t [s],x [mm]", ROWS)


def clock(seconds, form="{:02d}:{:02d}:{:06.3f}"):
    return form.format(int(seconds // 3600) % 24, int(seconds // 60) % 60, seconds % 60)


def bursts():
    """A serial line hands over three samples every 61 ms: most steps are zero."""
    rows, step = [], 0.061 / 3
    for i in range(1200):
        rows.append((0.061 * (i // 3 + 1), 1e3 * decay([step * i])[0]))
    return table("t [s],x [mm]", rows, form="{:.3f}")


def jitter(stamps_are_right):
    """A loop that is late by up to a third of a step: stamps that tell when, or only when they were written."""
    generator = random.Random(5)
    when = [0.02 * i + generator.uniform(0, 0.0066) for i in range(1200)]
    x = decay(when if stamps_are_right else [0.02 * i for i in range(1200)])
    return table("t [s],x [mm]", [(t, 1e3 * value) for t, value in zip(when, x)], form="{:.7f}")


def tail(growing):
    """Into the noise, where one swing may grow: a door that slams."""
    generator = random.Random(7)
    rows = []
    for t, x in ROWS:
        late = 2.0 * math.sin(2 * math.pi * 0.5 * t) * math.exp(-((t - 22.5) / 1.5) ** 2) if growing else 0.0
        rows.append((t, x + late + generator.gauss(0, 0.05)))
    return table("t [s],x [mm]", rows)


def struck():
    """At rest, then struck: the swings grow before they decay."""
    after = decay([t + 1.0 for t in TIMES])
    rows = [(STEP * i, 0.0) for i in range(100)]
    blow = [after[0] * math.sin(math.pi / 2 * i / 10) ** 2 for i in range(10)]
    return table("t [s],x [mm]", rows + [(STEP * (100 + i), 1e3 * x) for i, x in enumerate(blow + after)])


def lvm():
    head = ("LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\nDecimal_Separator\t.\nTime_Pref\tRelative\nX_Columns\tOne\n"
            "Operator\tlab\nDate\t2026/11/22\nTime\t12:30:01.25\n***End_of_Header***\t\n\t\nChannels\t1\t\nSamples\t1250\t\n"
            "Date\t2026/11/22\t\nTime\t12:30:01.25\t\nX_Dimension\tTime\t\nX0\t0.0E+0\t\nDelta_X\t0.02\t\n***End_of_Header***\t\t\n")
    return head + table("X_Value\tUntitled\tComment", ROWS, "\t")


def lvm_labelled(unit, factor, time="s", seconds=1.0):
    """The units are in the header, as LabVIEW labels them."""
    labels = f"Y_Unit_Label\t{unit}\t\nX_Unit_Label\t{time}\t\nX_Dimension"
    return lvm().split("X_Value", 1)[0].replace("X_Dimension", labels) + table("X_Value\tx\tComment", [(t / seconds, factor * x) for t, x in ROWS], "\t")


def lvm_comma():
    """As LabVIEW writes it on a German system: the header says so itself."""
    head, body = lvm().split("X_Value", 1)
    return head.replace("Decimal_Separator\t.", "Decimal_Separator\t,") + "X_Value" + body.replace(".", ",")


def lvm_without_x():
    """No column of times: the header holds the step."""
    head = lvm().split("X_Value", 1)[0].replace("X_Columns\tOne", "X_Columns\tNo")
    return head + table("X_Value\tx [mm]\tComment", [("", x) for _, x in ROWS], "\t")


def american(seconds):
    """Hours from 1 to 12, with a month before the day."""
    hour = int(seconds // 3600)
    return f"11/22/2026 {(hour - 1) % 12 + 1:d}:{int(seconds // 60) % 60:02d}:{seconds % 60:06.3f} {'AM' if hour < 12 else 'PM'}"


def noisy(step, deviation=0.05):
    """Read by a converter with this step, in mm."""
    generator = random.Random(11)
    return table("t [s],x [mm]", [(t, step * round((x + generator.gauss(0, deviation)) / step)) for t, x in ROWS])


def in_g():
    """x, and its acceleration by second differences."""
    a = [0.0, *((X[i - 1] - 2 * X[i] + X[i + 1]) / STEP**2 for i in range(1, len(X) - 1)), 0.0]
    return table("t [s],x [mm],a [g]", [(t, x, b / 9.80665) for (t, x), b in zip(ROWS, a)])


def packed5(content):
    """An element of MATLAB 7: packed."""
    packed = zlib.compress(content)
    return struct.pack("<2I", 15, len(packed)) + packed


def clipped():
    return table("t [s],x [mm]", [(t, max(-60.0, min(60.0, x))) for t, x in ROWS])


def driven(scale_a=1.0, swap=False):
    """Steady motion at 6 Hz with x, its acceleration and the base; sines are enough for what must be refused."""
    rows = []
    w = 2 * math.pi * 6.0
    for i in range(2000):
        t = i / 1000
        y, x = 5 * math.cos(w * t), 12 * math.cos(w * t - 1.3)
        rows.append((t, x if swap else y, y if swap else x, -w * w * x * 1e-3 * scale_a))
    return table("t [s],y [mm],x [mm],a [m/s^2]", rows)


ACCEPTED = [
    ("metres.csv", SI, [], PAIRS),
    ("commas.csv", PLAIN, [], PAIRS),
    ("semicolons_decimal_comma.csv", table("Y [mm];x [mm]", MM, ";", comma=True), ["--decimal", ","], PAIRS),
    ("tabs.txt", table("Y [mm]\tx [mm]", MM, "\t"), [], PAIRS),
    ("tabs_decimal_comma.txt", table("Y [mm]\tx [mm]", MM, "\t", comma=True), ["--decimal", ","], PAIRS),
    ("quoted_decimal_comma.csv", table("Y [mm],x [mm]", [(f'"{y:.6f}"', f'"{x:.6f}"') for y, x in MM], comma=True).replace('","', '","'), ["--decimal", ","], PAIRS),
    ("blanks.txt", table("Y [mm]   x [mm]", MM, "   "), [], PAIRS),
    ("numpy.txt", "# written by numpy\n# Y_mm x_mm\n" + table("", MM, " ", "{:.12e}"), [], PAIRS),
    ("byte_order_mark.csv", "\ufeff" + PLAIN, [], PAIRS),
    ("two_byte_order_marks.csv", "\ufeff\ufeff" + PLAIN, [], PAIRS),
    ("crlf.csv", PLAIN.replace("\n", "\r\n"), [], PAIRS),
    ("cr.csv", PLAIN.replace("\n", "\r"), [], PAIRS),
    ("latin1_micro.csv", table("Y [µm],x [µm]", [(1e3 * y, 1e3 * x) for y, x in MM]).encode("latin-1"), [], PAIRS),
    ("latin1_degree.csv", table("Y [mm],x [mm],phase [°]", WITH_PHASE).encode("latin-1"), [], PAIRS),
    ("utf16_excel.txt", table("Y [mm]\tx [µm]", [(y, 1e3 * x) for y, x in MM], "\t").encode("utf-16"), [], PAIRS),
    ("utf16_big_endian.csv", ("\ufeff" + PLAIN).encode("utf-16-be"), [], PAIRS),
    ("utf16_without_mark.csv", PLAIN.encode("utf-16-le"), [], PAIRS),
    ("round_brackets.csv", table("Y (mm),x (mm)", MM), [], PAIRS),
    ("unit_row.csv", table("Y;x\nmm;mm", MM, ";"), [], PAIRS),
    ("unit_row_brackets.csv", table("Y,x,note\n[mm],[mm],-", [(*row, "ok") for row in MM]), [], PAIRS),
    ("unit_and_description_rows.csv", table("Y;x\nbase;mass\nmm;mm", MM, ";"), [], PAIRS),
    ("unit_after_underscore.csv", table("Y_mm,x_mm", MM), [], PAIRS),
    ("unit_after_stroke.csv", table("Y / mm;x in mm", MM, ";"), [], PAIRS),
    ("comments.csv", "# rig 3\n% soft spring\n" + PLAIN.replace("\n", "\n# next\n", 3) + "# end\n", [], PAIRS),
    ("metadata_block.csv", "Operator;Sato\nDate;2026-11-22\nTime;12:30\nSample rate;1000\nx;LVDT 7\n\n" + table("Y [mm];x [mm]", MM, ";"), [], PAIRS),
    ("quoted_fields.csv", table('"Y [mm]","x [mm]","note"', [(f'"{y}"', f'"{x}"', '"a, ""b"""') for y, x in MM]), [], PAIRS),
    ("excel_sep.csv", "sep=;\r\n" + table("Y [mm];x [mm]", MM, ";", end="\r\n"), [], PAIRS),
    ("empty_columns.csv", table("Y [mm],,x [mm],,", [(y, "", x, "", "") for y, x in MM]), [], PAIRS),
    ("trailing_separator.csv", table("Y [mm];x [mm];", [(*row, "") for row in MM], ";"), [], PAIRS),
    ("trailing_separator_in_rows.csv", table("Y [mm];x [mm]", [(*row, "") for row in MM], ";"), [], PAIRS),
    ("empty_rows.csv", PLAIN.replace("\n", "\n,\n\n") + ",,\n,,\n", [], PAIRS),
    ("two_columns_note.csv", table("Y [mm],note,x [mm],note", [(y, "a", x, "b") for y, x in MM]), [], PAIRS),
    ("capitals.csv", table("FREQUENCY [Hz],Y [mm],POSITION [mm]", [(6.17393, *row) for row in MM]), [], PAIRS),
    ("header_again.csv", PLAIN[:PLAIN.index("\n", 60) + 1] + PLAIN[:14] + PLAIN[PLAIN.index("\n", 60) + 1:], [], PAIRS),
    ("fortran.txt", table("Y [m] x [m]", [(f"{y:.9E}".replace("E", "D"), f"{x:.9E}".replace("E", "D")) for y, x in pairs()], " "), [], PAIRS),
    ("mils.csv", table("Y [mil],x [in]", [(y / 0.0254, x / 25.4) for y, x in MM], form="{:.9f}"), [], PAIRS),
    ("no_header.csv", table("", [(1, *row) for row in MM]), ["--no-header", "--column", "Y=2", "--column", "x=3", "--unit", "Y=mm", "--unit", "x=mm"], PAIRS),
    ("foreign_names.csv", table("Basis (mm);Weg (mm)", MM, ";"), ["--column", "Y=Basis", "--column", "x=Weg"], PAIRS),
    ("volts.csv", table("Y [V],x [mV]", [(y, 1e3 * x) for y, x in VOLTS]), ["--scale", "x=2.5 mm/V", "--scale", "Y=2.5 mm/V"], PAIRS),
    ("sensitivity.csv", table("Y,x", [(y, 1e3 * x) for y, x in VOLTS]), ["--scale", "x=400 mV/mm", "--scale", "Y=0.4 V/mm"], PAIRS),
    ("percent.csv", table("Y [%],x [%]", [(5 * y, 5 * x) for y, x in MM]), ["--scale", "x=0.2 mm/%", "--scale", "Y=0.2 mm/%"], PAIRS),
    ("history.csv", HISTORY, [], DECAY),
    ("samples_of_a_rate.csv", table("x [mm]", [(x,) for _, x in ROWS]), ["--sample-rate", "50 Hz"], DECAY),
    ("samples_of_a_rate_without_header.csv", table("", [(x,) for _, x in ROWS]), ["--no-header", "--column", "x=1", "--unit", "x=mm", "--sample-rate", "50 Hz"], DECAY),
    ("milliseconds.csv", table("time_ms,x_mm", [(1e3 * t, x) for t, x in ROWS]), [], DECAY),
    ("clock.csv", table("Time,x [mm]", [(clock(45001 + t), x) for t, x in ROWS]), [], DECAY),
    ("midnight.csv", table("Time,x [mm]", [(clock(86390 + t), x) for t, x in ROWS]), [], DECAY),
    ("iso_stamps.csv", table("time,x [mm]", [("2026-11-22T" + clock(45001 + t) + "Z", x) for t, x in ROWS]), [], DECAY),
    ("german_stamps.csv", table("time;x [mm]", [("22.11.2026 " + clock(45001 + t), x) for t, x in ROWS], ";").replace("22.11.2026", "22#11#2026").replace(".", ",").replace("#", "."), ["--decimal", ","], DECAY),
    ("labview.lvm", lvm(), ["--column", "x=Untitled", "--unit", "x=mm"], DECAY),
    ("labview_inches.lvm", lvm_labelled("in", 1 / 25.4), [], DECAY),
    ("labview_milliseconds.lvm", lvm_labelled("mm", 1.0, "ms", 1e-3), [], DECAY),
    ("labview_volts.lvm", lvm_labelled("Volts", 0.4), ["--scale", "x=2.5 mm/V"], DECAY),
    ("gap.csv", table("t [s],x [mm]", ROWS[:1000] + ROWS[1010:]), [], DECAY),
    ("row_twice.csv", table("t [s],x [mm]", ROWS[:500] + ROWS[499:]), [], DECAY),
    ("each_row_twice.csv", table("t [s],x [mm]", [row for row in ROWS for _ in range(2)]), [], DECAY),
    ("coarse_times.csv", table("t [s],x [mm]", [(f"{t:.1f}", x) for t, x in ROWS]), [], DECAY),
    ("bursts.csv", bursts(), [], DECAY),
    ("jitter_of_the_samples.csv", jitter(True), [], DECAY),
    ("jitter_of_the_stamps.csv", jitter(False), [], DECAY),
    ("constant_base.csv", table("t [s],x [mm],y [mm]", [(t, x, 0.0) for t, x in ROWS]), [], DECAY),
    ("held_before.csv", table("t [s],x [mm]", [(t, 1e3 * x) for t, x in zip(TIMES, decay(TIMES, held=3.0))]), [], DECAY),
    ("struck.csv", struck(), [], DECAY),
    ("noise_tail.csv", tail(False), [], DECAY),
    ("growing_tail.csv", tail(True), [], DECAY),
    ("v4.mat", mat4("t", TIMES) + mat4("x", X), [], DECAY),
    ("v4_int16.mat", mat4("Fs", [50.0]) + mat4("adc", [round(x * 3e5) for x in X], 30), ["--column", "x=adc", "--scale", "x=0.00333333 mm"], DECAY),
    ("v5_step_in_milliseconds.mat", mat5(matrix5("dt", [1e3 * STEP]), matrix5("x", X)), ["--unit", "t=ms"], DECAY),
    ("v5_row_vectors.mat", mat5(matrix5("dt", [STEP]), matrix5("x_mm", [1e3 * x for x in X], 1)), [], DECAY),
    ("v5_other_names.mat", mat5(matrix5("Fs", [50.0]), matrix5("LVDT", [x * 1e3 / 2.5 for x in X])), ["--column", "x=LVDT", "--scale", "x=2.5 mm/V"], DECAY),
    ("v5_struct.mat", mat5(struct5("run", [{"x": X, "fs": [50.0]}])), [], DECAY),
    ("v5_two_structs.mat", mat5(matrix5("fs", [50.0]), struct5("a", [{"x": X}]), struct5("b", [{"x": X}])), ["--column", "x=a.x"], DECAY),
    ("v5_matrix.mat", mat5(matrix5("data", TIMES + X, len(X))), ["--column", "t=data(:,1)", "--column", "x=data(:,2)"], DECAY),
    ("v5_transposed.mat", mat5(matrix5("data", [v for pair in zip(TIMES, X) for v in pair], 2)), ["--column", "t=data(1,:)", "--column", "x=data(2,:)"], DECAY),
    ("two_decays.csv", HISTORY + table("t [s],x [mm]", [(t, -1e3 * x) for t, x in zip(TIMES, decay(TIMES, start=0.08))]), [], DECAY),
    ("decays_one_below_the_other.csv", HISTORY + table("", [(t, 1e3 * x) for t, x in zip(TIMES, decay(TIMES, start=0.12))]), [], DECAY),
    ("extremes_of_three_decays.csv", table("sweep,t [s],x [mm]", [(f"run {k}", t, 1e3 * decay([t], start=0.1 + 0.01 * k)[0]) for k in range(3) for t in [i * HALF for i in range(12)]]), [], DECAY),
    ("curly_brackets.csv", table("Y {mm},X <mm>", MM), [], PAIRS),
    ("zero_far_off.csv", table("t [s],x [mm]", [(t, x + 250.0) for t, x in ROWS]), [], DECAY),
    ("numbers_of_samples_scaled.csv", table("t,x [mm]", [(i, x) for i, (_, x) in enumerate(ROWS)]), ["--scale", "t=0.02"], DECAY),
    ("universal.uff", uff58("x", [1e3 * x for x in X], STEP, "mm"), [], DECAY),
    ("universal_milliseconds.uff", uff58("x", X, 1e3 * STEP, time_unit="ms"), [], DECAY),
    ("universal_times_without_unit.uff", uff58("x", X, 1e3 * STEP, time_unit="NONE"), ["--unit", "t=ms"], DECAY),
    ("excel_german.csv", "\ufeff" + table("Y [mm];x [mm];", [(*row, "") for row in MM], ";", end="\r\n", comma=True), ["--decimal", ","], PAIRS),
    ("excel_german_unit_row.csv", "\ufeffsep=;\r\n" + table("Y;x\r\n[mm];[mm]", MM, ";", end="\r\n", comma=True), ["--decimal", ","], PAIRS),
    ("decimal_comma_exponents.csv", table("Y [m];x [m]", pairs(), ";", "{:.9E}", comma=True), ["--decimal", ","], PAIRS),
    ("mixed_line_ends.csv", PLAIN.replace("\n", "\r\n", 3), [], PAIRS),
    ("old_mark_of_the_end.csv", PLAIN.encode() + b"\x1a", [], PAIRS),
    ("hard_blanks.csv", table("Y\u00a0[mm];\u00a0x\u00a0[mm]", [(f"{y:.6f}\u00a0", f"{x:.6f}") for y, x in MM], ";"), [], PAIRS),
    ("greek_mu.csv", table("Y [\u03bcm],x [\u00b5m]", [(1e3 * y, 1e3 * x) for y, x in MM]), [], PAIRS),
    ("other_script.csv", table("\u57fa\u5ea7 [mm],\u4f4d\u79fb [mm]", MM), ["--column", "Y=\u57fa\u5ea7", "--column", "x=\u4f4d\u79fb"], PAIRS),
    ("minus_of_typography.csv", table("t [s],x [mm]", [(t, f"{x:.6f}".replace("-", "\u2212")) for t, x in ROWS]), [], DECAY),
    ("aligned_columns.txt", "".join(f"{a:>16}{b:>16}\n" for a, b in [("Y_mm", "x_mm"), *[(f"{y:.6f}", f"{x:.6f}") for y, x in MM]]), [], PAIRS),
    ("labels_with_blanks.csv", table("sweep,Y [mm],x [mm]", [('"sweep up, 1"', *row) for row in MM]), [], PAIRS),
    ("phase_in_degrees.csv", table("Y [mm],x [mm],phase (deg)", WITH_PHASE), [], PAIRS),
    ("minutes.csv", table("t [min],x [mm]", [(t / 60, x) for t, x in ROWS], form="{:.9f}"), [], DECAY),
    ("microseconds.csv", table("t [us],x [mm]", [(f"{round(1e6 * t)}", x) for t, x in ROWS]), [], DECAY),
    ("seconds_since_1970.csv", table("t [s],x [mm]", [(f"{1795350601 + t:.3f}", x) for t, x in ROWS]), [], DECAY),
    ("peaks.csv", table("Y [mm peak],x [mm 0-pk]", MM), [], PAIRS),
    ("peak_to_peak_halved.csv", table("Y [mmpp],x (mm pk-pk)", [(2 * y, 2 * x) for y, x in MM]), ["--scale", "Y=0.5", "--scale", "x=0.5"], PAIRS),
    ("effective_volts_scaled.csv", table("Y [mm],x [Vrms]", [(y, x / 2.5 / math.sqrt(2)) for y, x in MM], form="{:.9f}"), ["--scale", "x=3.5355339 mm/V", "--unit", "x=V"], PAIRS),
    ("days_of_a_spreadsheet.csv", table("t [day],x [mm]", [(f"{46348.5208 + t / 86400:.9f}", x) for t, x in ROWS]), [], DECAY),
    ("american_stamps.csv", table("time,x [mm]", [(american(45001 + t), x) for t, x in ROWS]), [], DECAY),
    ("stamps_with_zone.csv", table("time,x [mm]", [("2026-11-22T" + clock(45001 + t) + "+01:00", x) for t, x in ROWS]), [], DECAY),
    ("stamps_of_whole_seconds.csv", table("time,x [mm]", [(clock(45001 + int(t), "{:02d}:{:02d}:{:02d}"), x) for t, x in ROWS]), [], DECAY),
    ("bars.txt", "| Y [mm] | x [mm] |\n|---|---|\n" + "".join(f"| {y:.6f} | {x:.6f} |\n" for y, x in MM), [], PAIRS),
    ("acceleration_in_g.csv", in_g(), [], DECAY),
    ("ten_bits.csv", noisy(0.2), [], DECAY),
    ("labview_comma.lvm", lvm_comma(), ["--decimal", ",", "--column", "x=Untitled", "--unit", "x=mm"], DECAY),
    ("v7_packed_struct.mat", mat5(packed5(struct5("run", [{"x": X, "fs": [50.0]}]))), [], DECAY),
]

REFUSED = [
    ("v5_endless_times.mat", mat5(matrix5("dt", [1e308]), matrix5("x_mm", [1e3 * x for x in X])), [], "element 3 of t leaves the range of double precision"),
    ("v5_two_rates.mat", mat5(matrix5("dt", [0.02]), matrix5("fs", [60.0]), matrix5("x_mm", [1e3 * x for x in X])), [], "dt and the sample rate contradict each other"),
    ("v5_no_rate.mat", mat5(matrix5("fs", [1e-320]), matrix5("x_mm", [1e3 * x for x in X])), [], "element 1 of t leaves the range of double precision"),
    ("v5_beyond_the_range.mat", mat5(matrix5("fs", [50.0]), matrix5("x_Mm", [1e305, *X[1:]])), [], "element 1 of x leaves the range of double precision"),
    ("unit_in_the_heading_and_another_below.csv", table("Y [mm],x [mm]\num,mm", MM), [], "the unit of column Y is stated twice"),
    ("decimal_comma.csv", table("Y [mm];x [mm]", MM, ";", comma=True), [], "for decimal commas --decimal ,"),
    ("decimal_comma_with_commas.csv", table("Y [mm],x [mm]", MM, comma=True), [], "the row does not have as many fields as the header"),
    ("decimal_point_told_comma.csv", PLAIN.replace(",", ";"), ["--decimal", ","], "with a comma, the decimal mark that is stated"),
    ("thousands.csv", table("Y [um];x [um]", [(f"{1e3 * y:,.1f}", f"{1e3 * x:,.1f}") for y, x in MM], ";"), [], "without thousands separators"),
    ("nan.csv", PLAIN.replace(PLAIN.split("\n")[3].split(",")[1], "NaN"), [], "is not a finite number"),
    ("spreadsheet_error.csv", PLAIN.replace(PLAIN.split("\n")[3].split(",")[1], "#DIV/0!"), [], "is not a number"),
    ("empty_cell.csv", PLAIN.replace(PLAIN.split("\n")[3].split(",")[1], ""), [], "an empty field"),
    ("unit_in_the_field.csv", table("Y,x", [(f"{y} mm", f"{x} mm") for y, x in MM]), ["--unit", "Y=mm", "--unit", "x=mm"], "its unit belongs into the heading"),
    ("percent_in_the_field.csv", table("Y [mm],x", [(y, f"{x}%") for y, x in MM]), ["--unit", "x=mm"], "without percent sign"),
    ("twelve_words.csv", "Y [mm],x [mm]\n" + "4.4,oops\n" * 12, [], "the same in 11 more rows (lines 3, 4, 5, 6, 7, ...)"),
    ("twice_x.csv", table("Y [mm],x [mm],x [mm]", [(y, x, x) for y, x in MM]), [], "column x appears twice"),
    ("ragged.csv", PLAIN + "4.4\n", [], "the row does not have as many fields as the header"),
    ("no_header_not_told.csv", table("", MM), [], "or --no-header with --column"),
    ("no_header_numbered_columns.csv", table("", MM), ["--column", "Y=1", "--column", "x=2", "--unit", "Y=mm", "--unit", "x=mm"], "the first row holds numbers"),
    ("empty_unit.csv", PLAIN, ["--unit", "x="], "the unit that is stated for column x is empty"),
    ("time_backwards.csv", table("t [s],x [mm]", ROWS[::-1]), [], "the time runs backwards"),
    ("placeholders.csv", table("t [s],x [mm]", [(t, -9999 if i in (300, 700) else x) for i, (t, x) in enumerate(ROWS)]), [], "measured nothing; the same in 1 more row (line 702)"),
    ("one_phase_missing.csv", table("Y [mm],x [mm],phase [deg]", [(y, x, -999 if i == 2 else phase) for i, (y, x, phase) in enumerate(WITH_PHASE)]), [], "the phase of pair 3, -999 deg, is no lag"),
    ("input.csv", table("Y_in,x_out", MM), ["--column", "x=x_out"], "may mean inches or an input"),
    ("times_of_day_in_milliseconds.csv", table("t [ms],x [mm]", [(clock(45001 + t), x) for t, x in ROWS]), [], "column t holds time stamps"),
    ("sound.wav", b"RIFF" + bytes(200), [], "the file is a sound"),
    ("no_header_no_columns.csv", table("", MM), ["--no-header"], "without a header the columns have no names"),
    ("foreign_names_not_told.csv", table("Basis (mm);Weg (mm)", MM, ";"), [], "there are the columns 'Basis (mm)', 'Weg (mm)'"),
    ("transposed.csv", table("", [("Y [mm]", *[y for y, _ in MM]), ("x [mm]", *[x for _, x in MM])]), [], "rows and columns are exchanged"),
    ("unknown_unit.csv", table("Y [mm],x [banana]", MM), [], "the unit of column x"),
    ("other_dimension.csv", table("Y [mm],x [N]", MM), [], "is not a unit of a length"),
    ("volts_without_scale.csv", table("Y [mm],x [V]", MM), [], "a voltage of a sensor needs a scale, as --scale x='2.5 m/V'"),
    ("scale_of_nothing.csv", PLAIN, ["--scale", "x=2.5 kg/V"], "the scale of column x does not lead to a length"),
    ("no_unit_millimetres.csv", table("Y,x", MM), [], "no unit is stated for x; in metres it would reach"),
    ("numbers_of_samples.csv", table("t,x [mm]", [(i, x) for i, (_, x) in enumerate(ROWS)]), [], "not numbers of samples"),
    ("unit_of_no_column.csv", PLAIN, ["--unit", "phase=deg"], "a unit is stated for column phase, and the file has no such column"),
    ("no_unit_milliseconds.csv", table("t,x [mm]", [(1e3 * t, x) for t, x in ROWS]), [], "these may be in ms"),
    ("phase_without_unit.csv", table("Y [mm],x [mm],phase", [(*row, 90.0) for row in MM]), [], "an angle needs its unit"),
    ("phase_without_unit.mat", mat4("Y", [y for y, _ in pairs()]) + mat4("x", [x for _, x in pairs()]) + mat4("phase", [1.57] * 6), [], "an angle needs its unit"),
    ("phase_in_degrees_called_rad.csv", table("Y [mm],x [mm],phase [rad]", [(*row, 90.0) for row in MM]), [], "the phases may be degrees"),
    ("phase_in_radians_called_deg.csv", table("Y [mm],x [mm],phase [deg]", [(*row, 1.5708) for row in MM]), [], "the phases may be radians"),
    ("frequency_without_unit.csv", table("Y [mm],x [mm],frequency", [(*row, 6.17) for row in MM]), [], "Hz and rad/s differ by 2 pi"),
    ("swapped_pairs.csv", table("x [mm],Y [mm]", MM), [], "x and Y seem to be swapped"),
    ("swapped_histories.csv", driven(swap=True), ["--frequency", "6 Hz"], "out of the motion: x and Y (x and y) are swapped\n"),
    ("a_by_1000.csv", driven(1e3), ["--frequency", "6 Hz"], "column a is about 1000 times too large for column x"),
    ("a_in_g.csv", driven(1 / 9.80665), ["--frequency", "6 Hz"], "column a is about 9.807 times too small for column x"),
    ("clipped.csv", clipped(), [], "x is clipped"),
    ("constant.csv", table("t [s],x [mm]", [(t, 5.0) for t in TIMES]), [], "x is constant"),
    ("time_back.csv", table("t [s],x [mm]", ROWS[:500] + ROWS[300:]), [], "the time does not increase"),
    ("time_twice.csv", table("t [s],x [mm]", ROWS[:500] + [(ROWS[499][0], 3.0)] + ROWS[500:]), [], "it appears twice"),
    ("torn.csv", table("t [s],x [mm]", [row for i, row in enumerate(ROWS) if i % 40 < 8]), [], "no stretch between them is long enough"),
    ("samples_of_no_rate.csv", table("x [mm]", [(x,) for _, x in ROWS]), [], "samples with their times t, or with their rate, as --sample-rate '1 kHz'"),
    ("signals_of_no_rate.csv", table("x [mm],v [mm/s]", [(x, 0.0) for _, x in ROWS]), [], "or samples of one rate, with --sample-rate '1 kHz'"),
    ("rate_beside_times.csv", HISTORY, ["--sample-rate", "50 Hz"], "--sample-rate '50 Hz' is stated, and the file has times t"),
    ("rate_beside_levels.csv", PLAIN, ["--sample-rate", "50 Hz"], "the file has amplitudes Y, which are no samples"),
    ("samples_without_times.csv", table("x [mm]", [(x,) for _, x in ROWS if x > 0][:20]), [], "extremes of a free vibration alternate"),
    ("missing_variable.mat", mat5(matrix5("qm", X), matrix5("Fs", [50.0])), [], "qm (1250 x 1)"),
    ("matrix.mat", mat5(matrix5("data", TIMES + X, len(X))), [], "data(:,2)"),
    ("packed.csv.gz", b"\x1f\x8b\x08" + bytes(100), [], "the file is compressed (gzip)"),
    ("workbook.xlsx", b"PK\x03\x04" + bytes(1000), [], "the file is a workbook"),
    ("lines.json", '{"Y": [1, 2], "x": [2, 3]}', [], "the file is JSON"),
    ("rig.yaml", "# A rig.\n\nschema: dualdamp/1\nsystem: {mass: 1 kg}\n", [], "the file is a scenario"),
    ("rows_with_another_separator.csv", "Y [mm],x [mm]\n" + table("", MM, ";"), [], "separated as those of the header"),
    ("capital_units.csv", table("Y [mm],x [MM]", MM), [], "did you mean 'mm'?"),
    ("page.csv", "<!DOCTYPE html><html><body>404</body></html>", [], "the file is a page of the web"),
    ("control.csv", b"Y,x\n1,\x002\n", [], "control character"),
    ("infinity.csv", PLAIN.replace(PLAIN.split("\n")[3].split(",")[1], "-Inf"), [], "is not a finite number"),
    ("windows_nan.csv", PLAIN.replace(PLAIN.split("\n")[3].split(",")[1], "-1.#IND"), [], "is not a number"),
    ("overload.csv", PLAIN.replace(PLAIN.split("\n")[3].split(",")[1], "OVERLOAD"), [], "is not a number"),
    ("fortran_overflow.txt", PLAIN.replace(",", " ").replace(" [mm]", "_mm").replace(PLAIN.split("\n")[3].split(",")[1], "*********"), [], "is not a number"),
    ("fortran_exponent_without_letter.txt", table("Y_m x_m", [(f"{y:.6E}".replace("E-0", "-00"), f"{x:.6E}".replace("E-0", "-00")) for y, x in pairs()], " "), [], "is not a number"),
    ("thousands_blanks.csv", table("Y [um];x [um]", [(f"{1e3 * y:,.1f}".replace(",", " "), f"{1e3 * x:,.1f}".replace(",", " ")) for y, x in MM], ";"), [], "thousands"),
    ("thousands_apostrophes.csv", table("Y [um];x [um]", [(f"{1e3 * y:,.1f}".replace(",", "'"), f"{1e3 * x:,.1f}".replace(",", "'")) for y, x in MM], ";"), [], "thousands"),
    ("thousands_points.csv", table("Y [um];x [um]", [(f"{1e3 * y:,.1f}".translate(str.maketrans(",.", ".,")), f"{1e3 * x:,.1f}".translate(str.maketrans(",.", ".,"))) for y, x in MM], ";"), ["--decimal", ","], "thousands"),
    ("missing_sample.csv", table("t [s];x [mm]", [(t, "" if i == 100 else x) for i, (t, x) in enumerate(ROWS)], ";"), [], "an empty field"),
    ("peak_to_peak.csv", table("Y [mm],x [mm p-p]", MM), [], "column x is peak to peak by its heading, and an amplitude is half of peak to trough\n"),
    ("effective_values.csv", table("Base_rms,Mass_rms", MM), ["--column", "Y=Base_rms", "--column", "x=Mass_rms", "--unit", "Y=mm", "--unit", "x=mm", "--scale", "Y=1.41421"], "column x is rms values by its heading"),
    ("effective_volts.csv", table("Y [mm],x [Vrms]", MM), ["--scale", "x=2.5 mm/V"], "a scale that contains the factor 1.41421, beside the unit of the signal, --unit x=V"),
    ("amplitudes_of_a_force.csv", table("f [Hz],F [N],x [mm]", [(6.17, *row) for row in MM]), [], "acts as a base that moves by F/k: for k = 2000 N/m --column Y=FORCE, --scale Y='0.0005 m/N'"),
    ("amplitudes_of_a_force_as_Y.csv", table("Y [N],x [mm]", MM), [], "acts as a base that moves by F/k: for k = 2000 N/m --scale Y='0.0005 m/N'"),
    ("names_of_another_language.csv", table("Zeit [s];Weg in mm", ROWS, ";"), [], "did you mean '--column t=Zeit --column x=Weg'?"),
    ("labview_volts_alone.lvm", lvm_labelled("Volts", 0.4), [], "'Volts' is not a unit of a length"),
    ("labview_without_x.lvm", lvm_without_x(), [], "X_Columns"),
    ("header_alone.csv", "Y [mm],x [mm]\n", [], "no data below it"),
    ("empty.csv", "", [], "empty"),
    ("truths.csv", PLAIN.replace(PLAIN.split("\n")[3].split(",")[1], "TRUE"), [], "is not a number"),
    ("rows_in_quotes.csv", "".join(f'"{line}"\n' for line in PLAIN.splitlines()), [], "the whole row is in quotes"),
    ("padded_with_zeros.csv", PLAIN.encode() + bytes(512), [], "control character"),
    ("index.tdm", '<?xml version="1.0" encoding="UTF-8" standalone="no" ?>\n<usi:tdm xmlns:usi="http://www.ni.com/Schemas/USI/1_0" version="1.0">\n</usi:tdm>\n', [], "XML"),
    ("groups.tdms", b"TDSm" + bytes(200), [], "TDMS"),
    ("binary_of_a_scope.bin", bytes(range(256)) * 8, [], "error"),
    ("modes.uff", "    -1\n    55\nmode 1\n    -1\n", [], "no time response"),
]

assert PERIOD > 0 and SLOW["mass"] > 0
