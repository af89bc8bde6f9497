"""Studies ask one question many times: request -> plan (which points) -> points (in workers) -> lines -> summary."""
