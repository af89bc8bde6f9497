"""The pocket chain of Milian et al.: `step` computes one time step, `pocket_chain` computes all steps of a stroke."""
