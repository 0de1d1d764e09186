"""Plots with matplotlib, if it is installed."""

import numpy as np

from ._tables import needed


def _axes(ax):
    return needed("matplotlib.pyplot", "plots").subplots()[1] if ax is None else ax


def events(run, ax=None):
    ax = _axes(ax)
    frames = run.frames
    for name in run.structures:
        steps = run.events["step"][run.events["structure"] == name]
        counts = np.bincount(steps, minlength=len(frames) - 1)
        ax.stairs(counts, frames, label=name)
    ax.set_xlabel("frame")
    ax.set_ylabel("events in a step")
    ax.legend()
    return ax


def contact_map(contacts, ax=None):
    ax = _axes(ax)
    image = ax.imshow(contacts.map(), origin="lower", cmap="viridis", vmin=0, vmax=1, interpolation="nearest")
    ax.figure.colorbar(image, ax=ax, label="share of time in contact")
    ax.set_xlabel(contacts.json["by"])
    ax.set_ylabel(contacts.json["by"])
    return ax


def survival(contacts, ax=None):
    ax = _axes(ax)
    points = contacts.json["survival"]
    length = [0.0] + [point["length"] for point in points]
    ax.step(length, [1.0] + [point["survival"] for point in points], where="post", label="survival")
    lower = [1.0] + [np.nan if point["lower"] is None else point["lower"] for point in points]
    upper = [1.0] + [np.nan if point["upper"] is None else point["upper"] for point in points]
    ax.fill_between(length, lower, upper, step="post", alpha=0.3, label="95% band")
    ax.set_xlabel(f"length of a contact ({contacts.unit})")
    ax.set_ylabel("share of contacts that last longer")
    ax.set_ylim(0, 1.02)
    ax.legend()
    return ax
