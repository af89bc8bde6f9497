"""The paper's chain of pockets: `pocket_chain` marches through the stroke by the time steps of `step`."""
