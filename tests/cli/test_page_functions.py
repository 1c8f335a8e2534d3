#!/usr/bin/env python3
"""How the page of results writes numbers and draws lines, asked of its own functions in a browser.

usage: test_page_functions.py PROGRAM ROOT [TEST...]
"""

import sys
import unittest

from page import PageCase


class Functions(PageCase):
    def test_numbers_lose_no_digit_before_the_point(self):
        numbers = [100000, 123450, 12350, 120, 0, -0.5, 2.5e-7, 1200000]
        five, six = self.ask("formula", f"{numbers}.map((v) => short(v, 5))", "[short(100000), short(320160)]")
        self.assertEqual(five, ["1e+5", "1.2345e+5", "12350", "120", "0", "−0.5", "2.5e-7", "1.2e+6"])
        self.assertEqual(six, ["100000", "320160"])

    def test_the_labels_of_an_axis_differ(self):
        close, around_zero = self.ask("formula", "tickTexts([13.999990, 13.999992, 13.999994, 13.999996])", "tickTexts([-0.2, -5e-17, 0.2])")
        self.assertEqual(close, ["13.99999", "13.999992", "13.999994", "13.999996"])
        self.assertEqual(around_zero, ["−0.2", "0", "0.2"])
        self.assertEqual(self.ask("formula", "tickTexts(ticksOf({ names: ['a', 'b', 'c'] }, [1.5, 3.5], 2), { names: ['a', 'b', 'c'] })"), ["b", "c"])

    def test_counts_that_are_all_zero_have_no_negative_axis(self):
        none, some, equal = self.ask("formula", *(f"extent([{values}], {{ whole: true }})" for values in ("[0, 0, null]", "[0, 2]", "[3, 3]")))
        self.assertEqual([none, equal], [[-0.05, 1.05], [2.95, 4.05]])
        self.assertEqual(some, [-0.1, 2.1])
        self.assertEqual(self.ask("formula", "ticksOf({ whole: true }, extent([[0, 0]], { whole: true }), 5)"), [0, 1])
        self.assertNotIn("−", "".join(self.ask("frequency_branch", '[...document.querySelectorAll("figure")].filter((f) => f.textContent.includes("Stops in a period")).map((f) => [...f.querySelectorAll("svg text")].map((t) => t.textContent).join(" "))')))

    def test_a_curve_of_rounding_errors_is_flat(self):
        asked = [f"extent([[{values}]], {{ isTime: {time} }})" for values, time in (("0.136067937179, 0.1360679371795", "false"), ("-2, -2.000000000001", "false"), ("1, 1.0001", "false"), ("1e9, 1000000010", "true"))]
        positive, negative, resolved, time = self.ask("formula", *asked)
        for found, expected in ((positive, [0.12246, 0.14967]), (negative, [-2.2, -1.8]), (resolved, [0.999995, 1.000105]), (time, [1e9 - 0.5, 1e9 + 10.5])):
            for place, end in zip(found, expected, strict=True):
                self.assertAlmostEqual(place, end, 5)

    def test_a_jump_between_two_samples_is_left_open(self):
        line = self.ask("formula", "broken({ x: [1, 2, 3, 4], y: [0, 0.1, 2, 1.9], colour: 3 })")
        self.assertEqual(line, {"x": [1, 2, None, 3, 4], "y": [0, 0.1, None, 2, 1.9], "colour": 3})

    def test_steady_states_are_joined_in_the_order_of_the_abscissa(self):
        """Level by level, whatever the order of the file; a measurement spreads a level."""
        self.assertEqual(self.ask("formula", "inOrder({ x: [3, 1, 2], y: [30, null, 20], label: 'a' })"), {"x": [1, 2, 3], "y": [None, 20, 30], "label": "a"})
        table = """tables.fit_0_x = { columns: [{ name: "omega", values: [2, 1, 1, 2] }, { name: "Y", values: [5.1, 7, 5, 7.1] }, { name: "measured" }],
                   get: (name) => ({ values: { omega: [2, 1, 1, 2], fitted: [20, 100, 10, 200] }[name] }) }"""
        self.assertEqual(self.ask("formula", f'({table}, curveOf("fit_0_x", "omega", "fitted", {{}}))'), {"label": "fitted", "x": [1, 2, None, 1, 2], "y": [10, 20, None, 100, 200]})
        table = table.replace("omega", "t")
        self.assertEqual(self.ask("formula", f'({table}, curveOf("fit_0_x", "t", "fitted", {{}}).x)'), [2, 1, 1, 2])

    def test_a_point_without_neighbours_is_drawn(self):
        scales = "{ x: (v) => 10 * v, y: (v) => 10 * v }"
        alone, nothing = self.ask("formula", *(f'pathOf({{ kind: "line", x: [1, 2, 3], y: [null, {y}, null] }}, {scales})' for y in (2, "null")))
        self.assertIn("M18,20a2,2", alone)
        self.assertEqual(nothing, "")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
