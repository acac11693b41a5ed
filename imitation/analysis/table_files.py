"""Tables of steps as CSV and Parquet."""

import csv
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pyarrow as pa  # type: ignore[import-untyped]
import pyarrow.parquet as pq  # type: ignore[import-untyped]

from imitation.analysis.step_table import Column


def joined(tables: Mapping[str, dict[str, Column]]) -> dict[str, Column]:
    """Tables of several runs below each other, with a first column that names the run."""
    names = dict.fromkeys(name for table in tables.values() for name in table)
    lengths = {run: len(next(iter(table.values())).values) for run, table in tables.items()}
    runs = [run for run, length in lengths.items() for _ in range(length)]
    found = {"run": Column("", runs)}
    for name in names:
        units = {table[name].unit for table in tables.values() if name in table}
        values: list[Any] = []
        for run, table in tables.items():
            values += table[name].values if name in table else [None] * lengths[run]
        found[name] = Column(units.pop(), values)
    return found


def write_csv(path: Path, table: Mapping[str, Column]) -> None:
    """Write a table as CSV: units stand in the head, lists are JSON, what is missing is empty."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(
            [f"{name} [{one.unit}]" if one.unit else name for name, one in table.items()]
        )
        for row in zip(*(one.values for one in table.values()), strict=True):
            writer.writerow([_cell(value) for value in row])


def write_parquet(path: Path, table: Mapping[str, Column], facts: Mapping[str, str]) -> None:
    """Write a table as Parquet: each field's metadata tells its unit.

    Args:
        path: The file.
        table: What to write.
        facts: What the schema's own metadata tells of the runs.
    """
    arrays = [pa.array(one.values) for one in table.values()]
    fields = [
        pa.field(name, array.type, metadata={"unit": one.unit})
        for (name, one), array in zip(table.items(), arrays, strict=True)
    ]
    schema = pa.schema(fields, metadata=dict(facts))
    pq.write_table(pa.Table.from_arrays(arrays, schema=schema), path, compression="zstd")


def _cell(value: object) -> object:
    return json.dumps(value) if isinstance(value, list) else value
