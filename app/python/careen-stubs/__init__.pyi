"""Types of the module careen. Arrays are NumPy's; help(careen) says their shapes, units and errors."""
from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any, TypedDict

from numpy import float64, uint8
from numpy.typing import ArrayLike, NDArray

_Numbers = NDArray[float64]
_Path = str | PathLike[str]
_States = dict[str, _Numbers]
_Controller = Callable[[float, _States, dict[str, tuple[float, float]]], Mapping[str, float]]

__version__: str

class Error(RuntimeError): ...

class SceneError(Error):
    file: str
    line: int
    column: int

class _Impacts(TypedDict):
    time: _Numbers
    a: list[str]
    b: list[str]
    point: _Numbers
    normal: _Numbers
    approach: _Numbers
    impulse: _Numbers
    tangential: _Numbers

class _Forces(TypedDict):
    time: _Numbers
    a: list[str]
    b: list[str]
    point: _Numbers
    normal: _Numbers
    force: _Numbers
    left: _Numbers

class Run:
    @property
    def duration(self) -> float: ...
    @property
    def boxes(self) -> list[str]: ...
    @property
    def hash(self) -> str: ...
    @property
    def impacts(self) -> _Impacts: ...
    @property
    def audit(self) -> dict[str, Any]: ...
    def states(self, t: ArrayLike) -> _States: ...
    def energy(self, t: ArrayLike) -> dict[str, _Numbers]: ...
    def forces(self, t: ArrayLike) -> _Forces: ...
    def when(self, statement: str) -> _Numbers: ...
    def frame(self, t: float, size: tuple[int, int] | None = None) -> NDArray[uint8]: ...
    def film(self, folder: _Path, *, video: _Path | None = None, quality: str = "good", frames: str = "",
             size: tuple[int, int] | None = None, alpha: bool = False, sound: bool = False,
             replace: bool = False, jobs: int | None = None) -> None: ...
    def page(self, path: _Path, *, quality: str = "good", size: tuple[int, int] = (640, 360),
             sound: bool = False) -> None: ...
    def labels(self, folder: _Path, *, channels: str = "all", frames: str = "",
               size: tuple[int, int] | None = None, jobs: int | None = None) -> None: ...
    def estimate_error(self) -> dict[str, float | None] | None: ...
    @property
    def report(self) -> dict[str, Any]: ...
    def export(self, path: _Path, every: float = ...) -> None: ...
    def difference_from(self, other: Run) -> dict[str, Any]: ...
    def save(self, path: _Path) -> None: ...

def simulate(scene: _Path | Mapping[str, Any], *, method: str | None = None, tolerance: float | None = None,
             dt: float | None = None, duration: float | None = None, allow_overlap: bool = False,
             until: str = "", threads: int = 1, control: _Controller | None = None, period: float | None = None) -> Run: ...
def read_run(path: _Path, scene: _Path = "") -> Run: ...
def compare(expected: _Path, actual: _Path, *, threshold: str = "same-picture",
            limits: list[str] = ..., motion: float | None = 0.0, until: float | None = None,
            ignored: list[str] = ..., page: _Path = "", scene: _Path = "") -> dict[str, Any]: ...
def sweep(family: _Path, folder: _Path, *, runs: tuple[int, int] = (0, 99),
          when: list[str] = ..., estimate_error: bool = False, jobs: int | None = None) -> tuple[Path, int, int]: ...
