"""The gap between the flanks over the face.

`balance` finds the gap at which mesh and shafts are in equilibrium, and uses `hub_balance` for the hubs of couplings.
`thermal_lead` computes the part of the gap that heat causes. `misalignment` computes the contribution of each cause.
`face_curves` evaluates curves over the face. `warm_face` follows the loop of load, temperatures along the face and
growth, over the `rotors` of the unit.
"""
