"""The paper's chain of pockets: step -> pocket_chain."""
