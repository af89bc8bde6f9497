"""Gear units in REXS files. This package reads a file, makes requests from the file, and writes results into the file.

model          components, relations and load cases of a file
document       conversion between the bytes of a file and a model
table          the names of units and attributes in REXS, and the request fields that belong to the attributes
reading        attributes as numbers, and the draft of a request with its missing and assumed fields
power          speeds and torques of all shafts
stages         gears, load and materials of one mesh
helices        two stages of a file that are the helices of double-helical gears
lubrication    oil, temperatures and friction of a mesh
modifications  modifications of the flanks of a mesh
drive_train    the drive-train request of a stage, with its shafts and bearings
unit           the stages, the load cases and the faults of a whole file
answer         the answers of the endpoints for files, and the page of a gear unit
"""
