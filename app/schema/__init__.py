"""Requests and responses: pydantic models whose fields come from the dataclasses of the solvers.

quantities  declarations of fields, from which pydantic takes the checks and the JSON schema
model       models with one field per declaration; conversion to SI
answers     models of answers, generated
fields      the tree of sections and fields of a model, for forms, tables, files and studies
precision   what the tolerance of an iteration can change in an output
reading     bodies: reading, validation, and messages about faults
"""
