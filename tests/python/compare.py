"""compare.py MODULE CSV DURATION STEP EVERY METHOD: a run of the module has the numbers of `jourdain simulate` to 1e-12."""
import csv
import importlib
import sys

import numpy as np

module, path, method = importlib.import_module(sys.argv[1]), sys.argv[2], sys.argv[6]
duration, step, every = float(sys.argv[3]), float(sys.argv[4]), int(sys.argv[5])

with open(path, newline="") as file:
    names, *rows = csv.reader(file)
table = np.array(rows, dtype=float)
model = module.Model()
run = model.simulate(model.initial_state(), duration, step, method=method, every=every, outputs=bool(module.OUTPUTS))

# The CSV adds to the names of velocities that are rates of no position.
ours = {name if name in names else name + "_velocity": run[name] for name in module.POSITIONS + module.VELOCITIES}
for output in module.OUTPUTS:
    numbers = module.VARIABLES[output].numbers
    ours.update(zip(numbers, run[output].reshape(len(table), len(numbers)).T))
assert not set(ours) - set(names), (set(ours) - set(names), names)
for name, values in ours.items():
    column = table[:, names.index(name)]
    off = np.abs(values - column).max() / max(1, np.abs(column).max())
    assert off < 1e-12, (name, off)
print(f"{len(ours)} columns of {len(table)} rows")
