"""Where the runs of a sweep execute: processes of this machine, a Dask cluster, a Ray cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import Any, Literal, Protocol, TypeVar

from sgim.errors import SgimError

BackendName = Literal["loky", "dask", "ray"]

LOCAL_JOBS = 2
"""Processes on this machine where nothing else is said."""

T = TypeVar("T")


class Execute(Protocol):
    """Carries out a function for each argument, side by side."""

    def __call__(self, function: Callable[[T], object], arguments: Sequence[T]) -> None:
        """Return when all are done; what workers raise, or that one died, is raised here."""
        ...


@contextmanager
def workers(backend: BackendName, address: str | None, jobs: int | None) -> Iterator[Execute]:
    """Workers of a back end of joblib, for as long as the context lasts.

    Args:
        backend: ``loky``, processes of this machine; ``dask`` or ``ray``, a cluster.
        address: Of the cluster's scheduler; None for a cluster on this machine, which is started
            and stopped here.
        jobs: How many runs to make at once; None for all that a cluster has, or two on this
            machine.

    Raises:
        SgimError: If there is no such back end, its extra is not installed, or the cluster
            cannot be reached.
    """
    if backend not in _STARTERS:
        known = ", ".join(_STARTERS)
        raise SgimError(f"there is no back end {backend!r}; choose among {known}")
    if backend == "loky" and address is not None:
        raise SgimError("loky has no address; with --backend dask or ray there may be one")
    if backend == "loky" and jobs == 1:
        yield _one_after_another
        return
    with ExitStack() as stack:
        yield _STARTERS[backend](address, jobs, stack)


def _one_after_another(function: Callable[[T], object], arguments: Sequence[T]) -> None:
    for argument in arguments:
        if function(argument) == "interrupted":
            raise KeyboardInterrupt


def _side_by_side(jobs: int) -> Execute:
    def execute(function: Callable[[T], object], arguments: Sequence[T]) -> None:
        from joblib import Parallel, delayed

        Parallel(n_jobs=jobs, batch_size=1)(delayed(function)(one) for one in arguments)

    return execute


def _loky(address: str | None, jobs: int | None, stack: ExitStack) -> Execute:
    from joblib import parallel_config

    stack.enter_context(parallel_config(backend="loky", inner_max_num_threads=1))
    return _side_by_side(jobs or LOCAL_JOBS)


def _dask(address: str | None, jobs: int | None, stack: ExitStack) -> Execute:
    try:
        import dask
        from distributed import Client, LocalCluster
    except ImportError as error:
        raise _not_installed("dask") from error
    from joblib import parallel_config

    client: Any
    if address is None:
        # Runs that kill their worker are counted by the sweep, and end the fault there.
        stack.enter_context(dask.config.set({"distributed.scheduler.allowed-failures": 1000}))
        cluster = LocalCluster(
            n_workers=jobs or LOCAL_JOBS, threads_per_worker=1, dashboard_address=None
        )
        client = stack.enter_context(Client(stack.enter_context(cluster)))
    else:
        try:
            client = stack.enter_context(Client(address))
        except (OSError, ValueError) as error:
            raise _unreachable("Dask scheduler", address, error) from error
    stack.enter_context(parallel_config(backend="dask", client=client))
    return _side_by_side(jobs or -1)


def _ray(address: str | None, jobs: int | None, stack: ExitStack) -> Execute:
    try:
        import ray
        from ray.util.joblib import register_ray
    except ImportError as error:
        raise _not_installed("ray") from error
    from joblib import parallel_config

    if not ray.is_initialized():
        local = {"num_cpus": jobs or LOCAL_JOBS, "include_dashboard": False}
        how = local if address is None else {"address": address}
        try:
            ray.init(**how, log_to_driver=False, logging_level="ERROR")
        except (OSError, ValueError, RuntimeError) as error:
            raise _unreachable("Ray cluster", address or "local", error) from error
        stack.callback(ray.shutdown)
    register_ray()
    # A worker that dies is started again, with the run it had; the sweep counts how often.
    again = {"max_restarts": -1, "max_task_retries": -1}
    stack.enter_context(parallel_config(backend="ray", ray_remote_args=again))
    return _side_by_side(jobs or -1)


_STARTERS: dict[str, Callable[[str | None, int | None, ExitStack], Execute]] = {
    "loky": _loky,
    "dask": _dask,
    "ray": _ray,
}


def _not_installed(extra: str) -> SgimError:
    return SgimError(f"--backend {extra} needs the extra {extra}: pip install 'sgim[{extra}]'")


def _unreachable(what: str, address: str, error: Exception) -> SgimError:
    return SgimError(
        f"no {what} answers at {address} ({type(error).__name__}: {error}); check the address, or "
        "leave it out for a cluster on this machine"
    )
