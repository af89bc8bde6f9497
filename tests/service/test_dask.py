"""Studies on a real Dask cluster of processes give the same lines in the same order as studies in one process.

The service has a connection to the cluster; a script has a client of its own. If a worker is lost, the study still
gives all lines. If the scheduler is lost, the stream of the service ends with an error line, and a script goes on from
the points that it kept.
"""

import json
import shutil
import signal
import subprocess
import threading
import time
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from itertools import islice
from pathlib import Path
from typing import Any

import dask
import httpx
import pytest
from distributed import Client, LocalCluster, Worker

from app.examples import examples, study_bodies
from app.studies import PoolLost, study
from app.studies.kinds.spectrum import Spectrum
from app.studies.kinds.sweep import Sweep
from app.workers.cluster import Kernels
from solvers.compiled import announcement
from solvers.digest import digest_of
from tests.support.dask_cluster import DaskProcesses, running_cluster
from tests.support.server import ROOT, Server, free_port, running_server, wait_until
from tests.support.studies import Planner, lines_of, study_of, timeless

pytestmark = [pytest.mark.service, pytest.mark.ci]

COUPLING = examples()["pahl-axial-displacement"]
PREPARED_S = 400.0  # every worker loads every kernel before its first study
SLOPE = "modifications.helix_slope_um"
Service = tuple[DaskProcesses, str]


@contextmanager
def running_service(workers: int) -> Iterator[Service]:
    """Start a service whose studies run on a cluster with the given number of workers."""
    with running_cluster(workers) as cluster, served(cluster.address) as (_, address):
        yield cluster, address


def served(scheduler: str) -> AbstractContextManager[Server]:
    return running_server(workers=1, scheduler=scheduler, log_level="error")


@pytest.fixture(scope="module")
def service() -> Iterator[Service]:
    with running_service(2) as found:
        yield found


def of_loads(**parts: Any) -> dict[str, Any]:
    return study_of("xue-pair-1-modified", outputs=["pressure.max_mpa"], **parts)


def loads(count: int) -> dict[str, Any]:
    return of_loads(vary=[{"path": SLOPE, "start": -20, "stop": 20, "count": count}])


MISALIGNMENTS = [{"path": "operation.misalignment_deg", "min": 0.02, "max": 0.08}]
SWEEPS: dict[str, dict[str, Any]] = {
    "grid": loads(50),
    "cases": of_loads(cases=[{SLOPE: 5}, {"gears.pinion.addendum": 3.0}, {}]),
    "sample": study_of(COUPLING.name, sample={"count": 32, "ranges": MISALIGNMENTS}),
}


SPECTRUM = {**study_bodies("/v1/spectrum")["coupling"]["value"], "points": True}


def lines(text: str) -> list[dict[str, Any]]:
    return timeless(list(map(json.loads, text.splitlines())))


def local(body: dict[str, Any], plan: Planner = Sweep) -> list[dict[str, Any]]:
    """Return the lines of a study that is calculated in this process."""
    return timeless(lines_of(plan(body, 20_000, 30.0)))


def sweep(address: str, body: dict[str, Any], path: str = "/v1/sweep") -> list[dict[str, Any]]:
    response = httpx.post(f"{address}{path}", json=body, timeout=PREPARED_S)
    assert response.status_code == 200, response.text
    return lines(response.text)


@pytest.mark.parametrize("kind", SWEEPS)
def test_same_lines_in_the_same_order(address: str, kind: str) -> None:
    assert sweep(address, SWEEPS[kind]) == local(SWEEPS[kind])


def test_a_spectrum_has_the_same_numbers(address: str) -> None:
    found = sweep(address, SPECTRUM, "/v1/spectrum")
    assert len(found) == 2 + 2048
    assert found == local(SPECTRUM, Spectrum)


def test_a_killed_worker_costs_nothing_but_time(service: Service) -> None:
    cluster, address = service
    body = loads(400)
    with httpx.stream("POST", f"{address}/v1/sweep", json=body, timeout=PREPARED_S) as response:
        found = response.iter_lines()
        received = [next(found) for _ in range(20)]
        victim = cluster.workers.pop()
        victim.kill()
        received += found
    assert lines("\n".join(received)) == local(body)
    cluster.add_worker()
    cluster.wait()
    assert sweep(address, SWEEPS["grid"]) == local(SWEEPS["grid"])


def test_leaving_takes_back_what_has_not_begun(address: str) -> None:
    with httpx.stream("POST", f"{address}/v1/sweep", json=loads(2500), timeout=PREPARED_S) as response:
        next(response.iter_lines())
    started = time.monotonic()
    sweep(address, of_loads(cases=[{}]))
    assert time.monotonic() - started < 20.0  # two chunks that ran, not two thousand points


def test_a_vanished_scheduler_ends_the_stream_with_an_error_line() -> None:
    with running_service(1) as (cluster, address):
        with httpx.stream("POST", f"{address}/v1/sweep", json=loads(2500), timeout=PREPARED_S) as response:
            found = response.iter_lines()
            received = [next(found) for _ in range(3)]
            threading.Timer(0.3, cluster.scheduler.kill).start()
            received += found
        last = json.loads(received[-1])
        assert (last["type"], last["code"]) == ("error", "scheduler_lost")
        assert last["done"] == sum('"point"' in line for line in received)
        assert httpx.post(f"{address}/v1/coupling", json=COUPLING.request, timeout=60).status_code == 200
        assert_unavailable(address)


def assert_unavailable(address: str) -> None:
    refused = httpx.post(f"{address}/v1/sweep", json=loads(2), timeout=60)
    assert refused.status_code == 503
    assert refused.json()["type"].endswith("scheduler_unavailable")
    assert int(refused.headers["retry-after"]) >= 1


@pytest.fixture
def edited(tmp_path: Path) -> Path:
    """Return a folder with a copy of the project's sources in which one constant of the solvers is changed."""
    for package in ("app", "solvers"):
        shutil.copytree(ROOT / package, tmp_path / package, ignore=shutil.ignore_patterns("__pycache__"))
    module = tmp_path / "solvers" / "coupling" / "lubrication.py"
    text = module.read_text("utf-8")
    assert text.count("MAX_CONTACT_WIDTH = 0.1\n") == 1
    module.write_text(text.replace("MAX_CONTACT_WIDTH = 0.1\n", "MAX_CONTACT_WIDTH = 0.11\n"), "utf-8")
    return tmp_path


def test_a_worker_with_other_sources_is_refused_before_the_study_and_during_it(edited: Path) -> None:
    theirs = digest_of(edited / "solvers")
    with running_service(1) as (cluster, address):
        with httpx.stream("POST", f"{address}/v1/sweep", json=loads(2500), timeout=PREPARED_S) as response:
            found = map(json.loads, response.iter_lines())
            header = next(line for line in found if line["type"] != "progress")
            cluster.add_worker(edited)
            cluster.wait()
            *_, last = found
        assert (last["type"], last["code"]) == ("error", "other_sources")
        assert theirs in last["message"]
        assert header["sources"] in last["message"]
        refused = httpx.post(f"{address}/v1/sweep", json=loads(2), timeout=PREPARED_S)
        assert refused.status_code == 503
        assert theirs in refused.json()["detail"]
        assert header["sources"] in refused.json()["detail"]


def test_a_frozen_scheduler_is_told_in_time_and_used_again_when_it_answers() -> None:
    with running_service(1) as (cluster, address):
        assert sweep(address, loads(2))[-1]["type"] == "end"
        cluster.scheduler.send_signal(signal.SIGSTOP)
        for _ in range(2):
            started = time.monotonic()
            assert_unavailable(address)
            assert time.monotonic() - started < 50.0
        cluster.scheduler.send_signal(signal.SIGCONT)
        assert sweep(address, loads(2))[-1]["type"] == "end"


def test_without_a_scheduler_studies_wait_and_single_requests_do_not() -> None:
    with served(f"tcp://127.0.0.1:{free_port()}") as (_, address):
        assert_unavailable(address)
        assert httpx.post(f"{address}/v1/coupling", json=COUPLING.request, timeout=60).status_code == 200


@pytest.fixture
def client(service: Service) -> Iterator[Client]:
    cluster, _ = service
    with Client(cluster.address, set_as_default=False) as client:
        yield client


@pytest.mark.parametrize("kind", SWEEPS)
def test_a_script_with_a_client_of_its_own(client: Client, kind: str) -> None:
    assert timeless(list(study("/v1/sweep", SWEEPS[kind], map=client.map))) == local(SWEEPS[kind])


def test_a_spectrum_of_a_script(client: Client) -> None:
    assert timeless(list(study("/v1/spectrum", SPECTRUM, map=client.map))) == local(SPECTRUM, Spectrum)


def test_a_script_loses_a_worker_and_leaves_nothing_behind(service: Service, client: Client) -> None:
    cluster, _ = service
    found = iter(study("/v1/sweep", loads(400), map=client.map))
    received = [next(found) for _ in range(20)]
    cluster.workers.pop().kill()
    assert timeless([*received, *found]) == local(loads(400))
    cluster.add_worker()
    cluster.wait()
    wait_until(lambda: not client.who_has() and not any(client.processing().values()))


def test_a_worker_that_joins_loads_the_kernels_first(service: Service, client: Client) -> None:
    cluster, _ = service
    client.register_plugin(Kernels(COUPLING.endpoint))
    cluster.add_worker()
    cluster.wait()
    assert all(client.run(loaded_kernels).values())
    cluster.workers.pop().terminate()


def loaded_kernels(dask_worker: Worker) -> bool:
    """Return True if kernels are loaded in the worker in which this function runs."""
    return "tribodrive-kernels" in dask_worker.plugins and any(kernel.signatures for kernel in announcement._kernels)


def test_a_script_goes_on_with_another_client_and_another_scheduler(tmp_path: Path) -> None:
    kept, body = tmp_path / "kept.jsonl", loads(400)
    with running_cluster(1) as cluster:
        with Client(cluster.address, set_as_default=False) as client:
            list(islice(study("/v1/sweep", body, map=client.map, kept=kept), 50))
        solved = len(kept.read_bytes().splitlines())
        with Client(cluster.address, set_as_default=False) as client:
            found = iter(study("/v1/sweep", body, map=client.map, kept=kept))
            received = [next(found) for _ in range(solved + 50)]
            cluster.scheduler.kill()
            with pytest.raises(PoolLost, match="kept"):
                received.extend(found)
    assert solved + 50 <= len(kept.read_bytes().splitlines()) < 401
    with running_cluster(1) as cluster, Client(cluster.address, set_as_default=False) as client:
        assert timeless(list(study("/v1/sweep", body, map=client.map, kept=kept))) == local(body)


def test_an_adaptive_cluster_grows_with_a_study() -> None:
    with LocalCluster(n_workers=0, threads_per_worker=1, dashboard_address=":0") as cluster:  # noqa: SIM117
        with Client(cluster, set_as_default=False) as client:
            cluster.adapt(minimum=1, maximum=2, interval="200ms", target_duration="1s")
            most = 0
            for _ in study("/v1/sweep", loads(2500), map=client.map):
                if (most := max(most, len(cluster.scheduler_info["workers"]))) == 2:
                    break
            assert most == 2


@pytest.fixture
def certificate(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Set Dask's own variables to a new certificate, which every process of the cluster must have."""
    key, signed = tmp_path / "key.pem", tmp_path / "signed.pem"
    making = f"openssl req -x509 -newkey rsa:2048 -nodes -subj /CN=cluster -days 2 -keyout {key} -out {signed}"
    subprocess.run(making.split(), check=True, capture_output=True)
    monkeypatch.setenv("DASK_DISTRIBUTED__COMM__TLS__CA_FILE", str(signed))
    for part in ("SCHEDULER", "WORKER", "CLIENT"):
        monkeypatch.setenv(f"DASK_DISTRIBUTED__COMM__TLS__{part}__CERT", str(signed))
        monkeypatch.setenv(f"DASK_DISTRIBUTED__COMM__TLS__{part}__KEY", str(key))
    dask.config.refresh()
    yield
    monkeypatch.undo()
    dask.config.refresh()


@pytest.mark.usefixtures("certificate")
def test_a_cluster_with_tls_by_dasks_own_configuration() -> None:
    with running_cluster(1, "tls") as cluster:
        with Client(cluster.address, set_as_default=False) as client:
            assert timeless(list(study("/v1/sweep", SWEEPS["cases"], map=client.map))) == local(SWEEPS["cases"])
        with served(cluster.address) as (_, address):
            assert sweep(address, SWEEPS["cases"]) == local(SWEEPS["cases"])
