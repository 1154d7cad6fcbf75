# SPDX-License-Identifier: Apache-2.0
"""Cases of cli_test.py: curves fitted to samples."""
import json
from fractions import Fraction

from command import EXAMPLES, Command


class Fit(Command):
    QUARTIC, LOOP = EXAMPLES / "fit/quartic.txt", EXAMPLES / "fit/loop.txt"

    def fitted(self, *words, code=0):
        out = self.dir / "fit.json"
        text = self.expect(code, "fit", words[0], out, *words[1:]).stdout.decode()
        return json.loads(out.read_text())["curves"][0], text

    def at(self, path, t):
        rows = json.loads(self.expect(0, "evaluate", path, "--at", t, "--json", "-").stdout)["values"]
        return [Fraction(x) for x in rows[0]["value"]]

    def test_exact_control_points(self):
        curve, text = self.fitted(self.QUARTIC, "--controls", 5, "--parameters", "given", "--knot-rule", "uniform")
        self.assertIn("9 samples, 5 control points, degree 3, 2 pieces\nexact least-squares curve\n", text)
        # Values over their parameters: the graph (t, value).
        self.assertEqual([[Fraction(str(x)) for x in p] for p in curve["control_points"]],
                         [[Fraction(x) for x in p] for p in ((0, "-177/46688"), ("1/3", "15601/140064"),
                                                            (1, "-104171/140064"), ("5/3", "254203/46688"),
                                                            (2, "746831/46688"))])
        self.assertEqual(curve["knots"], [0, 0, 0, 0, 1, 2, 2, 2, 2])
        for knots in ("0,0,0,0,1,2,2,2,2", self.write("knots.txt", "0 0 0 0  # the begin\n1, 2 2 2 2\n")):
            self.assertEqual(self.fitted(self.QUARTIC, "--parameters", "given", "--knots", knots)[0], curve)
        piped = self.expect(0, "fit", self.QUARTIC, "-", "--parameters", "given", "--knots", "0,0,0,0,1,2,2,2,2")
        self.assertEqual(json.loads(piped.stdout)["curves"][0], curve)
        self.assertIn(b"5 control points", piped.stderr)

    def test_a_polynomial_is_reproduced(self):
        curve, text = self.fitted(self.QUARTIC, "--controls", 7, "--parameters", "given", "--degree", 4)
        self.assertIn("goes through all samples", text)
        self.assertEqual(self.at(self.dir / "fit.json", "1/3"), [Fraction(1, 3), Fraction(1, 81)])

    def test_interpolation(self):
        samples = self.write("five.txt", "0 0 0\n1 2 1/3\n\n3,3,-1 # a comment\n4\t0\t2e-1\r\n5 5 5")
        for words in ((), ("--degree", 2, "--parameters", "chord"), ("--controls", 5, "--knot-rule", "uniform")):
            curve, text = self.fitted(samples, *words)
            self.assertIn("5 samples, 5 control points", text)
            self.assertIn("goes through all samples", text)
            self.assertEqual(len(curve["control_points"][0]), 3)
        self.assertEqual(self.at(self.dir / "fit.json", "1/2"), [1, 2, Fraction(1, 3)])  # the second of five, over [0, 2]

    def test_degree_0_is_steps(self):
        curve, _ = self.fitted(self.write("steps.txt", "0 1\n3 0\n"), "--degree", 0)
        self.assertEqual((curve["knots"], curve["control_points"]), ([0, 1, 2], [[0, 1], [3, 0]]))

    def test_weights(self):
        samples = self.write("weights.txt", "0 0 1\n1/2 3 4\n1 0 1\n")
        curve, _ = self.fitted(samples, "--parameters", "given", "--weights", "--degree", 1, "--controls", 2)
        self.assertEqual(curve["control_points"], [[0, 2], [1, 2]])

    def test_roots(self):
        samples = self.write("roots.txt", "0 0\n1/2*sqrt(2) 1\nsqrt(2) 0\n")
        self.assertIn("goes through all samples", self.fitted(samples, "--degree", 2)[1])
        self.assertIn("proven", self.fitted(samples, "--degree", 2, "--double")[1])
        mixed = self.write("mixed.txt", "0 0\nsqrt(3) 1\nsqrt(2) 0\n")
        self.expect_refusal("fit", mixed, "-", "--degree", 2, names=["mixed.txt:3", "mixed_roots"])

    def test_doubles_are_within_their_bound(self):
        words = (self.LOOP, "--controls", 12, "--parameters", "chord")
        exact, _ = self.fitted(*words)
        rounded, text = self.fitted(*words, "--double")
        bound = Fraction(text.split("proven to be within ")[1].split(" ")[0])
        self.assertLess(bound, Fraction(1, 10**11))
        self.assertEqual(exact["knots"], rounded["knots"])
        for p, q in zip(exact["control_points"], rounded["control_points"]):
            for x, y in zip(p, q):
                self.assertLessEqual(abs(Fraction(str(x)) - Fraction(str(y))), bound)
                self.assertEqual(Fraction(float(Fraction(str(y)))), Fraction(str(y)))  # a double

    def test_what_doubles_cannot_prove_is_undecided(self):
        samples = self.write("near.txt", "0.5 0\n0.501 1\n0.502 0\n0.503 5\n")
        words = (samples, "--parameters", "given", "--knots", "0,0,0,0,1,1,1,1")
        self.assertIn("undecided", self.fitted(*words, "--double", code=3)[1])
        self.assertIn("goes through all samples", self.fitted(*words)[1])
        nearer = self.write("nearer.txt", "0.5 0\n0.500000001 1\n0.500000002 0\n0.500000003 5\n")
        self.expect_refusal("fit", nearer, "-", *words[1:], "--double", names=["exact arithmetic can", "singular_fit"])
        # Interpolation on equal spans grows worse with its length, on averaged knots it does not.
        long = self.write("long.txt", "".join(f"{a * a % 13}\n" for a in range(160)))
        self.assertIn("undecided", self.fitted(long, "--knot-rule", "uniform", "--double", code=3)[1])
        self.assertIn("proven", self.fitted(long, "--double")[1])

    def test_singular_fits_say_where(self):
        samples = self.write("eleven.txt", "".join(f"{a}\n" for a in range(11)))
        for more in ((), ("--double",)):
            self.expect_refusal("fit", samples, "-", "--knots", "0,0,0,0,.01,.02,.03,.04,1,1,1,1", *more,
                                names=["control point 1", "0 to 1/50", "singular_fit"])
        same = self.write("same.txt", "1 0\n1 2\n1 4\n1 6\n")
        self.expect_refusal("fit", same, "-", "--parameters", "given", names=["one parameter", "singular_fit"])
        self.expect_refusal("fit", same, "-", "--parameters", "given", "--knots", "0,0,0,0,2,2,2,2",
                            names=["control points 0 to 1", "have 1", "samples at 1]", "singular_fit"])
        point = self.write("point.txt", "1 1\n" * 5)
        self.expect_refusal("fit", point, "-", "--parameters", "chord", names=["one point", "singular_fit"])

    def test_a_grid_gives_a_patch(self):
        # z = x y^2 on 4 x 5 samples, rows along x
        rows = [(x, Fraction(y, 2), x * Fraction(y, 2) ** 2) for x in range(4) for y in range(5)]
        samples = self.write("grid.txt", "".join(" ".join(map(str, row)) + "\n" for row in rows))
        out = self.dir / "patch.json"
        for words in (("--controls", 2, "--degree", 1, "--controls-v", 3, "--degree-v", 2), (),
                      ("--controls-v", 4, "--degree", 2, "--knot-rule", "averaged")):
            text = self.expect(0, "fit", samples, out, "--grid", 4, *words).stdout.decode()
            self.assertIn("4 x 5 samples", text)
            self.assertIn("goes through all samples", text)
        self.expect(0, "fit", samples, out, "--grid", 4, "--controls", 2, "--degree", 1, "--controls-v", 3, "--degree-v", 2)
        self.assertEqual(self.at(out, "1/3,1/4"), [1, Fraction(1, 2), Fraction(1, 4)])
        self.assertIn("at most", self.expect(0, "fit", samples, out, "--grid", 4, "--controls", 2, "--degree", 1,
                                             "--controls-v", 2).stdout.decode())
        model = self.expect(0, "fit", samples, "-", "--grid", 4, "--degree", 1, "--quiet")
        self.assertEqual(len(json.loads(model.stdout)["patches"]), 1)
        for words, names in ((("--grid", 3), ["3 rows", "20 samples", "wrong_count"]),
                             (("--grid", 20), ["wrong_count"]),
                             (("--grid", 4, "--controls", 5), ["along u", "wrong_count"]),
                             (("--grid", 4, "--controls-v", 3), ["along v", "degree 3", "wrong_count"]),
                             (("--grid", 4, "--double"), ["--grid", "usage"]),
                             (("--controls-v", 4), ["--controls-v", "usage"])):
            self.expect_refusal("fit", samples, "-", *words, names=names)
        self.expect_refusal("fit", self.LOOP, "-", "--grid", 41, names=["three coordinates", "wrong_count"])

    def test_bad_input_is_refused_and_leaves_nothing(self):
        out = self.dir / "out.json"
        for name, text, words, names in (
                ("empty", "# nothing\n", (), ["empty.txt", "empty_input"]),
                ("ragged", "1 2\n3\n", (), ["ragged.txt:2", "wrong_count"]),
                ("four", "1 2 3 4\n", (), ["four.txt:1", "coordinates", "wrong_count"]),
                ("lone", "1\n2\n", ("--parameters", "given"), ["lone.txt:1", "parameter", "wrong_count"]),
                ("word", "0 0\n1 one\n", (), ["word.txt:2", "one", "bad_number"]),
                ("nan", "0 0\n1 nan\n", (), ["nan.txt:2", "bad_number"]),
                ("few", "0 0\n1 1\n2 2\n", (), ["few.txt", "degree 3", "wrong_count"]),
                ("fewer", "0 0\n1 1\n2 2\n", ("--controls", 4), ["4 control points", "wrong_count"]),
                ("huge", "0 0\n1 1\n2 2\n", ("--controls", 200000000), ["200000000", "wrong_count"]),
                ("weight", "0 1\n1 0\n2 1\n", ("--weights", "--degree", 1), ["sample 1", "bad_weight"]),
                ("outside", "0 1\n3 0\n2 1\n", ("--parameters", "given", "--knots", "0,0,1,1", "--degree", 1),
                 ["sample 1", "[0, 1]", "outside_domain"]),
                ("falling", "0 1\n3 0\n", ("--knots", "0,1,0,1", "--degree", 1), ["--knots", "decreasing_knots"]),
                ("knot", "0 1\n3 0\n", ("--knots", "0,0,x,1", "--degree", 1), ["--knots", "bad_number"]),
                ("knots", "0 1\n3 0\n", ("--knots", "0,0,1,1", "--degree", 1, "--controls", 3),
                 ["--knots", "5 knots", "wrong_count"]),
                ("step", "1\n3\n", ("--degree", 0), ["--degree", "usage"])):
            path = self.write(name + ".txt", text)
            self.expect_refusal("fit", path, out, *words, names=names)
            self.assertFalse(out.exists(), name)
        self.expect_refusal("fit", self.dir / "none.txt", out, names=["none.txt", "cannot_open"])
        self.expect_refusal("fit", self.LOOP, self.LOOP, names=["usage"])
        self.expect_refusal("fit", self.LOOP, self.dir / "out.g2", names=["convert", "usage"])
        self.expect_refusal("fit", self.LOOP, out, "--knots", "0,1", "--knot-rule", "uniform", names=["--knot-rule", "usage"])
        self.expect(2, "fit", self.LOOP, out, "--exact", "--double")
        self.expect(2, "fit", self.LOOP, out, "--controls", 0)
        self.expect(2, "fit", self.LOOP, out, "--degree", -1)
        self.assertFalse(out.exists())

    def test_numbers_too_large_for_files_and_empty_fields_are_refused(self):
        big = self.write("big.txt", "0 0\n1 1\n2e400 0\n3 1\n4 0\n")
        self.expect_refusal("fit", big, self.dir / "out.json", names=["2^1000", "bad_number"])
        for text in ("1,,2\n2,,3\n3,,4\n4,,5\n", ",1\n,2\n,3\n,4\n", "1,\n2,\n3,\n4,\n"):
            self.expect_refusal("fit", self.write("empty.txt", text), self.dir / "out.json", names=["empty.txt:1"])
        self.assertFalse((self.dir / "out.json").exists())

    def test_numbers_too_long_for_files_are_refused(self):
        samples = self.write("many.txt", "".join(f"{a * a % 97}.{a * 7919 % 1000003} {a}\n" for a in range(100)))
        self.expect_refusal("fit", samples, "-", "--controls", 60, "--parameters", "chord", names=["--double", "digits"])
        self.assertIn("proven", self.fitted(samples, "--controls", 60, "--parameters", "chord", "--double")[1])
