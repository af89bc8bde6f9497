"""The geometry of the space between two teeth in mesh.

The modules use each other in this order: tooth_space, profile, section, stroke. `face` divides the face width.
"""
