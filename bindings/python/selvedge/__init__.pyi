from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union, overload

import numpy as np
from numpy.typing import ArrayLike

__version__: str

class Error(RuntimeError): ...
class InputError(Error): ...
class ArgumentError(Error, ValueError): ...

class Mesh:
    points: np.ndarray
    triangles: np.ndarray
    uvs: Optional[Union[np.ndarray, Tuple[np.ndarray, np.ndarray]]]
    groups: Optional[List[str]]  # of a generated mesh alone
    def __init__(self, points: np.ndarray, triangles: np.ndarray) -> None: ...
    def __iter__(self) -> Iterator[np.ndarray]: ...

_MeshLike = Union[Mesh, Tuple[ArrayLike, ArrayLike]]
_CornerValues = Union[ArrayLike, Tuple[ArrayLike, ArrayLike]]  # by vertex, by corner, or values and their numbers

class Result(Mesh):
    normal_vectors: Optional[np.ndarray]
    attributes: Dict[str, np.ndarray]
    vertices: np.ndarray
    birth: np.ndarray
    accepted: bool
    reached: bool
    stopped: bool
    log: str
    collapses: np.ndarray
    @property
    def report(self) -> Dict[str, Any]: ...

class Verdict:
    accepted: bool
    report: Dict[str, Any]
    pairs: np.ndarray  # of `verify`
    new_pairs: np.ndarray  # of `verify`
    swaps: np.ndarray  # of `verify`
    mesh: Mesh  # of `replay`
    def __bool__(self) -> bool: ...

def option_names() -> List[str]: ...
@overload
def simplify(
    points: ArrayLike,
    triangles: ArrayLike,
    *,
    lods: Union[float, Sequence[float], np.ndarray],  # with all below but ratio and faces
    **others: Any,
) -> List[Result]: ...
@overload
def simplify(
    points: ArrayLike,
    triangles: ArrayLike,
    *,
    uvs: Optional[_CornerValues] = None,
    normal_vectors: Optional[_CornerValues] = None,
    groups: Optional[Sequence[Any]] = None,
    attributes: Optional[Mapping[str, ArrayLike]] = None,
    poses: Optional[ArrayLike] = None,
    obstacle: Optional[_MeshLike] = None,
    weights: Optional[Sequence[float]] = None,
    lock_vertices: Optional[Union[Sequence[int], Sequence[bool], np.ndarray]] = None,  # numbers, or a boolean for each vertex
    log: bool = False,
    progress: Optional[Callable[[int, int, int], Any]] = None,
    lods: None = None,
    ratio: float = ...,
    faces: int = ...,
    error: Optional[float] = ...,
    error_everywhere: bool = ...,
    normal_change: float = ...,
    aspect_ratio: float = ...,
    border_turn: float = ...,
    corner_height: float = ...,
    seam_turn: float = ...,
    border_drift: float = ...,
    placement: str = ...,
    loop: str = ...,
    index: str = ...,
    cluster_size: int = ...,
    intersection_check: bool = ...,
    clearance: float = ...,
    stabiliser: float = ...,
    memory: float = ...,
    border_weight: float = ...,
    uv_weight: float = ...,
    normal_weight: float = ...,
    part_ratios: Mapping[str, float] = ...,
    lock: Union[str, Sequence[str]] = ...,
    keep: Union[str, Sequence[str]] = ...,
    may_intersect: Union[str, Sequence[str]] = ...,
    drop_part: Union[str, Sequence[str]] = ...,
    drop_smaller: float = ...,
    key_poses: str = ...,
    weld: Union[float, str] = ...,
    sewn: bool = ...,
    normals: str = ...,
    orient: str = ...,
    instances: str = ...,
    threads: int = ...,
    cells: bool = ...,
    defects: str = ...,
) -> Result: ...
def key_poses(points: ArrayLike, poses: ArrayLike, count: int) -> np.ndarray: ...
def verify(
    points: ArrayLike,
    triangles: ArrayLike,
    original: Optional[_MeshLike] = None,
    *,
    obstacle: Optional[_MeshLike] = None,
    poses: Optional[ArrayLike] = None,
    original_poses: Optional[ArrayLike] = None,
    groups: Optional[Sequence[Any]] = None,
    original_groups: Optional[Sequence[Any]] = None,
    uvs: Optional[_CornerValues] = None,
    original_uvs: Optional[_CornerValues] = None,
    normal_vectors: Optional[_CornerValues] = None,
    original_normal_vectors: Optional[_CornerValues] = None,
    clearance: Optional[float] = None,
    weld: float = 0,
    may_intersect: Union[str, Sequence[str]] = (),
    drop_part: Union[str, Sequence[str]] = (),
    drop_smaller: float = 0,
    threads: Optional[int] = None,
) -> Verdict: ...
def replay(
    points: ArrayLike,
    triangles: ArrayLike,
    log: str,
    *,
    uvs: Optional[_CornerValues] = None,
    normal_vectors: Optional[_CornerValues] = None,
    groups: Optional[Sequence[Any]] = None,
    obstacle: Optional[_MeshLike] = None,
    all: bool = False,
) -> Verdict: ...
def generate(
    name: str,
    *,
    faces: int = 100_000,
    layers: int = 3,
    thickness: float = 5e-4,
    gap: float = 1e-3,
    fold_depth: float = 0.02,
    folds: int = 14,
    seed: int = 1,
) -> Mesh: ...
