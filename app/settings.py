"""Limits and addresses of the service, read from environment variables.

The variable of a setting is `TRIBODRIVE_` followed by the name of the setting in capitals.
"""

import os
import sys
from argparse import ArgumentParser
from difflib import get_close_matches
from functools import lru_cache
from typing import Annotated

from pydantic import Field, ValidationError, field_validator
from pydantic_core import ErrorDetails
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

MEBIBYTE = 2**20  # bytes
CLUSTER_POINTS = 100_000  # largest number of points of a study if a cluster solves it; chosen


def _share_of_cores() -> int:
    """Return the number of cores that each process of the server may use.

    The server (uvicorn or gunicorn) reads its number of processes from a command-line argument or an environment
    variable. This function reads the same argument and the same variable.
    """
    number = ArgumentParser(add_help=False, allow_abbrev=False)
    number.add_argument("-w", "--workers", type=int, default=os.environ.get("WEB_CONCURRENCY", "1"))
    processes: int = number.parse_known_args()[0].workers
    return max(1, (os.cpu_count() or 2) // max(1, processes))


class Settings(BaseSettings):
    """The settings of the service. The command line shows the `description` of each field."""

    model_config = SettingsConfigDict(env_prefix="TRIBODRIVE_", frozen=True)

    host: str = Field("127.0.0.1", description="address to listen on")
    port: int = Field(8000, ge=1, le=65535, description="port to listen on")
    root_path: str = Field(
        "",
        pattern=r"^(/[A-Za-z0-9._~-]+)*$",
        description="prefix of every address behind a proxy, `/tribodrive`, which the proxy may strip or not",
    )
    hosts: Annotated[tuple[str, ...], NoDecode] = Field(
        (), description="host names, with commas between them, that reports may print; others are left out"
    )
    workers: int = Field(default_factory=_share_of_cores, ge=1, le=256, description="worker processes that solve")
    queue: int = Field(64, ge=0, description="requests that may wait; one more gets a 503, unless its client has few")
    client_header: str | None = Field(
        None, description="header in which a proxy names the client, for fair shares; without it the address counts"
    )
    proxies: str = Field(
        "", description="addresses of proxies whose X-Forwarded-For is believed, with commas between them; * for all"
    )
    deadline_s: float = Field(30.0, gt=0, description="longest time for one calculation, waiting included; then 504")
    study_points: int = Field(
        2500, ge=1, le=1_000_000, description="most points of one study, with a scheduler 100000; beyond it 422"
    )
    spectrum_solves: int = Field(
        20_000, ge=1, le=1_000_000, description="most points of one load spectrum, cases times machines; beyond it 422"
    )
    study_deadline_s: float = Field(600.0, gt=0, description="longest time for one study; then it ends with an error")
    studies: int = Field(2, ge=0, description="studies at once; one more is answered 503")
    scheduler: str | None = Field(
        None, description="Dask scheduler that solves the studies, `tcp://host:port` or `tls://host:port`"
    )
    worker_memory_mb: int = Field(2048, ge=512, description="memory a worker may allocate, MiB")
    max_body_bytes: int = Field(384 * 1024, ge=1024, description="largest request body; beyond it 413")
    rexs_mb: int = Field(20, ge=1, le=100, description="largest gear unit from a file, unpacked, MiB; beyond it 413")
    answers_mb: int = Field(64, ge=0, description="memory for answers just computed, for other views of them, MiB")
    max_header_bytes: int = Field(
        16384, ge=1024, description="bytes of unfinished request headers, beside one read of 256 KiB; beyond it 400"
    )
    limit_concurrency: int = Field(500, ge=1, description="open connections; a request on one more is answered 503")
    shutdown_s: int = Field(30, ge=0, description="time for requests in flight to finish at shutdown")
    log_level: str = Field("info", pattern="^(debug|info|warning|error)$", description="least level that is logged")
    log_clients: bool = Field(True, description="whether the log names the address of the client of each request")

    @field_validator("hosts", mode="before")
    @classmethod
    def _split(cls, names: object) -> object:
        return [name.strip() for name in names.split(",") if name.strip()] if isinstance(names, str) else names

    @property
    def rexs_bytes(self) -> int:
        """Largest permissible size of the unpacked file of a gear unit [bytes]."""
        return self.rexs_mb * MEBIBYTE

    @property
    def most_study_points(self) -> int:
        """Largest number of points of one study.

        If a cluster solves the studies and `study_points` is not set, this number is `CLUSTER_POINTS`. Otherwise this
        number is `study_points`.
        """
        return CLUSTER_POINTS if self.scheduler and "study_points" not in self.model_fields_set else self.study_points


@lru_cache(maxsize=1)
def settings() -> Settings:
    """Return the settings of this process. They are read from the environment only once.

    If settings are wrong, print a line for each wrong setting and end the process.
    """
    try:
        return Settings()
    except ValidationError as error:
        sys.exit("\n".join([*unknown_variables(), *map(_wrong, error.errors())]))


def unknown_variables() -> list[str]:
    """Return a message for each environment variable that has the prefix of a setting but is not a setting."""
    variables = [f"TRIBODRIVE_{name.upper()}" for name in Settings.model_fields]
    lines = []
    for name in sorted(os.environ):
        if name.startswith("TRIBODRIVE_") and name not in variables:
            nearest = get_close_matches(name, variables, 1)
            meant = f"; did you mean {nearest[0]}?" if nearest else ""
            lines.append(f"tribodrive: there is no setting {name}{meant}")
    return lines


def _wrong(fault: ErrorDetails) -> str:
    name = f"TRIBODRIVE_{str(fault['loc'][0]).upper()}"
    return f"tribodrive: {name} is {fault['input']!r}: {fault['msg'][0].lower()}{fault['msg'][1:]}"
