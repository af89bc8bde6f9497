"""The space between two teeth while it meshes: tooth_space -> section -> stroke; and face, the width it lies along."""
