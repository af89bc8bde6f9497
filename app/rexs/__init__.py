"""Gear units from REXS files: read, turned into requests, and given their results back.

model          components, relations and load cases of a file
document       the bytes of a file to a model and back
table          the names of REXS: units, attributes, fields of requests
reading        attributes as numbers, and the draft of a request with what is missing or assumed
power          speeds and torques of all shafts
stages         requests of one mesh
lubrication    its oil, temperatures and friction
modifications  what is taken off its flanks
drive_train    the request of a stage with its shafts and bearings
unit           a whole file: its stages, load cases and findings
answer         what the endpoints and the page send
"""
