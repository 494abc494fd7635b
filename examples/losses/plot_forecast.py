"""
A forecast that keeps the shape
===============================

The time of a step is uncertain, its height is not. A network trained on mean squares forecasts the
mean over all times, a ramp. Trained on soft-DTW, which tolerates a shift, it forecasts a step
(Cuturi & Blondel 2017, section 4).
"""

import matplotlib.pyplot as plt
import numpy as np
import torch

import curvewise
import curvewise.torch

torch.manual_seed(1)
torch.set_num_threads(1)
random = np.random.default_rng(1)

# %%
# The past shows a pulse of some height, long or short before the end. The future has a step of the
# same height, at a random time.

PAST, FUTURE = 30, 40


def series(count):
    t, places = np.arange(PAST + FUTURE), random.uniform(5, 20, (count, 1))
    heights = random.uniform(0.5, 1.5, (count, 1))
    steps = random.uniform(PAST + 8, PAST + 28, (count, 1))
    pulses = heights * np.exp(-(((t - places) / 3) ** 2))
    values = pulses + heights / (1 + np.exp(-(t - steps) * 2))
    values += random.normal(0, 0.02, values.shape)
    return (torch.tensor(part[..., None]) for part in (values[:, :PAST], values[:, PAST:]))


past, future = series(400)
new_past, new_future = series(100)


def trained(loss):
    torch.manual_seed(1)
    network = torch.nn.Sequential(
        torch.nn.Flatten(), torch.nn.Linear(PAST, 48), torch.nn.Tanh(), torch.nn.Linear(48, FUTURE)
    ).double()
    optimiser = torch.optim.Adam(network.parameters(), lr=5e-3)
    for _ in range(60):
        for chosen in torch.randperm(len(past)).split(100):
            optimiser.zero_grad()
            loss(future[chosen], network(past[chosen])[..., None]).mean().backward()
            optimiser.step()
    with torch.no_grad():
        return network(new_past)[..., None]


def squares(truth, forecast):
    return ((truth - forecast) ** 2).sum(dim=(1, 2))


def soft_dtw(truth, forecast):
    return curvewise.torch.soft_dtw(truth, forecast, gamma=0.05)


forecasts = {"mean squares": trained(squares), "soft-DTW": trained(soft_dtw)}

# %%
# How sharp the steps are: the largest rise from one time to the next, of the true ones 0.9 of the
# height on average. And how far off the shapes are, by dtw.

for name, forecast in forecasts.items():
    rises = forecast.diff(dim=1).amax(dim=(1, 2)) / new_future.amax(dim=(1, 2))
    shapes = curvewise.torch.dtw(new_future, forecast).mean().item()
    print(f"trained on {name}: rise {rises.mean().item():.2f} of the height, dtw {shapes:.2f}")

figure, axes = plt.subplots(1, 3, figsize=(10, 3.2), layout="constrained", sharey=True)
for ax, k in zip(axes, (0, 1, 2), strict=True):
    ax.plot(np.arange(PAST), new_past[k], color="0.6", label="past")
    ax.plot(np.arange(PAST, PAST + FUTURE), new_future[k], color="k", label="future")
    for (name, forecast), color in zip(forecasts.items(), ("#0072b2", "#d55e00"), strict=True):
        ax.plot(np.arange(PAST, PAST + FUTURE), forecast[k], color=color, label=name)
    ax.set_xlabel("time")
axes[2].legend(loc="upper left")
