"""The geometry of the space between two teeth in mesh.

In the order tooth_space, profile, section, stroke, a module uses only the modules before it. `face` divides the face
width into stretches between the grooves.
"""
