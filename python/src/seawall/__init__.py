"""Loads and runs parameter studies of solitary waves on seawalls.

``load(DIR)`` reads what ``seawall sweep`` has left. ``run(scene)`` runs one scene and ``sweep(file)`` a
study, through the program ``seawall``. Tables are pandas tables; ``units`` says what their columns count.
"""

from importlib.metadata import version

from seawall._errors import CaseFailed, SeawallError
from seawall._program import find_program
from seawall._running import Run, run, sweep
from seawall._study import Study, load
from seawall._units import Units

__version__ = version("seawall")

__all__ = [
    "CaseFailed",
    "Run",
    "SeawallError",
    "Study",
    "Units",
    "find_program",
    "load",
    "run",
    "sweep",
]
