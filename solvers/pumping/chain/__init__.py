"""The pocket chain of Milian et al.: `step` computes one time step, and `pocket_chain` all time steps of a stroke."""
