# SPDX-License-Identifier: Apache-2.0
"""A child of fork() marks or raises an exception, but never hangs. An alarm ends a child that hangs, and the test fails."""

import multiprocessing
import os
import signal
import threading
import traceback

import numpy
import pytest

import riis

SECONDS = 60


def status_of_child(work, leave=os._exit):
    """Forks, and runs `work` in the child. Returns the child's exit status: 0, or 1 after an exception."""
    child = os.fork()
    if child == 0:
        signal.alarm(SECONDS)
        status = 1
        try:
            work()
            status = 0
        except BaseException:
            traceback.print_exc()
        leave(status)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def in_child(work, leave=os._exit):
    """Returns whether `work` ended by itself and without an exception in a child."""
    return status_of_child(work, leave) == 0


@pytest.fixture
def busy_parent(surface, mesh, valve):
    """Makes a parent that has used all threads of OpenMP and TBB before it forks."""
    riis.mark(surface, mesh, search="exhaustive", n_threads=4)
    surface.update(valve, n_threads=4)
    return surface


def test_a_child_marks(busy_parent, mesh, marks, valve):
    def work():
        found = riis.mark(busy_parent, mesh)
        assert found.stats.n_threads == 1
        assert numpy.array_equal(found.ids, marks.ids) and numpy.array_equal(found.distance, marks.distance)
        coefficient = numpy.zeros(len(mesh))
        found.add_resistance(coefficient, R=1.0)
        assert coefficient.any() and found.dense().mark.sum() == len(found)
        mesh.prepare()
        assert numpy.array_equal(riis.mark(busy_parent, mesh, search="clusters").ids, marks.ids)
        busy_parent.update(valve)
        assert numpy.array_equal(riis.mark(riis.Surface(valve, half_thickness=0.15), mesh).ids, marks.ids)

    for _ in range(20):
        assert in_child(work)


def test_a_child_leaves_as_processes_do(busy_parent, mesh):
    def leave(status):
        os._exit(status)

    def work():
        riis.mark(busy_parent, mesh)

    assert in_child(work, leave)
    context = multiprocessing.get_context("fork")
    with context.Pool(2) as pool:
        found = pool.map(count_marks, [0.1, 0.5, 0.9])
    assert found == [count_marks(opening) for opening in (0.1, 0.5, 0.9)]


def count_marks(opening):
    nodes = numpy.random.default_rng(3).uniform(-2.0, 2.0, (5000, 3))
    surface = riis.Surface(riis.Valve("mitral", opening=opening), half_thickness=0.15)
    return len(riis.mark(surface, riis.Mesh(nodes)))


def test_a_child_refuses_several_threads(busy_parent, mesh, valve):
    def work():
        for use in (
            lambda: riis.mark(busy_parent, mesh, n_threads=2),
            lambda: riis.Surface(valve, n_threads=2),
            lambda: busy_parent.update(valve, n_threads=2),
            lambda: riis.Adjacency.from_grid(2, 2, 2, n_threads=2),
        ):
            with pytest.raises(riis.UnavailableError, match="n_threads: is 2; a child of fork"):
                use()

    assert in_child(work)


def test_a_child_refuses_marks_that_several_threads_made(busy_parent, mesh, marks):
    alone = riis.mark(busy_parent, mesh, n_threads=1)

    def work():
        coefficient = numpy.zeros(len(mesh))
        with pytest.raises(riis.UnavailableError, match="marks: the marking was made before the fork"):
            marks.add_resistance(coefficient, R=1.0)
        with pytest.raises(riis.UnavailableError, match="marks: the marking was made before the fork"):
            marks.dense()
        assert len(marks.ids) == len(alone)  # reading needs no threads
        alone.add_resistance(coefficient, R=1.0)
        assert coefficient.any()

    assert in_child(work)


def test_a_child_of_a_thread_inside_the_library_makes_no_surface(surface, mesh, valve, xyz):
    is_over, refused, other = threading.Event(), [], riis.Mesh(xyz.copy())

    def go_on():
        own, moving = riis.Marks(), riis.Valve("mitral")
        shown = riis.Surface(moving)
        while not is_over.is_set():
            moving["opening"] = 0.5
            shown.update(moving)
            riis.mark(shown, other, into=own)

    def work():
        marks = riis.mark(surface, mesh)  # objects that no other thread used
        assert len(marks) > 0
        try:
            riis.mark(surface, other)
        except riis.UnavailableError as error:
            assert "mesh: another thread was using it when this process was forked" in str(error)
        try:
            riis.Surface(valve)
        except riis.UnavailableError as error:
            assert "surface: this process was forked while another thread was inside riis" in str(error)
            os._exit(17)

    thread = threading.Thread(target=go_on)
    thread.start()
    try:
        for _ in range(30):
            refused.append(status_of_child(work))
    finally:
        is_over.set()
        thread.join()
    assert set(refused) <= {0, 17} and 17 in refused


def test_a_child_of_a_child_marks(busy_parent, mesh):
    def work():
        riis.mark(busy_parent, mesh)
        assert in_child(lambda: riis.mark(busy_parent, mesh))

    assert in_child(work)
