"""The gap over the face: face_curves -> thermal_lead; hub_balance -> balance -> misalignment and its causes."""
