"""Heat balance of a gear pair or gear unit: losses, the oil that cools, and the temperatures of flanks and bodies.

Data flows oil, losses, bearings, fling_off -> network (nodes and flows of heat) -> solution (equilibrium).
"""
