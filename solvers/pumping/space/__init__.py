"""The space between two teeth in mesh: tooth_space -> profile -> section -> stroke. `face` cuts it into slices."""
