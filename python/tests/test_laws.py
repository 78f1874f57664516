# SPDX-License-Identifier: Apache-2.0
"""Laws of opening: their formulas, and their states, which are plain values."""

import dataclasses
import pickle

import numpy
import pytest

import riis


def test_a_table_interpolates():
    table = riis.OpeningTable(numpy.array([0.0, 1.0, 2.0]), numpy.array([0.0, 1.0, 0.5]))
    assert table(0.25) == 0.25 and table.rate(0.25) == 1.0 and table(9.0) == 0.5
    times = numpy.linspace(0.0, 2.0, 21)
    assert numpy.allclose(table(times), numpy.interp(times, [0, 1, 2], [0, 1, 0.5])) and table(times).shape == (21,)
    cycle = dataclasses.replace(table, opening=numpy.array([0.0, 1.0, 0.0]), period=2.0, interpolation="cubic")
    assert cycle(4.5) == pytest.approx(cycle(0.5)) and cycle.rate(1.0) == 0.0


def test_times_ramp_smoothly():
    law = riis.OpeningTimes(0.45, 0.05, 0.95, 0.05, period=1.0)
    assert law(0.4) == 0.0 and law(0.6) == 1.0 and law(0.475) == pytest.approx(0.5)
    s = numpy.linspace(0.0, 1.0, 11)
    assert numpy.allclose(law(0.45 + 0.05 * s), s**3 * (10 - 15 * s + 6 * s**2), atol=1e-12)
    assert law.opening_and_rate(numpy.float64(0.475))[1] == pytest.approx(1.875 / 0.05)


def test_a_switch_opens_by_pressure_and_closes_by_flow():
    law, state = riis.OpeningSwitch(0.04, 0.02), riis.OpeningSwitchState()
    states = [state]
    for step in range(1, 21):
        states.append(law.advance(states[-1], 0.01 * step, 1.0 if step < 10 else -1.0, 1.0 if step < 15 else -1.0))
    openings = [s.opening for s in states]
    assert max(openings) == 1.0 and openings[-1] == 0.0
    assert states[12].phase == "opening" and states[-1].phase == "closing"
    assert law.advance(state, 0.01, 1.0, 1.0) == states[1]  # nothing is kept between calls
    assert pickle.loads(pickle.dumps(states[5])) == states[5]


def test_the_angle_law_moves_by_its_equation():
    law, state = riis.OpeningAngle(5500.0, 2.0, 50.0, 7.0), riis.OpeningAngleState()
    n, dt = 100, 1e-5
    angle, speed = 0.0, 0.0
    for step in range(1, n + 1):
        state = law.advance(state, step * dt, 1.0, 0.0)
        speed += dt * (5500.0 * numpy.cos(angle) - 50.0 * speed)
        angle += dt * speed
    assert state.angle == pytest.approx(numpy.degrees(angle), rel=0.02) and state.opening == pytest.approx(state.angle / 75.0)
