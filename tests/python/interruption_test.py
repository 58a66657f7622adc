"""Ctrl-C: a trace stops at the next point and keeps what there is; Python's own handler comes back."""

import os
import signal
import threading
import time
import unittest

import eigentrail as et
import numpy as np
import xarray  # noqa: F401  the first trace would import it, for longer than the timers below wait

from program import TIME_LIMIT

# Many modes that cross and veer: takes long at this tolerance.
N = 60
LONG = et.Family(M=np.eye(N), C=0.001 * np.eye(N), parameter="p",
                 K=[np.diag(np.arange(1.0, N + 1) ** 2), 20 * np.cos(np.add.outer(np.arange(N), np.arange(N)))])


class Interruptions(unittest.TestCase):
    def interrupted(self, function, **how):
        timer = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        begin = time.monotonic()
        try:
            return function(LONG, p=(0, 40), tolerance=1e-11, options={"max_step": 0.001}, **how)
        finally:
            self.assertLess(time.monotonic() - begin, TIME_LIMIT)
            timer.join()

    def test_a_trace_keeps_its_points(self):
        before = signal.getsignal(signal.SIGINT)
        with self.assertWarnsRegex(UserWarning, "interrupted"):
            loci = self.interrupted(et.trace, modes=10)
        self.assertEqual(loci.attrs["status"], "interrupted")
        self.assertGreater(loci.sizes["node"], 1)
        self.assertLess(loci.p.values[-1], 40)
        self.assertIs(signal.getsignal(signal.SIGINT), before)
        with self.assertRaises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(1)

    def test_a_sweep_ends(self):
        family = et.Family(M=LONG.matrices["M"], K={**LONG.matrices["K"], "k": np.eye(N)}, parameter="p", factors={"k": "k"},
                           parameters={"k": 1.0})
        timer = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            et.sweep(family, {"k": [1.0, 2.0, 3.0]}, p=(0, 40), tolerance=1e-11, modes=10, options={"max_step": 0.001})
        timer.join()

    def test_a_function_that_is_called_often_can_be_interrupted(self):
        timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()

        def slow(p):
            time.sleep(0.05)
            return dict(M=np.eye(1), K=[[2.0 + np.sin(300 * p)]])

        with self.assertRaises(KeyboardInterrupt):
            et.trace(et.Family(slow), p=(0, 1))
        timer.join()


if __name__ == "__main__":
    unittest.main()
