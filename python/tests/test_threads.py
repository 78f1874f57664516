# SPDX-License-Identifier: Apache-2.0
"""Threads mark at the same time. One thread writes an object while no other thread uses it. The log reaches Python."""

import threading
import time

import numpy
import pytest

import riis


def in_threads(n, work):
    """Runs work(i) in n threads at the same time. Returns the results or exceptions."""
    found, barrier = [None] * n, threading.Barrier(n)

    def run(i):
        barrier.wait()
        try:
            found[i] = work(i)
        except Exception as error:  # the test examines the exception
            found[i] = error

    threads = [threading.Thread(target=run, args=(i,)) for i in range(n)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return found


def test_threads_share_a_surface_and_a_mesh(surface, mesh, marks):
    def work(i):
        own = riis.Marks()
        for _ in range(5):
            riis.mark(surface, mesh, into=own, n_threads=1 + i % 2)
        return own.ids.copy(), own.distance.copy()

    for ids, distance in in_threads(4, work):
        assert numpy.array_equal(ids, marks.ids) and numpy.array_equal(distance, marks.distance)


def test_the_lock_is_released(surface, xyz):
    mesh = riis.Mesh(numpy.tile(xyz, (20, 1)))
    ticks, is_over = [], threading.Event()

    def tick():
        while not is_over.is_set():
            ticks.append(time.perf_counter())

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.perf_counter()
    riis.mark(surface, mesh, search="exhaustive", n_threads=1)
    end = time.perf_counter()
    is_over.set()
    thread.join()
    # Python code must run while the call runs. Python code could not run if the call held the interpreter's lock.
    middle = [t for t in ticks if begin + 0.25 * (end - begin) < t < begin + 0.75 * (end - begin)]
    assert middle


def test_one_object_is_written_by_one_thread(surface, xyz):
    mesh, own = riis.Mesh(numpy.tile(xyz, (4, 1))), riis.Marks()
    found = in_threads(4, lambda i: [riis.mark(surface, mesh, into=own, n_threads=1) for _ in range(10)])
    refused = [error for error in found if isinstance(error, Exception)]
    assert refused  # if four threads each mark 10 times into one result, they must collide at least once
    for error in refused:
        assert isinstance(error, riis.UnavailableError) and "into: another thread is using it" in str(error)
    assert len(riis.mark(surface, mesh, into=own)) > 0


def test_messages_reach_python(valve):
    messages = []
    riis.set_log(lambda level, message: messages.append((level, message)))
    try:
        riis.Surface(valve)
        in_threads(3, lambda i: riis.Surface(riis.Valve("mitral")))
    finally:
        riis.set_log(None)
    riis.Surface(valve)
    assert len(messages) >= 4
    assert all(level in (riis.LOG_INFO, riis.LOG_WARNING) and text for level, text in messages)
    count = len(messages)
    riis.Surface(valve)
    assert len(messages) == count


def test_the_log_function_may_fail_but_not_call_riis(valve, monkeypatch):
    errors = []
    monkeypatch.setattr("sys.unraisablehook", lambda failure: errors.append(failure.exc_value))
    riis.set_log(lambda level, message: riis.Surface(valve))
    try:
        riis.Surface(valve)
    finally:
        riis.set_log(None)
    assert errors and all(isinstance(error, riis.UnavailableError) for error in errors)
    with pytest.raises(TypeError):
        riis.set_log(3)
