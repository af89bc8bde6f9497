"""Requests and responses: pydantic models filled from the dataclasses of the solvers.

quantities  what a field means: its checks, and its part of the JSON schema
model       models with a field for each declaration; conversion to SI and back
fields      the fields of a model in their sections, for forms, tables, files and studies
reading     from the content of a body to a request, or to messages about what is wrong
oil, gears  sections that several requests share
coupling, pumping, line_contact, scuffing, drive_train    requests and answers of the endpoints
"""
