"""The space between two teeth in mesh: tooth_space -> profile -> section -> stroke; face, the width it lies along."""
