"""Exact events of structures over moving beads: contacts, power diagrams, bounding hierarchies.

    import MDAnalysis as mda, kds
    u = mda.Universe("md.gro", "md.xtc")
    run = kds.run(u.select_atoms("name CA"), structures=["power", "contacts"], cutoff=8)
    run.contacts.lifetimes(by="residue")

Start with ``help(kds.run)``. Lengths are in angstrom and times in picoseconds. ``docs/python.md`` in the project is the
manual.
"""

from ._analyses import (Collisions, Comparison, Conditions, Contacts, Replicas, Surface, Trade, Updates, Voids, collide,
                        compare, conditions, contacts, contacts_of_parts, contacts_of_replicas, generate, replay, surface,
                        trade, update, voids)
from ._kds import AuditError, InputError
from ._kds import version as _version
from ._contact_types import HydrogenBonds, hydrogen_bonds, salt_bridges
from ._impacts import impacts
from ._intervals import Intervals, JoinedContacts
from ._open import Opened, open
from ._options import InputWarning
from ._paper import closest_by_diagram, separating_family, trusted_hierarchy
from ._run import Run, run, structure_names
from ._static import closest_pair, colliding_pairs, enclosing_sphere, layered_hierarchy, power_diagram, wrapped_hierarchy
from ._stepping import KineticRun, StreamFrame, stream
from ._structure import Structure
from ._view import View

AuditError.__module__ = InputError.__module__ = "kds"
__version__ = _version()
__all__ = ["AuditError", "Collisions", "Comparison", "Conditions", "ContactAnalysis", "Contacts", "HydrogenBonds",
           "InputError", "InputWarning", "Intervals", "JoinedContacts", "KineticAnalysis", "KineticRun", "Opened",
           "Replicas", "Run", "StreamFrame", "Structure", "Surface", "Trade", "Updates", "View", "Voids",
           "closest_by_diagram", "closest_pair", "collide", "colliding_pairs", "compare", "conditions", "contacts",
           "contacts_of_parts", "contacts_of_replicas", "enclosing_sphere", "generate", "hydrogen_bonds", "impacts",
           "layered_hierarchy", "power_diagram", "replay", "run", "salt_bridges", "separating_family", "stream",
           "structure_names", "surface", "trade", "trusted_hierarchy", "update", "voids", "wrapped_hierarchy"]


def __getattr__(name):
    if name in ("ContactAnalysis", "KineticAnalysis"):  # only these classes need MDAnalysis
        from . import _analysis

        return getattr(_analysis, name)
    raise AttributeError(f"module 'kds' has no attribute '{name}'")
