"""Runs a notebook from a clean kernel: python3 run_notebook.py NOTEBOOK [FOLDER]

Fails when a cell fails or prints a warning, when the notebook was committed with outputs, or when it shows nothing. With
FOLDER its pictures, and the notebook as it was run, are written there.
"""

import base64
import json
import os
import pathlib
import sys
import tempfile

# Of a cell, in s: ends a run that hangs; builds with sanitizers are slower.
TIME_LIMIT = 60 * int(os.environ.get("EIGENTRAIL_SLOWDOWN", "1"))

# The kernel is this interpreter, whatever kernels its user has installed, and leaves nothing in the user's folders.
_home = tempfile.TemporaryDirectory(prefix="eigentrail-")
_kernel = pathlib.Path(_home.name) / "kernels" / "python3"
_kernel.mkdir(parents=True)
(_kernel / "kernel.json").write_text(json.dumps({
    "argv": [sys.executable, "-Xfrozen_modules=off", "-m", "ipykernel_launcher", "-f", "{connection_file}"],
    "display_name": "Python 3", "language": "python"}))
os.environ.update(JUPYTER_PATH=_home.name, IPYTHONDIR=_home.name, MPLCONFIGDIR=_home.name,
                  JUPYTER_RUNTIME_DIR=_home.name)

import nbformat
from jupyter_client import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError


def fail(message):
    sys.exit(f"{sys.argv[1]}: {message}")


def check_committed(cells):
    for cell in cells:
        if cell.get("outputs") or cell.get("execution_count"):
            fail("was saved with outputs; clear them before committing")


def warnings_in(cell):
    """What the cell wrote to stderr: warnings go there, and nothing else should."""
    return "".join(output.text for output in cell.get("outputs", [])
                   if output.output_type == "stream" and output.name == "stderr")


def pictures(cells):
    for number, cell in enumerate(cells, 1):
        for output in cell.get("outputs", []):
            if "image/png" in output.get("data", {}):
                yield number, base64.b64decode(output.data["image/png"])


def main():
    path = pathlib.Path(sys.argv[1])
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    check_committed(notebook.cells)
    # By files: a port that is free when the manager looks may be taken when the kernel binds it.
    manager = AsyncKernelManager(kernel_name="python3", transport="ipc", ip=str(pathlib.Path(_home.name) / "kernel"))
    client = NotebookClient(notebook, km=manager, timeout=TIME_LIMIT, resources={"metadata": {"path": path.parent}})
    try:
        client.execute()
    except CellExecutionError as error:
        fail(str(error))
    for number, cell in enumerate(notebook.cells, 1):
        if text := warnings_in(cell):
            fail(f"cell {number} wrote to stderr:\n{text}")
    if not any(cell.get("outputs") for cell in notebook.cells):
        fail("shows nothing")
    for number, png in pictures(notebook.cells):
        if len(sys.argv) > 2:
            (pathlib.Path(sys.argv[2]) / f"{path.stem}_{number}.png").write_bytes(png)
    if len(sys.argv) > 2:
        nbformat.write(notebook, pathlib.Path(sys.argv[2]) / path.name)


if __name__ == "__main__":
    main()
