#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""table.py [--run BENCH [ARGUMENT…]] FILE.json…

The race as a table, from Google Benchmark's JSON files (several are merged). --run makes the file first, which takes
some minutes: random interleaving, repetitions, all in one run, so that ratios mean something.

    validation/bench/table.py --run build/release/bench run.json
    validation/bench/table.py run.json

Times are medians of the repetitions, in ns of CPU time for each item, of every peer's best variant. In brackets: how many
times slower than ours. Roofline: the larger of the time that our operations need at the peak rate, and of the time that
reading and writing the same numbers takes, both measured in the same run. ulp: our worst error against exact values.
"""
import argparse
import json
import statistics
import subprocess
import sys

OURS = "patchproof"
# workload: (peer whose best variant counts or "all", factor), …; percent of the roofline
TARGETS = {
    "bezier_3x3/scattered/points": ((("OCCT", 22),), 85),
    "bezier_3x3/scattered/first": ((("OCCT", 22),), 85),
    "bezier_3x3/scattered/normals": ((("OCCT", 20),), 85),
    "bezier_3x3/scattered/second": ((("OCCT", 16),), 85),
    "bezier_5x5/scattered/first": ((("OCCT", 25),), 78),
    "bezier_7x7/scattered/first": ((("OCCT", 20),), 78),
    "bspline_20x20/scattered/points": ((("all", 20),), 40),
    "bspline_20x20/scattered/first": ((("all", 18),), 40),
    "bspline_20x20/scattered/second": ((("all", 16),), 40),
    "nurbs_20x20/scattered/points": ((("all", 20),), 45),
    "nurbs_20x20/scattered/first": ((("all", 28),), 45),
    "bspline_20x20/grid/points": ((("SISL", 8), ("OCCT", 30)), 70),
    "bspline_20x20/grid/first": ((("SISL", 8), ("OCCT", 18)), 60),
    "nurbs_20x20/grid/points": ((("SISL", 8), ("OCCT", 30)), 70),
    "nurbs_20x20/grid/first": ((("SISL", 8), ("OCCT", 18)), 60),
    "bspline_20x20/refine_40x40/net": ((("SISL", 3),), None),
    "bspline_20x20/extract/net": ((("SISL", 4.5),), None),
    "curve_100/sorted/points": ((("OCCT", 8),), 65),
    "curve_100/sorted/first": ((("OCCT", 8),), 65),
    "curve_100/scattered/points": ((("Eigen", 16),), None),
    "curve_100/scattered/first": ((("Eigen", 16),), None),
    "nurbs_curve_100/sorted/points": ((("OCCT", 8),), 65),
    "nurbs_curve_100/sorted/first": ((("OCCT", 8),), 65),
    "nurbs_curve_100/scattered/points": ((("Eigen", 16),), None),
    "nurbs_curve_100/scattered/first": ((("Eigen", 16),), None),
}


ARRANGEMENTS, QUANTITIES = ["scattered", "sorted", "grid"], ["points", "first", "normals", "second"]
METHODS = ("accurate", "exact_", "decide/", "roofline/")  # workloads that are no race


def place(workload):
    """Workloads in the order of a reader, whatever the order of the run."""
    parts = (workload.split("/") + ["", ""])[:3]

    def index(names, name):
        return names.index(name) if name in names else len(names)

    return "curve" in parts[0], parts[0], index(ARRANGEMENTS, parts[1]), index(QUANTITIES, parts[2]), workload

# Where methods of our own are compared: (what the workload's name contains, the method, the other one, at most so many
# times as long; below 1: so many times as fast)
METHOD_TARGETS = [
    ("bezier_3x3/accurate", "bounded", "bernstein", 1.4),
    ("bezier_3x3/accurate", "interval", "bernstein", 2.5),
    ("bezier_3x3/accurate", "compensated", "bernstein", 10),
    ("bezier_3x3/accurate", "rounded", "OCCT", 1 / 2.5),
    ("exact_", "fixed width", "scalar double", 20),
    ("decide/D24", "whole", "OCCT", 1 / 90),
    ("decide/D53", "whole", "OCCT", 1 / 90),
    ("decide/R", "whole", "OCCT", 1 / 20),
]


class Row:
    """One benchmark: its times, and the counters of its last repetition."""

    def __init__(self):
        self.times, self.counters = [], {}

    @property
    def ns(self):
        return statistics.median(self.times)


def read(paths):
    rows = {}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            run = json.load(file)
        for b in run["benchmarks"]:
            if b.get("run_type") == "iteration" and not b.get("error_occurred") and b.get("items_per_second"):
                row = rows.setdefault(b["run_name"], Row())
                row.times.append(1e9 / b["items_per_second"])
                row.counters = b
    return rows


def short(peer):
    """OCCT 7.6.3 → OCCT; methods of our own keep their names."""
    name, _, version = peer.partition(" ")
    return name if version[:1].isdigit() else peer


def by_workload(rows):
    """{workload: {peer: {variant: Row}}}. Benchmarks are named WORKLOAD|PEER/VARIANT."""
    table = {}
    for name, row in rows.items():
        workload, bar, contender = name.partition("|")
        if bar:
            peer, _, variant = contender.partition("/")
            table.setdefault(workload, {}).setdefault(short(peer), {})[variant] = row
    return {w: dict(sorted(table[w].items())) for w in sorted(table, key=place)}


def best(variants):
    return min(variants.items(), key=lambda item: item[1].ns) if variants else (None, None)


def number(ns):
    return f"{ns:.2f}" if ns < 20 else f"{ns:.0f}" if ns < 10000 else f"{ns / 1000:.0f}k"


def roofline(table, row, instruction_set):
    """ns for one item, or nothing when the run has no limits."""
    def limit(what):
        entry = table.get("roofline/" + what, {}).get(instruction_set)
        return entry[""].ns if entry else None

    c = row.counters
    fma, divide, root = limit("multiply_add"), limit("divide"), limit("root")
    stores = table.get(f"roofline/traffic_{c.get('in', 0):.0f}_{c.get('out', 0):.0f}")
    if fma is None or stores is None or "operations" not in c:
        return None
    compute = c["operations"] * fma + c["divisions"] * divide + c["roots"] * root
    return max(compute, min(best(v)[1].ns for v in stores.values()))


def contenders(table):
    return [w for w in table if OURS in table[w] and not any(m in w for m in METHODS)]


def race(table):
    workloads = contenders(table)
    peers = sorted({p for w in workloads for p in table[w] if p != OURS})
    print("| workload | ours ns (variant) | " + " | ".join(f"{p} ns" for p in peers) +
          " | over the best | target | % of roofline (target) | worst ulp | AVX2 ns (over the best) |")
    print("|" + "---|" * (len(peers) + 7))
    for w in workloads:
        # What a refinement needs beforehand belongs to its time, as with the peers.
        mine = {v: r for v, r in table[w][OURS].items() if not v.endswith("prepared")}
        variant, ours = best(mine)
        times = {p: best(table[w][p])[1].ns for p in peers if p in table[w]}
        nearest = min(times, key=times.get) if times else None
        cells = [f"{number(times[p])} ({times[p] / ours.ns:.1f}×)" if p in times else "–" for p in peers]
        targets, share = TARGETS.get(w, ((), None))
        marks = []
        for over, factor in targets:
            chosen = [t for p, t in times.items() if over in ("all", p)]
            if chosen:
                reached = min(chosen) / ours.ns
                marks.append(f"{factor}× {'the best' if over == 'all' else over}: {reached:.1f}×"
                             f"{'' if reached >= factor else ' **missed**'}")
        limit = roofline(table, ours, variant.split(" ")[0])
        percent = f"{100 * limit / ours.ns:.0f} %" if limit else "–"
        avx2 = best({v: r for v, r in mine.items() if v.startswith("avx2")})[1]
        print(f"| {w} | {number(ours.ns)} ({variant}) | " + " | ".join(cells) +
              f" | {f'{times[nearest] / ours.ns:.1f}× {nearest}' if nearest else '–'}"
              f" | {'; '.join(marks) or '–'} | {percent}{f' ({share} %)' if share else ''}"
              f" | {ours.counters.get('ulp', float('nan')):.3g}"
              + (f" | {number(avx2.ns)}" + (f" ({times[nearest] / avx2.ns:.1f}×)" if nearest else "") if avx2 else " | –")
              + " |")


def methods(table):
    """Ways of ours beside each other and beside the peers."""
    print("\n| workload | method | ns for each item | target | worst ulp |\n|---|---|---|---|---|")
    for w in table:
        if w.startswith("roofline/") or not any(m in w for m in METHODS):
            continue
        named = {f"{p}/{v}".rstrip("/"): row for p, variants in table[w].items() for v, row in variants.items()}
        for name, row in sorted(named.items(), key=lambda item: item[1].ns):
            marks = []
            for where, method, other, most in METHOD_TARGETS:
                if where not in w or not name.endswith(method):
                    continue
                # Bernstein's basis on the same instruction set; of the other targets the fastest of ours is meant.
                words = name.partition("/")[2].split(" ")
                own = [r.ns for n, r in named.items() if n.endswith(method) and not n.startswith(other)]
                rivals = [r.ns for n, r in named.items()
                          if n.startswith(other) and (other != "bernstein" or n.endswith("/" + words[0]))]
                if rivals and (other == "bernstein" or row.ns == min(own)):
                    took = row.ns / min(rivals)
                    marks.append((f"at most {most:g}× {other}: {took:.2f}×" if most > 1 else
                                  f"{1 / most:.3g}× faster than {other}: {1 / took:.1f}×") +
                                 ("" if took <= most else " **missed**"))
            ulp = row.counters.get("ulp")
            print(f"| {w} | {name} | {number(row.ns)} | {'; '.join(marks) or '–'} | {'–' if ulp is None else f'{ulp:.3g}'} |")


def errors(table):
    """What the peers' results were worth."""
    print("\n| workload | worst errors in ulp |\n|---|---|")
    for w in contenders(table):
        cells = [f"{p} {max(r.counters.get('ulp', 0) for r in v.values()):.3g}" for p, v in table[w].items()]
        print(f"| {w} | {', '.join(cells)} |")


def limits(table):
    print("\n| limit | ns for each item |\n|---|---|")
    for w in table:
        if w.startswith("roofline/"):
            cells = [f"{name} {best(v)[1].ns:.3f}" for name, v in table[w].items()]
            print(f"| {w.removeprefix('roofline/')} | {', '.join(cells)} |")


def others(rows):
    print("\n| other benchmarks | ns for each item | spread |\n|---|---|---|")
    for name, row in sorted(rows.items()):
        if "|" not in name:
            print(f"| {name} | {number(row.ns)} | {max(row.times) / min(row.times):.2f} |")


def run(program, path, arguments):
    command = [program, "--benchmark_enable_random_interleaving=true", "--benchmark_repetitions=7",
               "--benchmark_min_time=0.05", f"--benchmark_out={path}", "--benchmark_out_format=json", *arguments]
    print(" ".join(command), file=sys.stderr)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--run", metavar="BENCH", help="the benchmark program, run first")
    parser.add_argument("files", nargs="+", metavar="FILE.json")
    options, arguments = parser.parse_known_args()
    if options.run:
        run(options.run, options.files[0], arguments)
    elif arguments:
        parser.error("unknown: " + " ".join(arguments))
    rows = read(options.files)
    if not rows:
        sys.exit("table.py: no benchmarks in " + ", ".join(options.files))
    spread = statistics.median(max(r.times) / min(r.times) for r in rows.values())
    repetitions = statistics.median(len(r.times) for r in rows.values())
    print(f"{repetitions:.0f} repetitions; slowest over fastest repetition, median of all rows: {spread:.2f}\n")
    table = by_workload(rows)
    race(table)
    methods(table)
    errors(table)
    limits(table)
    others(rows)


if __name__ == "__main__":
    main()
