from os import PathLike
from typing import Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Tuple, TypedDict, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Self, Unpack

Path = Union[str, "PathLike[str]"]
Source = Any  # path, list of paths, array (frames, beads, 3), AtomGroup, mdtraj Trajectory or iterable of frames
Table = Any  # pandas.DataFrame if pandas is installed, else a structured array
Events = NDArray[np.void]
Pairs = NDArray[np.int64]

Names = Union[str, Sequence[str]]
Strides = Sequence[int]
Range = Union[slice, str]
Cutoffs = Union[float, Sequence[float]]

__version__: str

# The options of each function; tests/python/test_documents.py compares them with the program's.
class _Frames(TypedDict, total=False):
    start: Optional[int]
    stop: Optional[int]
    step: Optional[int]

class _Source(TypedDict, total=False):
    radius: Union[str, ArrayLike, None]
    units: Optional[str]
    necklaces: Optional[Sequence[int]]
    times: Optional[ArrayLike]
    topology: Union[Path, Sequence[Path], None]
    select: Optional[str]
    chain: Optional[str]
    dt: Optional[float]
    until_damage: bool
    unwrap: Optional[str]
    no_periodic: bool

class _Input(_Frames, _Source): ...

class _Live(TypedDict, total=False):
    until: Optional[float]
    patience: Optional[float]
    cell: Optional[Sequence[float]]
    rate: Optional[int]

class _Settings(TypedDict, total=False):
    structures: Optional[Names]
    motion: Optional[str]
    kernel: Optional[str]
    levels: Optional[Range]
    nodes: Optional[Range]
    between: Optional[str]
    tightness: Optional[float]
    apart: Optional[int]
    directions: Optional[int]
    stretch: Optional[float]
    probe: Optional[float]
    tolerance: Union[float, str, None]
    certify: bool
    audit: Optional[str]
    threads: Optional[int]
    work: Optional[int]

class _Analysis(_Source, _Settings, _Live, total=False):
    velocities: Union[str, ArrayLike, None]
    obstacle: Optional[Path]
    cutoff: Optional[float]
    surface: bool
    groups: Optional[Tuple[Any, Any]]
    only: Optional[Mapping[str, Iterable[int]]]

class _Run(_Frames, _Analysis): ...

class _Open(_Input, _Live, total=False):
    velocities: Union[str, ArrayLike, None]
    obstacle: Optional[Path]
    groups: Optional[Tuple[Any, Any]]

class _Lifetimes(TypedDict, total=False):
    surface: bool
    gap: Optional[float]
    apart: Optional[int]
    strides: Optional[Strides]
    intermittency: Optional[int]
    motion: Optional[str]
    certify: bool
    threads: Optional[int]

class _ContactsOf(_Source, _Live, _Lifetimes, total=False):
    obstacle: Optional[Path]
    by: Optional[str]

class _ContactAnalysis(_ContactsOf, total=False):
    velocities: Union[str, ArrayLike, None]
    groups: Optional[Tuple[Any, Any]]

class _Contacts(_Frames, _ContactAnalysis): ...
class _SaltBridges(_Frames, _ContactsOf): ...

class _Compare(_Input, _Live, total=False):
    velocities: Union[str, ArrayLike, None]
    structures: Optional[Names]
    strides: Optional[Strides]
    motions: Optional[Names]
    directions: Optional[int]
    stretch: Optional[float]
    probe: Optional[float]
    apart: Optional[int]
    rounds: Optional[int]
    threads: Optional[int]

class _Update(_Input, total=False):
    techniques: Optional[Names]
    strides: Optional[Strides]
    rounds: Optional[int]
    audit: Optional[str]

class _Collide(_Input, total=False):
    obstacle: Optional[Path]
    method: Optional[Names]
    pairs: Optional[str]
    apart: Optional[int]
    within: Optional[float]
    rounds: Optional[int]
    groups: Optional[Tuple[Any, Any]]

class _Surface(_Input, total=False):
    velocities: Union[str, ArrayLike, None]
    obstacle: Optional[Path]
    probe: Optional[float]
    at: Union[float, Sequence[float], None]
    motion: Optional[str]
    threads: Optional[int]

class _Voids(_Input, total=False):
    velocities: Union[str, ArrayLike, None]
    obstacle: Optional[Path]
    probe: Optional[float]
    motion: Optional[str]
    persistence: Optional[float]
    tunnels: bool

class _Trade(_Input, total=False):
    want: Optional[Names]
    apart: Optional[int]
    cutoff: Optional[float]
    without_exact: bool
    rounds: Optional[int]
    seed: Optional[int]
    threads: Optional[int]
    groups: Optional[Tuple[Any, Any]]

class _Conditions(_Input, total=False):
    rho: Optional[float]
    list: Optional[int]

class _Generate(TypedDict, total=False):
    seed: Optional[int]
    motion: Optional[str]
    step: Optional[float]
    bond: Optional[float]
    turns: Optional[float]
    pitch: Optional[float]
    gap: Optional[float]
    dimension: Optional[int]
    jitter: Optional[float]
    fill: Optional[float]
    rolled: Optional[str]
    distance: Optional[float]

class InputError(ValueError): ...
class AuditError(RuntimeError): ...
class InputWarning(UserWarning): ...

class Structure:
    name: str
    @property
    def events(self) -> Events: ...
    def events_frame(self) -> Table: ...
    def elements(self, frame: int) -> NDArray[np.int64]: ...
    def edges(self, frame: Optional[float] = None) -> Pairs: ...
    def pairs(self, frame: Optional[float] = None) -> Pairs: ...
    def spheres(self, frame: Optional[float] = None) -> NDArray[np.float64]: ...
    def nodes(self, frame: Optional[float] = None) -> NDArray[np.int64]: ...
    def lifetimes(self, by: Optional[str] = None, *, cutoff: Optional[Cutoffs] = None,
                  **options: Unpack[_Lifetimes]) -> Table: ...
    def analysis(self, by: Optional[str] = None, *, cutoff: Optional[Cutoffs] = None,
                 **options: Unpack[_Lifetimes]) -> Contacts: ...

class Run:
    events: Events
    fingerprint: str
    def __init__(self, source: Source, *, verbose: bool = False, view: Optional[Path] = None,
                 **options: Unpack[_Run]) -> None: ...
    def events_frame(self) -> Table: ...
    @property
    def structures(self) -> List[str]: ...
    @property
    def kinds(self) -> Dict[str, List[str]]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def names(self) -> List[str]: ...
    @property
    def bead_count(self) -> int: ...
    @property
    def frame_count(self) -> int: ...
    @property
    def frames(self) -> NDArray[np.int64]: ...
    @property
    def times(self) -> NDArray[np.float64]: ...
    @property
    def summary(self) -> Dict[str, Any]: ...
    @property
    def results(self) -> Any: ...
    def plot(self, ax: Any = None) -> Any: ...
    def view(self, path: Optional[Path] = None, verbose: bool = False) -> View: ...
    def __getattr__(self, name: str) -> Structure: ...
    def __len__(self) -> int: ...

class View:
    page: str
    path: Optional[str]
    def __init__(self, page: str, path: Optional[str] = None) -> None: ...

class KineticRun:
    def __init__(self, source: Source, *, log: Optional[Path] = None, **options: Unpack[_Run]) -> None: ...
    @classmethod
    def pushed(cls, beads: int, radius: Optional[ArrayLike] = None, *, dimension: int = 3,
               necklaces: Optional[Sequence[int]] = None, cell: Optional[ArrayLike] = None,
               cutoff: Optional[float] = None, surface: bool = False,
               only: Optional[Mapping[str, Iterable[int]]] = None, **options: Unpack[_Settings]) -> KineticRun: ...
    def push(self, positions: ArrayLike, time: Optional[float] = None,
             cell: Optional[ArrayLike] = None) -> Events: ...
    @property
    def frame(self) -> float: ...
    @property
    def fingerprint(self) -> str: ...
    @property
    def structures(self) -> List[str]: ...
    @property
    def bead_count(self) -> int: ...
    def step(self) -> Optional[Events]: ...
    def next_event(self) -> Optional[Events]: ...
    def go_to(self, frame: float) -> Events: ...
    def finish(self) -> Events: ...
    def audit(self) -> None: ...
    def insert(self, structure: str, bead: int) -> Events: ...
    def erase(self, structure: str, bead: int) -> Events: ...
    def control_points(self) -> NDArray[np.float64]: ...
    def bend(self, beads: Iterable[int], points: ArrayLike) -> Events: ...
    def __getattr__(self, name: str) -> Structure: ...

class StreamFrame:
    frame: int
    time: Optional[float]
    events: Events
    def __getattr__(self, name: str) -> Structure: ...

class _Result:
    table: str
    rows: Table
    json: Dict[str, Any]
    def save(self, path: Path, what: str = "rows") -> None: ...

class Intervals:
    names: List[str]
    unit: str
    rows: Table
    intervals: Table
    json: Dict[str, Any]
    frame_numbers: Optional[NDArray[np.int64]]
    def at_frames(self) -> Tuple[Any, Pairs]: ...
    def native(self, reference: Union[int, ArrayLike, None] = None, at_frames: bool = False) -> Table: ...
    def joined(self, labels: Union[str, Sequence[str], Callable[[str], str]] = "residue") -> JoinedContacts: ...
    def to_networkx(self) -> Any: ...
    def save(self, path: Path, what: str = "rows") -> None: ...

class JoinedContacts(Intervals): ...
class HydrogenBonds(Intervals): ...

class Contacts(_Result, Intervals):
    all: Dict[str, Any]
    survival: Table
    frames: Table
    def correlation(self, lags: ArrayLike) -> Table: ...
    def over_time(self) -> Dict[str, float]: ...
    def map(self) -> NDArray[np.float64]: ...
    def plot_map(self, ax: Any = None) -> Any: ...
    def plot(self, ax: Any = None) -> Any: ...

class Replicas:
    runs: List[Contacts]
    all: Dict[str, float]
    unit: str
    def __init__(self, runs: List[Contacts]) -> None: ...
    def correlation(self, lags: ArrayLike) -> Table: ...
    def survival(self, times: ArrayLike) -> Table: ...

class Comparison(_Result):
    pooled: Table

class Updates(_Result): ...

class Collisions(_Result):
    pairs: Pairs
    pair_frames: NDArray[np.int64]
    frames: Table

class Surface(_Result):
    frames: NDArray[np.float64]
    areas: NDArray[np.float64]
    volumes: NDArray[np.float64]
    contacts: Pairs
    contact_areas: NDArray[np.float64]
    contact_times: NDArray[np.int64]
    unit: str
    def atoms_frame(self) -> Table: ...
    def residues_frame(self) -> Table: ...
    def contacts_frame(self) -> Table: ...

class Voids(_Result):
    stretches: Table
    volumes: Table
    frames: Table
    lives: Dict[str, Any]
    tunnels: Dict[str, int]
    lives_of_tunnels: Table
    unit: str

class Trade(_Result):
    recommendation: str

class Conditions(_Result):
    proper: bool

class _AnalysisBase:
    results: Any
    times: NDArray[Any]
    frames: NDArray[Any]
    def run(self, start: Optional[int] = None, stop: Optional[int] = None, step: Optional[int] = None,
            frames: Optional[ArrayLike] = None, verbose: Optional[bool] = None) -> Self: ...

class KineticAnalysis(_AnalysisBase):
    kds: Optional[Run]
    def __init__(self, atomgroup: Any, verbose: bool = False, *, view: Optional[Path] = None,
                 **options: Unpack[_Analysis]) -> None: ...

class ContactAnalysis(_AnalysisBase):
    kds: Optional[Contacts]
    def __init__(self, atomgroup: Any, verbose: bool = False, *, cutoff: Cutoffs,
                 **options: Unpack[_ContactAnalysis]) -> None: ...

def run(source: Source, *, verbose: bool = False, view: Optional[Path] = None, **options: Unpack[_Run]) -> Run: ...
class Opened:
    source: Source
    options: Dict[str, Any]
    def run(self, **options: Any) -> Run: ...
    def contacts(self, **options: Any) -> Contacts: ...
    def compare(self, **options: Any) -> Comparison: ...
    def stream(self, **options: Any) -> Iterator[StreamFrame]: ...

def open(source: Source, **options: Unpack[_Open]) -> Opened: ...
def stream(source: Source, **options: Unpack[_Run]) -> Iterator[StreamFrame]: ...
def contacts(source: Source, *, cutoff: Cutoffs, verbose: bool = False, **options: Unpack[_Contacts]) -> Contacts: ...
def salt_bridges(source: Source, *, cutoff: Cutoffs = 4.0, bases: Sequence[str] = ..., acids: Sequence[str] = ...,
                 verbose: bool = False, **options: Unpack[_SaltBridges]) -> Contacts: ...
def hydrogen_bonds(source: Source, *, distance: float = 3.0, angle: float = 150.0, hydrogens: Any = None,
                   heavy: Any = None, bond: float = 1.2, **options: Unpack[_Input]) -> HydrogenBonds: ...
def contacts_of_replicas(replicas: Sequence[Source], *, cutoff: Cutoffs, verbose: bool = False,
                         **options: Unpack[_Contacts]) -> Replicas: ...
def contacts_of_parts(folder: Path) -> Replicas: ...
def replay(log: Path, *, verbose: bool = False) -> Dict[str, Any]: ...
def compare(source: Source, *, verbose: bool = False, **options: Unpack[_Compare]) -> Comparison: ...
def update(source: Source, *, verbose: bool = False, **options: Unpack[_Update]) -> Updates: ...
def collide(source: Source, *, verbose: bool = False, **options: Unpack[_Collide]) -> Collisions: ...
def surface(source: Source, *, verbose: bool = False, **options: Unpack[_Surface]) -> Surface: ...
def voids(source: Source, *, verbose: bool = False, **options: Unpack[_Voids]) -> Voids: ...
def trade(source: Source, *, times_examined: Optional[int] = None, verbose: bool = False,
          **options: Unpack[_Trade]) -> Trade: ...
def conditions(source: Source, *, verbose: bool = False, **options: Unpack[_Conditions]) -> Conditions: ...
def generate(model: str, *, beads: Optional[int] = None, frames: Optional[int] = None,
             **options: Unpack[_Generate]) -> Union[NDArray[np.float64], List[NDArray[np.float64]]]: ...
def power_diagram(centers: ArrayLike, radius: ArrayLike) -> Tuple[Pairs, NDArray[np.int64]]: ...
def enclosing_sphere(centers: ArrayLike, radius: ArrayLike) -> Tuple[NDArray[np.float64], float, NDArray[np.int64]]: ...
def wrapped_hierarchy(centers: ArrayLike, radius: ArrayLike,
                      necklaces: Sequence[int] = ()) -> Tuple[NDArray[np.int64], NDArray[np.float64]]: ...
def layered_hierarchy(centers: ArrayLike, radius: ArrayLike,
                      necklaces: Sequence[int] = ()) -> Tuple[NDArray[np.int64], NDArray[np.float64]]: ...
def separating_family(centers: ArrayLike, radius: ArrayLike, *, hierarchy: str = "wrapped", rule: str = "more beads",
                      leaf: int = 1, apart: int = 2, necklaces: Sequence[int] = (), between: bool = False,
                      rounds: int = 0) -> Tuple[int, Optional[int], NDArray[np.float64]]: ...
def closest_by_diagram(centers: ArrayLike, radius: ArrayLike, *, necklaces: Sequence[int] = (),
                       rounds: int = 0) -> Tuple[Optional[Tuple[int, int, float]], Dict[str, int], NDArray[np.float64]]: ...
def trusted_hierarchy(before: ArrayLike, after: ArrayLike, radius: ArrayLike, *,
                      rounds: int = 0) -> Tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]: ...
def colliding_pairs(centers: ArrayLike, radius: ArrayLike, *, within: float = 0, apart: int = 2,
                    necklaces: Sequence[int] = ()) -> Pairs: ...
def closest_pair(centers: ArrayLike, radius: ArrayLike, *, apart: int = 2,
                 necklaces: Sequence[int] = ()) -> Optional[Tuple[int, int, float]]: ...
def impacts(kind: str, *points: ArrayLike, all: bool = False) -> NDArray[np.void]: ...
def structure_names() -> List[str]: ...
