"""Gear units from REXS files. This package reads such files, converts them into requests, and adds results to them.

model          components, relations and load cases of a file
document       conversion between the bytes of a file and a model
table          the names of REXS: units, attributes, fields of requests
reading        attributes as numbers, and the draft of a request with its missing and assumed fields
power          speeds and torques of all shafts
stages         requests of one mesh
lubrication    oil, temperatures and friction of a mesh
modifications  modifications of the flanks of a mesh
drive_train    the request of a stage with its shafts and bearings
unit           a whole file: stages, load cases and findings
answer         the answers of the endpoints and the page
"""
