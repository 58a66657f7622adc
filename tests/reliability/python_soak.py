"""Traces in one Python process, from several threads, with Ctrl-C at random: no crash, and memory that does not grow.

    EIGENTRAIL=build/release/apps/eigentrail EIGENTRAIL_DATA=data PYTHONPATH=tests/cli:build/release/python PYTHONMALLOC=malloc \\
        python3 tests/reliability/python_soak.py --traces 2000

What is allocated is judged; PYTHONMALLOC=malloc counts what Python allocates, too. The resident memory is printed: it also
depends on what lies between pieces that are in use, by some MB.
"""

import argparse
import ctypes
import gc
import os
import random
import signal
import sys
import tempfile
import threading
import time
import warnings

import eigentrail as et
import numpy as np
import scipy.sparse as sp

from program import BLADE, CROSSING, PUSHED_PENDULUM

MOST_GROWTH = 2.0  # MB allocated; 0.9 come and go
OUTCOMES = (et.Error, KeyboardInterrupt, ZeroDivisionError)
LIBC = ctypes.CDLL(None)


def fails_late(p):
    return {"M": np.eye(2), "K": np.diag([1.0 + p, 2.0 / (p < 0.7)])}


def trace_one(chance, file):
    """One trace of some kind, or another use of the engine."""
    n = chance.randrange(2, 9)
    K = np.diag(np.arange(1.0, n + 1)) + 0.1
    kind = chance.randrange(9)
    if kind == 0:
        et.trace(BLADE, drag=chance.uniform(1, 5), tolerance=10.0 ** -chance.randrange(4, 9)).eigentrail.sel(omega=50)
    elif kind == 1:
        et.trace(et.Family(M=np.eye(n), K=[K, K @ K], parameter="p"), p=(0, 1)).eigentrail.events
    elif kind == 2:
        et.trace(et.Family(M=sp.eye(n), K=[sp.csr_matrix(K), sp.eye(n)], parameter="p"), p=(0, 1))
    elif kind == 3:
        et.trace(et.Family(lambda p: {"M": np.eye(n), "K": K + np.sin(p) * np.eye(n)}), p=(0, 1))
    elif kind == 4:
        et.trace(et.Samples(np.linspace(0, 1, 9), M=np.eye(n), K=[K + p * np.eye(n) for p in np.linspace(0, 1, 9)]), p=(0, 1))
    elif kind == 5:
        et.trace(et.Family(fails_late), p=(0, 1))
    elif kind == 6:
        et.trace(BLADE, drag="no number")
    elif kind == 7:
        et.open(file).eigentrail.sel(p=0.3)
    else:
        et.spectrum(PUSHED_PENDULUM, at=0.5)
        et.trace(CROSSING, threads=2)


def import_everything(file):
    """Uses all that the traces use, once: Ctrl-C within an import may leave CPython's lock on the module, for which others wait."""
    for number in range(60):
        try:
            trace_one(random.Random(f"import {number}"), file)
        except OUTCOMES:
            pass


class Allocation(ctypes.Structure):
    """struct mallinfo2 of glibc."""
    _fields_ = [(name, ctypes.c_size_t) for name in
                ("arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks", "fordblks", "keepcost")]


LIBC.mallinfo2.restype = Allocation


def memory():
    """What is allocated and what is resident, of this process, in MB."""
    gc.collect()
    LIBC.malloc_trim(0)
    allocation = LIBC.mallinfo2()
    with open("/proc/self/statm", encoding="ascii") as file:
        resident = int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    return (allocation.uordblks + allocation.hblkhd) / 1e6, resident / 1e6


class Soak:
    """Threads that take the numbers of traces from one counter, among them the main one, which alone gets Ctrl-C."""

    def __init__(self, seed, file):
        self.seed, self.file, self.number, self.end, self.unexpected = seed, file, 0, 0, []
        self.lock = threading.Lock()
        self.interrupted = 0

    def next(self):
        with self.lock:
            self.number += 1
            return self.number if self.number <= self.end else None

    def work(self):
        while (number := self.next()) is not None:
            try:
                trace_one(random.Random(f"{self.seed} {number}"), self.file)
            except OUTCOMES as error:
                self.interrupted += isinstance(error, KeyboardInterrupt)
            except BaseException as error:  # noqa: BLE001
                self.unexpected.append(f"{number}: {type(error).__name__}: {error}")

    def interrupt(self, over):
        chance = random.Random(self.seed)
        while not over.wait(chance.uniform(0.01, 0.4)):
            os.kill(os.getpid(), signal.SIGINT)

    def run(self, traces, n_threads):
        """More traces; all threads are new."""
        self.end = self.number = self.end
        self.end += traces
        over = threading.Event()
        threads = [threading.Thread(target=self.work) for _ in range(n_threads - 1)]
        threads.append(threading.Thread(target=self.interrupt, args=(over,)))
        for thread in threads:
            thread.start()
        while any(thread.is_alive() for thread in threads[:-1]):
            try:
                self.work()
                time.sleep(0.01)
            except KeyboardInterrupt:
                self.interrupted += 1
        over.set()
        while threads[-1].is_alive():
            try:
                threads[-1].join()
            except KeyboardInterrupt:
                pass


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--traces", type=int, default=2000)
    parser.add_argument("--threads", type=int, default=8)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory(prefix="eigentrail-") as folder:
        file = os.path.join(folder, "crossing.h5")
        et.trace(CROSSING).eigentrail.save(file)
        import_everything(file)
        soak, levels = Soak(options.seed, file), []
        for _ in range(4):
            soak.run(options.traces // 4, options.threads)
            levels.append(memory())
    allocated, resident = zip(*levels)
    growth = allocated[-1] - allocated[1]  # in the second half
    print(f"{options.traces} traces in {options.threads} threads, {soak.interrupted} interrupted; after each quarter "
          + ", ".join(f"{level:.2f}" for level in allocated) + " MB allocated, "
          + ", ".join(f"{level:.1f}" for level in resident) + " MB resident")
    for line in soak.unexpected:
        print(line)
    return bool(soak.unexpected) or growth > MOST_GROWTH


if __name__ == "__main__":
    sys.exit(main())
