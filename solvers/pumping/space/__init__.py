"""The space between two teeth in mesh.

Data pass through the modules tooth_space -> profile -> section -> stroke. `face` divides the face width.
"""
