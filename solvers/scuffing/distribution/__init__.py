"""What the balanced load says of the mesh: transmission_error -> mesh_stiffness, friction_loss; face_load; and of its
flanks: flank_maps, load_sharing (for comparison) -> feature_line.
"""
