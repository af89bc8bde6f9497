"""What the balanced load says of the mesh and of its flanks.

Data flows transmission_error -> mesh_stiffness, friction_loss; face_load; flank_maps, load_sharing -> feature_line.
"""
