"""The paper's chain of pockets: pockets -> step -> march -> pocket_chain."""
