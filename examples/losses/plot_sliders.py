"""
A differentiable material, fitted through the area to a loop
============================================================

The model has springs and sliders in parallel (Masing 1926, Iwan 1967). It is written in PyTorch,
which differentiates it. The test has noise and its own increments. The model is fitted to it
through the area between the loops and through soft-DTW. Adam does so, and then
:func:`curvewise.calibration.identify`, which needs no derivatives.
"""

import logging

import matplotlib.pyplot as plt
import numpy as np
import torch

import curvewise
import curvewise.torch
from curvewise.calibration import identify
from curvewise.materials import ChabocheVoce

logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)

# %%
# The test: a cycle of tension and compression of a Chaboche point, with noise of 4 MPa.

random = np.random.default_rng(3)
turns = [0.0, 0.012, -0.012, 0.012]
test_strain = np.interp(np.sort(random.uniform(0, 3, 260)), range(4), turns)
truth = {"E": 200e3, "yield": 180.0, "Q": 20.0, "b": 5.0, "C1": 40e3, "gamma1": 250.0}
truth |= {"C2": 5e3, "gamma2": 20.0}
stress = ChabocheVoce(backstresses=2).stress(test_strain, truth)
test = np.column_stack([test_strain, stress + random.normal(0, 4, stress.size)])

# %%
# The model: five sliders, each with a stiffness and a strength. Its strains are not the test's.

strain = np.interp(np.linspace(0, 3, 91), range(4), turns)
SLIDERS = 5
box = np.array([0.024, 800.0])  # both curves are divided by it, so that no unit decides


def loop(parameters: torch.Tensor) -> torch.Tensor:
    stiffness, strength = (1e3 * torch.exp(parameters[:SLIDERS])), torch.exp(parameters[SLIDERS:])
    force = torch.zeros(SLIDERS, dtype=torch.float64)
    stresses = [force.sum()]
    for step in np.diff(strain):
        force = torch.clamp(force + stiffness * step, -strength, strength)
        stresses.append(force.sum())
    return torch.stack([torch.tensor(strain), torch.stack(stresses)], dim=1)


start = torch.log(torch.tensor([40.0] * SLIDERS + [20.0, 40.0, 60.0, 80.0, 100.0])).double()
target = torch.tensor(test / box)
scale = torch.tensor(box)


def by_adam(loss, steps=150):
    parameters = start.clone().requires_grad_()
    optimiser = torch.optim.Adam([parameters], lr=0.05)
    for _ in range(steps):
        optimiser.zero_grad()
        loss(target, loop(parameters) / scale).backward()
        optimiser.step()
    return parameters.detach(), steps


def area(test, simulation):
    return curvewise.torch.area(test, simulation, spacing="matched")


def soft_dtw(test, simulation):
    return curvewise.torch.soft_dtw(test, simulation, gamma=1e-3)


fits = {"area, by Adam": by_adam(area), "soft-DTW, by Adam": by_adam(soft_dtw)}

# %%
# The same model without derivatives: `identify` uses more runs instead.

names = [f"k{i}" for i in range(SLIDERS)] + [f"s{i}" for i in range(SLIDERS)]
bounds = {name: (float(at) - 2.0, float(at) + 2.0) for name, at in zip(names, start, strict=True)}


def model(parameters):
    return loop(torch.tensor([parameters[name] for name in names], dtype=torch.float64)).numpy()


found = identify(model, test, bounds, measure="area", seed=0, max_runs=200, progress=False)
fits["area, by identify"] = torch.tensor([found.parameters[name] for name in names]), found.runs

# %%
# All three by one measure. The runs of Adam are runs with derivatives.

figure, ax = plt.subplots(figsize=(7, 4.6), layout="constrained")
ax.plot(*test.T, ".", color="0.7", markersize=3, label="test")
for (name, (parameters, runs)), color in zip(
    fits.items(), ("#d55e00", "#0072b2", "#009e73"), strict=True
):
    simulated = loop(parameters).numpy()
    value = curvewise.area(test / box, simulated / box, spacing="matched")
    print(f"{name}: area {value:.4f} after {runs} runs")
    ax.plot(*simulated.T, color=color, linewidth=1.4, label=f"{name} ({value:.4f})")
ax.set(xlabel="strain [-]", ylabel="stress [MPa]")
ax.legend(loc="center", bbox_to_anchor=(0.45, 0.37))
