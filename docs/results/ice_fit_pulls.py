#!/usr/bin/env python3
"""Does floe fit-ice give back what was put into the ice? Twelve flashers, ten layers, three factors each.

  ice_fit_pulls.py make ICE            writes true-ice/, runs.toml and truth.json
  floe simulate --flashers runs.toml --ice true-ice --oversize 16 --seed 77 -o runs.h5
  floe fit-ice runs.h5 --ice ICE --fit absorption,scattering,birefringence --layers 10 --depths 1520,2370 \\
      --light 2 --least-hits 20000 -o fitted --json fitted.json
  ice_fit_pulls.py judge fitted.json   prints every factor beside the truth
"""
import json
import math
import random
import shutil
import sys
from pathlib import Path

TOP, BOTTOM, LAYERS, WIDTH = 1520, 2370, 10, 0.15
STRINGS = [63, 55, 38, 47, 28, 71, 21, 36, 45, 59, 26, 52]
COLUMNS = {"absorption": 2, "scattering": 1, "birefringence": 6}  # of icemodel.dat


def make(ice):
    draw = random.Random(12)
    truth = {name: [math.exp(draw.gauss(0, WIDTH)) for _ in range(LAYERS)] for name in COLUMNS}
    shutil.copytree(ice, "true-ice")
    rows = []
    for line in Path(ice, "icemodel.dat").read_text().splitlines():
        words = line.split()
        layer = math.floor((float(words[0]) - TOP) / (BOTTOM - TOP) * LAYERS)
        layer = min(max(layer, 0), LAYERS - 1)
        for name, column in COLUMNS.items():
            words[column] = repr(float(words[column]) * truth[name][layer])
        rows.append(" ".join(words))
    Path("true-ice", "icemodel.dat").write_text("\n".join(rows) + "\n")
    Path("truth.json").write_text(json.dumps(truth))
    runs = "".join(f"[[run]]\nmodule = [{string}, {8 + 4 * i}]\n" for i, string in enumerate(STRINGS))
    Path("runs.toml").write_text("[defaults]\nphotons = 1e9\nwavelength_nm = 405\n" + runs)


def judge(fit):
    truth = {name: iter(values) for name, values in json.loads(Path("truth.json").read_text()).items()}
    pulls = []
    for parameter in json.loads(Path(fit).read_text())["parameters"]:
        true = next(truth[parameter["family"]])
        value, error = parameter["value"], parameter["error"]
        pulls.append(math.log(value / true) / (error / value))
        print(f"{parameter['name']:22} {value:6.3f} +- {error:5.3f}  true {true:5.3f}  pull {pulls[-1]:5.2f}")
    width = math.sqrt(sum(pull**2 for pull in pulls) / len(pulls))
    within = sum(abs(pull) < 2 for pull in pulls)
    print(f"width of the pulls {width:.2f}; within two errors {within} of {len(pulls)}")


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in ("make", "judge"):
        sys.exit(__doc__)
    make(sys.argv[2]) if sys.argv[1] == "make" else judge(sys.argv[2])
