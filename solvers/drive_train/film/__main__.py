"""Solve Reynolds' equation at all nodes of the table, and write `table.csv`."""

from solvers.drive_train.film.table import write_table

if __name__ == "__main__":
    write_table()
