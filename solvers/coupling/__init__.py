"""Gear couplings after Pahl: kinematics, tooth loads, lubrication, friction, axial thrust, losses."""
