"""The paper's chain of pockets: passages, pockets -> step -> march -> pocket_chain."""
