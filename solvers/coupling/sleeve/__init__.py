"""The sleeve between two meshes under friction: balance -> equilibrium -> thrust."""
