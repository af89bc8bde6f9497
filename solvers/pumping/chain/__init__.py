"""The paper's chain of pockets; `pocket_chain` marches the steps of `step`."""
