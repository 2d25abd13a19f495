"""Step time with and without each feature, and over the number of floes: runs gem_bench and writes one CSV row per scene.

usage: python3 scripts/studies scene_bench GEM_BENCH OUTPUT.csv [--filter REGEX]

`least_us` is the fastest of the repetitions, which start from the same state. Ends with the law least_us = c floes^p
fitted to the growth rows.
"""
import argparse
import csv
import json
import math
import subprocess
import tempfile

from real_time_factor import processor


def measure(program, pattern):
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        subprocess.run([program, f"--benchmark_filter={pattern}", f"--benchmark_out={out.name}",
                        "--benchmark_out_format=json"], check=True, stdout=subprocess.DEVNULL)
        text = out.read()
        return json.loads(text) if text.strip() else {"context": {}}


def exponent(rows):
    """Slope and factor of the line through log time over log floes."""
    points = [(math.log(floes), math.log(us)) for floes, us in rows]
    x, y = (sum(p[k] for p in points) / len(points) for k in (0, 1))
    slope = sum((p[0] - x) * (p[1] - y) for p in points) / sum((p[0] - x) ** 2 for p in points)
    return slope, math.exp(y - slope * x)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("output")
    parser.add_argument("--filter", default="^(feature|growth)/")
    options = parser.parse_args()
    result = measure(options.program, options.filter)
    context = result["context"]
    rows, grown = [], []
    for b in result.get("benchmarks", []):
        family, scene = (b["name"].split("/") + [""])[:2]
        if family not in ("feature", "growth"):
            parser.error(f"{b['name']} (neither feature/... nor growth/...); narrow --filter")
        floes = int(scene) if family == "growth" else ""
        rows.append((f"{family}/{scene}", floes, b["least_us"], b["real_time"], b["contacts"], b.get("ns_per_floe", ""),
                     b["label"], context["commit"], context["compiler"], (context.get("load_avg") or [""])[0],
                     processor()))
        if family == "growth":
            grown.append((floes, b["least_us"]))
    if not rows:
        parser.error(f"--filter {options.filter} (no benchmark has such a name); see gem_bench --benchmark_list_tests")
    with open(options.output, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(("scene", "floes", "least_us", "mean_us", "contacts", "ns_per_floe", "state_hash", "commit",
                         "compiler", "load", "processor"))
        writer.writerows(rows)
    if len(grown) > 1:
        slope, factor = exponent(grown)
        print(f"least_us = {factor:.3g} floes^{slope:.3f}")

