# SPDX-License-Identifier: Apache-2.0
"""Laws of opening: a valve's opening from the time, the pressure difference and the flow.

The same arguments give the same bits, and no state is kept between calls. Times, pressures and flows are in the solver's units.
The pressure difference is upstream minus downstream pressure, and flow is positive in the downstream direction. Positive values
of both open a valve. ``rate`` is the derivative of the opening by time. States are plain values, which can be kept in a restart
file. To repeat a step, start from the earlier state.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import nan
from typing import Any, Literal

from numpy.typing import NDArray

from riis import _riis


class _Timed:
    """A law that depends on the time alone."""

    def __post_init__(self) -> None:
        self.opening_and_rate(0.0)  # refuses bad values

    def opening_and_rate(self, time: Any) -> tuple[Any, Any]:
        """Returns the opening and its rate at a time, or arrays (n,) of both at times (n,) float64."""
        raise NotImplementedError

    def __call__(self, time: Any) -> Any:
        """Returns the opening at a time, or an array (n,) at times (n,) float64."""
        return self.opening_and_rate(time)[0]

    def rate(self, time: Any) -> Any:
        """Returns the rate at a time, or an array (n,) at times (n,) float64."""
        return self.opening_and_rate(time)[1]


@dataclass(frozen=True)
class OpeningTable(_Timed):
    """An opening from a table of keys.

    ``time`` and ``opening`` are (n_keys,) float64; times ascend strictly, and openings are 0 to 1.
    With a ``period`` the table repeats. Without a period, the opening is constant before the first key and after the last.
    """

    time: NDArray[Any]
    opening: NDArray[Any]
    period: float = 0.0
    interpolation: Literal["linear", "cubic"] = "linear"

    def opening_and_rate(self, time: Any) -> tuple[Any, Any]:
        return _riis._opening_from_table(self.time, self.opening, self.period, self.interpolation, time)


@dataclass(frozen=True)
class OpeningTimes(_Timed):
    """An opening from times.

    OpeningTimes(0.45, 0.05, 0.95, 0.05, period=1.0) begins to open at 0.45 and to close at 0.95. Both take 0.05. The ramps are of
    fifth degree, so neither the rate nor its derivative jumps.
    """

    opening_start: float
    opening_duration: float
    closing_start: float
    closing_duration: float
    closed: float = 0.0
    open: float = 1.0
    period: float = 0.0

    def opening_and_rate(self, time: Any) -> tuple[Any, Any]:
        return _riis._opening_from_times(
            self.opening_start,
            self.opening_duration,
            self.closing_start,
            self.closing_duration,
            self.closed,
            self.open,
            self.period,
            time,
        )


@dataclass(frozen=True)
class OpeningSwitchState:
    """The state of a switch. The default is a closed valve at time 0."""

    time: float = 0.0
    opening: float = 0.0
    rate: float = 0.0
    progress: float = 0.0  #: fraction of the way from closed to open
    pressure_difference: float = nan  #: filtered; NaN: none yet
    flow: float = nan  #: filtered; NaN: none yet
    turn_time: float = nan  #: the time of the last change of phase; NaN: none yet
    phase: Literal["closing", "opening"] = "closing"


@dataclass(frozen=True)
class OpeningSwitch:
    """The valve opens when the pressure difference exceeds open_above, and closes when the flow falls below close_below."""

    opening_duration: float  #: time from closed to open
    closing_duration: float  #: time from open to closed
    open_above: float = 0.0  #: a pressure difference
    close_below: float = 0.0  #: a flow
    filter_time: float = 0.0  #: time constant of a filter of pressure difference and flow; 0: no filter
    dwell_time: float = 0.0  #: the least time from one change of phase to the next

    def __post_init__(self) -> None:
        self.advance(OpeningSwitchState(), 0.0, 0.0, 0.0)  # refuses bad values

    def advance(
        self, before: OpeningSwitchState, time: float, pressure_difference: float, flow: float
    ) -> OpeningSwitchState:
        """Returns the state at a time, with the pressure difference and the flow at that time."""
        return _riis._advance_switch(self, before, time, pressure_difference, flow)


@dataclass(frozen=True)
class OpeningAngleState:
    """The state of the angle law. The default is a closed valve at rest, at time 0. Its angle 0 means angle_min."""

    time: float = 0.0
    opening: float = 0.0
    rate: float = 0.0
    angle: float = 0.0  #: degrees
    angle_rate: float = 0.0  #: degrees per time
    pressure_difference: float = nan  #: at that time; NaN: none yet
    flow: float = nan  #: at that time; NaN: none yet


@dataclass(frozen=True)
class OpeningAngle:
    """The angle law of Korakianitis and Shi (2006).

    The paper's values for mmHg, ml and s: pressure_gain 5500, flow_gain 2, friction 50, vortex_gain 7 for the aortic and 3.5 for
    the mitral valve.
    """

    pressure_gain: float
    flow_gain: float
    friction: float
    vortex_gain: float
    angle_min: float = 0.0  #: degrees: the closed angle
    angle_max: float = 75.0  #: degrees: the open angle

    def __post_init__(self) -> None:
        self.advance(OpeningAngleState(), 0.0, 0.0, 0.0)  # refuses bad values

    def advance(
        self, before: OpeningAngleState, time: float, pressure_difference: float, flow: float
    ) -> OpeningAngleState:
        """Returns the state at a time, with the pressure difference and the flow at that time."""
        return _riis._advance_angle(self, before, time, pressure_difference, flow)
