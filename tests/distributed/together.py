"""Starts the program several times together by mpirun."""

import os
import subprocess

from program import PROGRAM, TIME_LIMIT

MPIRUN = os.environ["EIGENTRAIL_MPIRUN"]
# Tests may run as root in a container, with more processes than cores, and beside other programs.
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
               "OMPI_MCA_mpi_yield_when_idle": "1"}


def run_together(folder, count, *arguments):
    return subprocess.run([MPIRUN, "-n", str(count), PROGRAM, *arguments], cwd=folder, env=ENVIRONMENT,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=4 * TIME_LIMIT, check=False)
