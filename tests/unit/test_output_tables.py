"""history.csv, cracks.csv, growth.csv, columns.json."""

import csv
import json
import math

import numpy as np
import pytest

from cramp_cli.output.exits import FolderError
from cramp_cli.output.history import (
    CRACK_COLUMNS,
    GROWTH_COLUMNS,
    HISTORY_COLUMNS,
    CsvTable,
    cut_tables,
    history_columns,
    write_columns,
)


def rows_of(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_numbers_come_back_bit_for_bit(tmp_path):
    table = CsvTable(tmp_path / "t.csv", ("step", "a", "b"))
    values = [0.1, 1 / 3, -1e-308, 6.02214076e23, math.pi]
    for step, value in enumerate(values):
        table.write({"step": step, "a": value, "b": np.float64(-value)})
    rows = rows_of(tmp_path / "t.csv")
    assert [float(row["a"]) for row in rows] == values
    assert [-float(row["b"]) for row in rows] == values
    assert [row["step"] for row in rows] == ["0", "1", "2", "3", "4"]


def test_a_row_is_on_disk_at_once_and_text_is_quoted(tmp_path):
    table = CsvTable(tmp_path / "t.csv", ("step", "status"))
    assert (tmp_path / "t.csv").read_text() == "step,status\n"
    table.write({"step": np.int64(1), "status": "invalid: leaves the body, twice"})
    assert (tmp_path / "t.csv").read_text().endswith('1,"invalid: leaves the body, twice"\n')


def test_a_missing_value_is_nan_and_an_unknown_column_an_error(tmp_path):
    table = CsvTable(tmp_path / "t.csv", ("step", "a"))
    table.write({"step": 1})
    assert math.isnan(float(rows_of(tmp_path / "t.csv")[0]["a"]))
    with pytest.raises(ValueError, match="no column named c, d"):
        table.write({"step": 1, "d": 1, "c": 2})


def test_tables_are_cut_to_where_they_were(tmp_path):
    path = tmp_path / "history.csv"
    path.write_text("step,a\n1,1\n2,2\n3,3\n4,")
    (tmp_path / "growth.csv").write_text("step\n")  # began after the checkpoint
    cut_tables(tmp_path, {"history": len("step,a\n1,1\n2,2\n")})
    CsvTable(path, ("step", "a"), go_on=True).write({"step": 3, "a": 9.0})
    assert path.read_text() == "step,a\n1,1\n2,2\n3,9\n"
    assert not (tmp_path / "growth.csv").exists()


def test_a_table_shorter_than_it_was_is_refused(tmp_path):
    (tmp_path / "history.csv").write_text("step,a\n1,1\n")
    with pytest.raises(FolderError, match="has 11 bytes, the checkpoint knows of 15"):
        cut_tables(tmp_path, {"history": 15})


def test_going_on_refuses_other_columns(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text("step,b\n")
    with pytest.raises(FolderError, match="other columns"):
        CsvTable(path, ("step", "a"), go_on=True)


def test_reactions_follow_the_fixed_columns():
    columns = history_columns(["step", "reaction_grip_x", "reaction_grip_y"])
    assert list(columns) == [*HISTORY_COLUMNS, "reaction_grip_x", "reaction_grip_y"]
    with pytest.raises(ValueError, match="kinetic_enrgy"):
        history_columns(["kinetic_enrgy"])


def test_columns_are_those_of_the_manual():
    tips = "step,time,crack,tip,x,y,angle,length,speed,J,K_I,K_II,K_III,ctod_n,ctod_t,"
    tips += "J_contour,K_I_contour,K_II_contour,J_spread,J_tip,J_zone,status"
    assert ",".join(CRACK_COLUMNS) == tips
    events = "step,time,crack,tip,kind,x,y,angle,length,J,K_I,K_II,energy,mode_I"
    assert ",".join(GROWTH_COLUMNS) == events


def test_every_column_has_unit_and_meaning(tmp_path):
    write_columns(tmp_path, history_columns(["reaction_grip_x"]))
    told = json.loads((tmp_path / "columns.json").read_text())
    assert set(told) == {"history.csv", "cracks.csv", "growth.csv", "path.csv"}
    assert told["cracks.csv"]["K_I"]["unit"] == "Pa*m^0.5"
    assert told["history.csv"]["reaction_grip_x"]["unit"] == "N"
    assert all(column["meaning"] for table in told.values() for column in table.values())
