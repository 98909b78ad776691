"""Results read by DuckDB, through its own extension for SQLite, of the long tier.

pytest collects it where it is named.
"""

import sqlite3

import duckdb
import pytest
from devlearn import sweep
from duckdb_extensions import import_extension


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    asked = {
        "worlds": ["paper", "u_trap"],
        "agents": ["paper", "QLearning"],
        "seeds": "1-2",
        "free": [50],
        "rounds": 25,
        "step_limit": 200,
    }
    return sweep(asked, tmp_path_factory.mktemp("duckdb") / "results.sqlite", workers=1)


@pytest.fixture(scope="module")
def connection(results):
    with duckdb.connect() as connection:
        import_extension("sqlite_scanner", con=connection)
        connection.execute(f"ATTACH '{results.path}' AS r (TYPE sqlite, READ_ONLY)")
        yield connection


def test_duckdb_reads_every_run_as_pandas_does(results, connection):
    frame = results.to_pandas()
    names = ["run", "world", "label", "seed", "shortest", "first_arrival", "steps", "failed_share"]
    rows = connection.execute(f"SELECT {', '.join(names)} FROM r.results").fetchall()
    assert rows == [*frame[names].itertuples(index=False, name=None)]
    assert (frame["first_arrival"] == float("inf")).any()  # never, which is no NULL


def test_duckdb_aggregates_what_plain_sql_does(results, connection):
    query = "SELECT world, label, count(*), avg(steps) FROM {} GROUP BY 1, 2 ORDER BY 1, 2"
    with sqlite3.connect(results.path) as plain:
        expected = plain.execute(query.format("results")).fetchall()
    assert connection.execute(query.format("r.results")).fetchall() == expected
