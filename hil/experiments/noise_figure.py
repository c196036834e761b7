"""The noise report as one figure: record, spectrum, Allan deviation, delays."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.signal import welch  # type: ignore[attr-defined]  # re-exported beyond mypy's sight
from scipy.stats import gamma, norm, uniform  # type: ignore[attr-defined]

from hil.cell.rig import LatencyLaw
from hil.cell.sensor.transducer import RATE
from hil.experiments.allan import allan_deviation
from hil.experiments.noise_report import AXES, TAUS, NoiseReport

AXIS = 2  # fz carries the insertion


def figure(report: NoiseReport, path: Path) -> None:
    """Write a PNG of the fz axis and the delay histogram."""
    sheet = Figure(figsize=(11, 7.5), layout="constrained")
    panels = sheet.subplots(2, 2)
    _record(panels[0, 0], report)
    _spectrum(panels[0, 1], report)
    _allan(panels[1, 0], report)
    _delays(panels[1, 1], report)
    sheet.suptitle(f"Emulated NRS-6050-D80 at rest, {report.seconds:g} s, seed {report.seed}")
    sheet.savefig(path, dpi=120)


def _record(panel: Axes, report: NoiseReport) -> None:
    readings = report.record[:, AXIS]
    panel.plot(np.arange(len(readings)) / RATE, readings, lw=0.3, color="0.6", label="1 kHz")
    smooth = readings[: len(readings) // RATE * RATE].reshape(-1, RATE).mean(axis=1)
    panel.plot(np.arange(len(smooth)) + 0.5, smooth, color="C3", label="1 s means: bias walk")
    panel.set(xlabel="time [s]", ylabel=f"{AXES[AXIS]} [N]", title="record, untared")
    panel.legend(loc="lower right")


def _spectrum(panel: Axes, report: NoiseReport) -> None:
    readings = report.record[:, AXIS]
    frequencies, density = welch(readings, fs=RATE, nperseg=min(len(readings), 4096))
    expected = report.axes[AXIS].psd.expected
    panel.loglog(frequencies[1:-1], density[1:-1], lw=0.7, label="measured (Welch)")
    panel.axhline(expected, color="k", ls="--", label=f"white + rounding, {expected:.2e} N²/Hz")
    panel.set(xlabel="frequency [Hz]", ylabel="one-sided PSD [N²/Hz]", title="spectrum")
    panel.legend()


def _allan(panel: Axes, report: NoiseReport) -> None:
    readings = report.record[:, AXIS]
    taus = np.unique(np.geomspace(1, len(readings) // 10, 40).round()) / RATE
    panel.loglog(taus, [allan_deviation(readings, RATE, tau) for tau in taus], label="measured")
    allan = report.axes[AXIS].allan
    panel.loglog(
        TAUS[: len(allan)], [at.expected for at in allan], "ko", mfc="none", label="preset"
    )
    panel.set(xlabel="averaging time τ [s]", ylabel="Allan deviation [N]", title="stability")
    panel.legend()


def _delays(panel: Axes, report: NoiseReport) -> None:
    delay = report.delay
    panel.hist(delay.delays * 1e3, bins=80, density=True, color="0.7", label="drawn")
    grid = np.linspace(0.0, float(delay.delays.max()) * 1.05 + 1e-6, 400)
    density = _density(delay.law, grid)
    if density is not None:
        panel.plot(grid * 1e3, density * 1e-3, "k--", label=f"{delay.law.law} law")
    panel.set(xlabel="delay of a sensor frame [ms]", ylabel="density [1/ms]", title="CAN latency")
    panel.legend()


def _density(law: LatencyLaw, grid: np.ndarray) -> np.ndarray | None:
    """Density of the law over seconds; None for a constant one."""
    if law.law == "constant" or law.jitter == 0.0:
        return None
    if law.law == "uniform":
        shape = uniform(law.mean - law.jitter, 2 * law.jitter)
    elif law.law == "normal":
        shape = norm(law.mean, law.jitter)
    else:
        k = (law.mean / law.jitter) ** 2
        shape = gamma(k, scale=law.mean / k)
    return np.asarray(shape.pdf(grid))
