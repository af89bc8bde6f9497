"""Requests and responses: pydantic models whose fields come from the dataclasses of the solvers.

quantities  declarations of fields: their checks, and their part of the JSON schema
model       models with one field per declaration; conversion to SI and back
fields      the fields of a model in their sections, for forms, tables, files and studies
reading     validation of bodies: the request, or messages about the faults of the body
oil, gears  sections that several requests share
coupling, pumping, line_contact, scuffing, drive_train    requests and answers of the endpoints
"""
