"""Requests and responses: pydantic models whose fields come from the dataclasses of the solvers.

quantities  declarations of fields, from which pydantic takes the checks and the JSON schema
model       models with one field per declaration; conversion to SI and back
fields      the tree of sections and fields of a model, for forms, tables, files and studies
reading     validation of bodies, and messages about the faults of a body
oil, gears, cooling  sections that several requests share
coupling, pumping, line_contact, scuffing, drive_train    requests and answers of the endpoints
"""
